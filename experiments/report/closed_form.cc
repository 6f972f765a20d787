#include "experiments/report/closed_form.h"

#include <string>

#include <algorithm>

#include "experiments/tables/given_walk_file.h"
#include "experiments/tables/parameter_tables.h"
#include "wpg/files/number_text.h"
#include "wpg/motion/lipm.h"
#include "wpg/robot/gravity.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

bool OnOneLevel(const HalfStepSequence& sequence) {
  return std::ranges::all_of(sequence.half_steps, [](const PlacedHalfStep& placed) {
    return placed.X_WS.height == 0.0 && placed.half_step.X_SF.height == 0.0;
  });
}

// [x, y, yaw], and z where `levels`.
json PlaceJson(const Foothold& X, bool levels) {
  json place = {Shortened(X.x, 12), Shortened(X.y, 12), Shortened(X.yaw, 12)};
  if (levels) place.push_back(Shortened(X.height, 12));
  return place;
}

json HalfStepJson(const PlacedHalfStep& placed, bool levels) {
  const HalfStep& half_step = placed.half_step;
  json numbers = {{"support", half_step.support == Side::kLeft ? "left" : "right"},
                  {"kind", half_step.kind == HalfStepKind::kUp ? "up" : "down"},
                  {"X_WS", PlaceJson(placed.X_WS, levels)},
                  {"X_SF", PlaceJson(half_step.X_SF, levels)},
                  {"via_height_m", half_step.via_height}};
  for (const ParameterFamily family : AllParameterFamilies()) {
    const ParameterFamilyTraits& traits = Traits(family);
    const std::string column(traits.column);
    if (traits.factor || (traits.of_heights && !levels)) continue;
    if (traits.number != nullptr) numbers[column] = half_step.*traits.number;
    if (traits.shape != nullptr) numbers[column] = half_step.shape.*traits.shape;
  }
  if (half_step.shape.crouch != 0.0) numbers["crouch_m"] = half_step.shape.crouch;
  if (half_step.standing_crouch) numbers["standing_crouch_m"] = *half_step.standing_crouch;
  return numbers;
}

// What half_steps.csv has of the families: where a walk's values stand among its parameters, a
// number for each step or half-step, and the column, which names the number of half-steps, too.
json FamilyColumnsJson(bool levels) {
  json families = json::array();
  const auto extent = levels ? HalfStepsExtent::kHeights : HalfStepsExtent::kFootsteps;
  for (const ParameterFamily family : FamiliesOfHalfSteps(extent)) {
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
  const bool levels = !OnOneLevel(sequence) || ChangesCrouch(sequence);
  json half_steps = json::array();
  for (const PlacedHalfStep& placed : sequence.half_steps) {
    half_steps.push_back(HalfStepJson(placed, levels));
  }
  return {{"half_steps", std::move(half_steps)},  {"families", FamilyColumnsJson(levels)},
          {"com_height_m", lipm->com_height()},   {"gravity_m_s2", kGravity},
          {"waist_height_m", robot.waist_height}, {"com_ahead_m", robot.com_x_B}};
}

json ParametersJson(const fs::path& folder, const HalfStepSequence& sequence) {
  const HomotopyParameters walk = ReadParameters(folder, sequence);
  json parameters = {{PluralOf(Traits(ParameterFamily::kOverlap)), walk.overlaps}};
  for (const ParameterFamily family : FamiliesOfHalfSteps(ExtentOf(sequence, walk))) {
    parameters[PluralOf(Traits(family))] = walk.of(family);
  }
  return parameters;
}

}  // namespace halfstep
