#include "experiments/report/closed_form.h"

#include <string>
#include <vector>

#include "experiments/tables/csv_reader.h"
#include "experiments/tables/parameter_tables.h"
#include "wpg/files/number_text.h"
#include "wpg/motion/lipm.h"
#include "wpg/nth.h"
#include "wpg/robot/gravity.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json PlaceJson(const Foothold& X) {
  X.CheckLevel();
  return {Shortened(X.x, 12), Shortened(X.y, 12), Shortened(X.yaw, 12)};
}

json HalfStepJson(const PlacedHalfStep& placed) {
  const HalfStep& half_step = placed.half_step;
  json numbers = {{"support", half_step.support == Side::kLeft ? "left" : "right"},
                  {"kind", half_step.kind == HalfStepKind::kUp ? "up" : "down"},
                  {"X_WS", PlaceJson(placed.X_WS)},
                  {"X_SF", PlaceJson(half_step.X_SF)},
                  {"via_height_m", half_step.via_height}};
  for (const ParameterFamily family : AllParameterFamilies()) {
    const ParameterFamilyTraits& traits = Traits(family);
    const std::string column(traits.column);
    if (traits.factor) continue;
    if (traits.number != nullptr) numbers[column] = half_step.*traits.number;
    if (traits.shape != nullptr) numbers[column] = half_step.shape.*traits.shape;
  }
  return numbers;
}

// What half_steps.csv has of the families: where a walk's values stand among its parameters, a
// number for each step or half-step, and the column, which names the number of half-steps, too.
json FamiliesJson() {
  json families = json::array();
  for (const ParameterFamily family : FamiliesOfHalfSteps(HalfStepsExtent::kFootsteps)) {
    const ParameterFamilyTraits& traits = Traits(family);
    families.push_back(
        {{"values", PluralOf(traits)}, {"of", Name(traits.of)}, {"column", traits.column}});
  }
  return families;
}

}  // namespace

json ClosedFormJson(const RobotModel& robot, const HalfStepSequence& sequence) {
  const auto* lipm = dynamic_cast<const Lipm*>(sequence.model.get());
  if (lipm == nullptr) return nullptr;
  json half_steps = json::array();
  for (const PlacedHalfStep& placed : sequence.half_steps) {
    half_steps.push_back(HalfStepJson(placed));
  }
  return {{"half_steps", std::move(half_steps)},  {"families", FamiliesJson()},
          {"com_height_m", lipm->com_height()},   {"gravity_m_s2", kGravity},
          {"waist_height_m", robot.waist_height}, {"com_ahead_m", robot.com_x_B}};
}

json ParametersJson(const fs::path& folder, int size) {
  const CsvTable half_steps = ReadCsv((folder / "half_steps.csv").string());
  const size_t count = static_cast<size_t>(size);
  if (half_steps.rows.size() != count || count % 2 != 0) return nullptr;
  std::vector<double> overlaps(count - 1, 0.0);  // those of `raw`, which has no table
  if (const fs::path path = folder / "overlaps.csv"; fs::exists(path)) {
    overlaps =
        ReadCsv(path.string()).Numbers(std::string(Traits(ParameterFamily::kOverlap).column));
    if (overlaps.size() != count - 1) return nullptr;
  }
  json parameters;
  parameters[PluralOf(Traits(ParameterFamily::kOverlap))] = overlaps;
  for (const ParameterFamily family : FamiliesOfHalfSteps(HalfStepsExtent::kFootsteps)) {
    const ParameterFamilyTraits& traits = Traits(family);
    const std::string column(traits.column);
    if (traits.of_form && !half_steps.Has(column)) continue;
    const std::vector<double> rows = half_steps.Numbers(column);
    std::vector<double> values;
    for (int i = 0; i < size; ++i) {
      if (traits.index_at(i) < static_cast<int>(values.size())) continue;
      values.push_back(Nth(rows, i));
    }
    parameters[PluralOf(traits)] = values;
  }
  return parameters;
}

}  // namespace halfstep
