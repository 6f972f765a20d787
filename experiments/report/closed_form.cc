#include "experiments/report/closed_form.h"

#include <string>

#include "experiments/tables/given_walk_file.h"
#include "experiments/tables/parameter_tables.h"
#include "wpg/files/number_text.h"
#include "wpg/motion/lipm.h"
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
    if (traits.factor || traits.of_heights) continue;
    if (traits.number != nullptr) numbers[column] = half_step.*traits.number;
    if (traits.shape != nullptr) numbers[column] = half_step.shape.*traits.shape;
  }
  return numbers;
}

// What half_steps.csv has of the families: where a walk's values stand among its parameters, a
// number for each step or half-step, and the column, which names the number of half-steps, too.
json FamilyColumnsJson() {
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
  return {{"half_steps", std::move(half_steps)},  {"families", FamilyColumnsJson()},
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
