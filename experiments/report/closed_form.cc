#include "experiments/report/closed_form.h"

#include <vector>

#include "experiments/tables/csv_reader.h"
#include "wpg/files/number_text.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json PlaceJson(const Foothold& X) {
  X.CheckLevel();
  return {Shortened(X.x, 12), Shortened(X.y, 12), Shortened(X.yaw, 12)};
}

json ShapeJson(const HalfStepShape& shape) {
  return {{"shift", shape.shift},
          {"horizontal_delay", shape.horizontal_delay},
          {"bump_ramp", shape.bump_ramp},
          {"foot_ramp", shape.foot_ramp},
          {"lift_share", shape.lift_share}};
}

json HalfStepJson(const PlacedHalfStep& placed) {
  const HalfStep& half_step = placed.half_step;
  return {{"support", half_step.support == Side::kLeft ? "left" : "right"},
          {"kind", half_step.kind == HalfStepKind::kUp ? "up" : "down"},
          {"X_WS", PlaceJson(placed.X_WS)},
          {"X_SF", PlaceJson(half_step.X_SF)},
          {"duration_s", half_step.duration},
          {"via_height_m", half_step.via_height},
          {"via_lateral_m", half_step.via_lateral},
          {"via_along_m", half_step.via_along},
          {"shape", ShapeJson(half_step.shape)}};
}

}  // namespace

json ClosedFormJson(const RobotModel& robot, const HalfStepSequence& sequence) {
  json half_steps = json::array();
  for (const PlacedHalfStep& placed : sequence.half_steps) {
    half_steps.push_back(HalfStepJson(placed));
  }
  return {{"half_steps", std::move(half_steps)},
          {"com_height_m", sequence.lipm.com_height},
          {"gravity_m_s2", sequence.lipm.gravity},
          {"waist_height_m", robot.waist_height},
          {"com_ahead_m", robot.com_x_B}};
}

json ParametersJson(const fs::path& folder, int size) {
  const CsvTable half_steps = ReadCsv((folder / "half_steps.csv").string());
  const size_t count = static_cast<size_t>(size);
  if (half_steps.rows.size() != count || count % 2 != 0) return nullptr;
  std::vector<double> overlaps(count - 1, 0.0);  // those of `raw`, which has no table
  if (const fs::path path = folder / "overlaps.csv"; fs::exists(path)) {
    overlaps = ReadCsv(path.string()).Numbers("overlap_s");
    if (overlaps.size() != count - 1) return nullptr;
  }
  const auto by_step = [&half_steps](const char* column) {
    json values = json::array();
    const std::vector<double> rows = half_steps.Numbers(column);
    for (size_t i = 0; i < rows.size(); i += 2) values.push_back(rows[i]);
    return values;
  };
  json parameters = {{"overlaps", overlaps},
                     {"durations", half_steps.Numbers("duration_s")},
                     {"height_scales", by_step("height_scale")},
                     {"support_points", by_step("support_point_m")}};
  if (half_steps.Has("lift_share")) {
    parameters["via_laterals"] = by_step("via_lateral_m");
    parameters["foot_ramps"] = half_steps.Numbers("foot_ramp");
    parameters["foot_delays"] = half_steps.Numbers("foot_delay");
    parameters["lift_shares"] = half_steps.Numbers("lift_share");
    parameters["via_alongs"] = by_step("via_along_m");
    parameters["zmp_shifts"] = half_steps.Numbers("zmp_shift");
    parameters["zmp_bump_ramps"] = half_steps.Numbers("zmp_bump_ramp");
  }
  if (half_steps.Has("footstep_x_m")) {
    parameters["footstep_xs"] = by_step("footstep_x_m");
    parameters["footstep_ys"] = by_step("footstep_y_m");
    parameters["footstep_yaws"] = by_step("footstep_yaw_rad");
  }
  return parameters;
}

}  // namespace halfstep
