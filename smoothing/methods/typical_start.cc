#include "smoothing/methods/typical_start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "wpg/nth.h"

namespace halfstep {
namespace {

// HRP-2's lengths, with which the forms were measured [m].
constexpr double kComHeight = 0.8, kStandingWidth = 0.21;

constexpr std::array kForms = {
    TypicalForm{"level", 0.72, 0.85, 1.0, 0.25, 0.055, 0.23, 0.0, 0.27, 0.095, 0.58, 0.02, 0.1},
    TypicalForm{"high", 1.0, 0.85, 1.0, 0.4, 0.055, 0.23, 0.0, 0.27, 0.095, 0.58, 0.02, 0.1},
};

// The value of a form for a family, and whether the family has one.
std::optional<double> ValueOf(const TypicalForm& form, ParameterFamily family,
                              const RobotModel& robot) {
  const double width = robot.standing_width / kStandingWidth;
  switch (family) {
    case ParameterFamily::kHeightScale:
      return form.height_scale;
    case ParameterFamily::kDuration:
      return form.duration * std::sqrt(robot.com_height / kComHeight);
    case ParameterFamily::kSupportPoint:
      return form.support_point * width;
    case ParameterFamily::kViaLateral:
      return form.via_lateral * width;
    case ParameterFamily::kViaAlong:
      return form.via_along * robot.com_height / kComHeight;
    case ParameterFamily::kFootRamp:
      return form.foot_ramp;
    case ParameterFamily::kFootDelay:
      return form.foot_delay;
    case ParameterFamily::kLiftShare:
      return form.lift_share;
    case ParameterFamily::kZmpShift:
      return form.zmp_shift;
    case ParameterFamily::kZmpBumpRamp:
      return form.zmp_bump_ramp;
    default:
      return std::nullopt;
  }
}

}  // namespace

std::span<const TypicalForm> TypicalForms() { return kForms; }

const TypicalForm& FormOfStep(const HalfStepSequence&, int) { return kForms.front(); }

HomotopyParameters TypicalStart(const HalfStepSequence& sequence, const ParameterTable& table,
                                const RobotModel& robot, const TypicalForm* form) {
  const auto form_of = [&](int step) -> const TypicalForm& {
    return form != nullptr ? *form : FormOfStep(sequence, step);
  };
  HomotopyParameters start = table.Start();
  for (const ParameterRow& row : table.rows()) {
    if (row.fixed) continue;
    const ParameterFamily family = row.parameter.family;
    const int half_step = Traits(family).half_steps(row.parameter.index).first;
    const std::optional<double> value = ValueOf(form_of(half_step / 2), family, robot);
    if (value) row.parameter.in(start) = std::clamp(*value, row.lower, row.upper);
  }
  for (int i = 0; i < sequence.num_junctions(); ++i) {
    if (!table.free({ParameterFamily::kOverlap, i})) continue;
    const TypicalForm& own = form_of(i / 2);
    const bool up_down = KindOfJunction(i) == JunctionKind::kUpDown;
    Nth(start.overlaps, i) = (up_down ? own.up_down : own.down_up) * NaturalOverlapBound(start, i);
  }
  return start;
}

}  // namespace halfstep
