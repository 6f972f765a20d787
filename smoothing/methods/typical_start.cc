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

constexpr double kLonger = 1.12;     // from one trial to the next
constexpr double kTolerated = -1e9;  // of a row: the solver's first steps mend it

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

// The program's rows at a point.
Eigen::VectorXd RowsAt(const OverlapProgram& program, const HomotopyParameters& at) {
  Eigen::VectorXd values;
  program.watched().Evaluate(program.variables().ToVariables(at), &values, nullptr);
  return values;
}

}  // namespace

std::span<const TypicalForm> TypicalForms() { return kForms; }

const TypicalForm& FormOfStep(const HalfStepSequence&, int) { return kForms.front(); }

HomotopyParameters TypicalStart(const OverlapProgram& program, const RobotModel& robot,
                                const TypicalForm* form) {
  const OverlapVariables& variables = program.variables();
  const HalfStepSequence& sequence = variables.sequence();
  const ParameterTable& table = variables.table();
  HomotopyParameters start = table.Start();
  for (int v = 0; v < variables.size(); ++v) {
    const HomotopyParameter& parameter = variables.at(v);
    const int half_step = Traits(parameter.family).half_steps(parameter.index).first;
    const TypicalForm& own = form ? *form : FormOfStep(sequence, half_step / 2);
    const std::optional<double> value = ValueOf(own, parameter.family, robot);
    if (!value) continue;
    const ParameterRow& row = table.row(parameter);
    parameter.in(start) = std::clamp(*value, row.lower, row.upper);
  }
  const std::vector<double> planned = table.Start().durations;
  const auto overlap = [&](HomotopyParameters* at) {
    for (int i = 0; i < sequence.num_junctions(); ++i) {
      if (!table.free({ParameterFamily::kOverlap, i})) continue;
      const TypicalForm& own = form ? *form : FormOfStep(sequence, i / 2);
      const bool up_down = KindOfJunction(i) == JunctionKind::kUpDown;
      Nth(at->overlaps, i) = (up_down ? own.up_down : own.down_up) * NaturalOverlapBound(*at, i);
    }
  };
  // Longer where the rows ask for it, until nothing asks or all are as planned; but not for rows
  // that ask for something else.
  HomotopyParameters slowest = start;
  for (size_t k = 0; k < planned.size(); ++k) {
    slowest.durations[k] = std::max(start.durations[k], planned[k]);
  }
  overlap(&slowest);
  const Eigen::VectorXd at_slowest = RowsAt(program, slowest);
  for (bool longer = true; longer;) {
    overlap(&start);
    longer = false;
    const Eigen::VectorXd rows = RowsAt(program, start);
    std::vector<bool> slow(planned.size(), false);
    for (int row = 0; row < rows.size(); ++row) {
      if (rows[row] >= kTolerated || at_slowest[row] < kTolerated) continue;
      const size_t k = static_cast<size_t>(program.watched().half_step_of(row));
      for (size_t i = k > 0 ? k - 1 : 0; i < std::min(planned.size(), k + 2); ++i) slow[i] = true;
    }
    for (size_t k = 0; k < slow.size(); ++k) {
      const HomotopyParameter T{ParameterFamily::kDuration, static_cast<int>(k)};
      if (!slow[k] || variables.IndexOf(T) < 0 || start.durations[k] >= planned[k]) continue;
      start.durations[k] = std::min(planned[k], kLonger * start.durations[k]);
      longer = true;
    }
  }
  return start;
}

}  // namespace halfstep
