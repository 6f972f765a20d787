#include "smoothing/methods/typical_start.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "wpg/nth.h"

namespace halfstep {
namespace {

// HRP-2's lengths, with which the forms were measured [m].
constexpr double kComHeight = 0.8, kStandingWidth = 0.21;
// Instants of a half-step at which it is asked whether a step touches an obstacle.
constexpr int kLooks = 8;
// Medians of single parameters make no walk: a little slower, hardly any row is violated.
constexpr double kSlower = 1.2;

// From where on a step is of a class: aside, of the standing width; back, of the CoM's height;
// turning [rad].
constexpr double kAside = 0.45, kBack = 0.06, kTurn = 0.2;

// A table, two lines a form.
// clang-format off
constexpr std::array kForms = {
    TypicalForm{"level", {0.82, 0.816}, 0.88, 0.99, 0.184, 0.056, 0.18, 0.07,
                {0.225, 0.21}, {0.116, 0.132}, {0.456, 0.472}, {0.102, 0.102}, {0.1, 0.1}},
    TypicalForm{"first", {0.749, 0.861}, 0.793, 1.0, 0.1, 0.034, 0.3, -0.08,
                {0.227, 0.425}, {0.084, 0.063}, {0.577, 0.405}, {0.112, 0.094}, {0.1, 0.1}},
    TypicalForm{"last", {0.846, 0.786}, 0.814, 1.0, 0.112, 0.036, 0.248, 0.016,
                {0.279, 0.249}, {0.096, 0.097}, {0.65, 0.593}, {0.095, 0.104}, {0.1, 0.1}},
    TypicalForm{"turning", {0.821, 0.821}, 0.893, 0.996, 0.198, 0.056, 0.18, 0.079,
                {0.207, 0.202}, {0.128, 0.124}, {0.464, 0.452}, {0.102, 0.102}, {0.1, 0.1}},
    TypicalForm{"backward", {0.784, 0.784}, 0.878, 0.984, 0.175, 0.058, 0.18, 0.05,
                {0.233, 0.225}, {0.144, 0.117}, {0.518, 0.459}, {0.104, 0.108}, {0.1, 0.1}},
    TypicalForm{"sideways", {1.381, 1.425}, 0.866, 1.0, 0.295, 0.02, 0.271, 0.004,
                {0.217, 0.247}, {0.059, 0.062}, {0.449, 0.423}, {0.061, 0.06}, {0.13, 0.192}},
    TypicalForm{"over", {1.355, 1.062}, 0.637, 0.999, 0.692, 0.028, 0.249, 0.014,
                {0.434, 0.411}, {0.081, 0.084}, {0.817, 0.952}, {0.072, 0.079}, {0.51, 0.451}},
    TypicalForm{"high", {1.3, 1.3}, 0.88, 0.99, 0.4, 0.056, 0.18, 0.07,
                {0.225, 0.21}, {0.116, 0.132}, {0.456, 0.472}, {0.102, 0.102}, {0.1, 0.1}},
};
// clang-format on

const TypicalForm& Form(std::string_view name) {
  return *std::find_if(kForms.begin(), kForms.end(),
                       [&](const TypicalForm& form) { return form.name == name; });
}

// The value of a form for a family, in the up (0) or down (1) half-step where it is one of those.
std::optional<double> ValueOf(const TypicalForm& form, ParameterFamily family, int half,
                              const RobotModel& robot) {
  const double width = robot.standing_width / kStandingWidth;
  switch (family) {
    case ParameterFamily::kHeightScale:
      return form.height_scale;
    case ParameterFamily::kDuration:
      return kSlower * Nth(form.duration, half) * std::sqrt(robot.com_height / kComHeight);
    case ParameterFamily::kSupportPoint:
      return form.support_point * width;
    case ParameterFamily::kViaLateral:
      return form.via_lateral * width;
    case ParameterFamily::kViaAlong:
      return form.via_along * robot.com_height / kComHeight;
    case ParameterFamily::kFootRamp:
      return Nth(form.foot_ramp, half);
    case ParameterFamily::kFootDelay:
      return Nth(form.foot_delay, half);
    case ParameterFamily::kLiftShare:
      return Nth(form.lift_share, half);
    case ParameterFamily::kZmpShift:
      return Nth(form.zmp_shift, half);
    case ParameterFamily::kZmpBumpRamp:
      return Nth(form.zmp_bump_ramp, half);
    default:
      return std::nullopt;
  }
}

using Forms = std::vector<const TypicalForm*>;  // of each step

// Makes the ZMP's shifts as long as demanded [s], and T where a shift may be no larger part of it.
void KeepDoubleSupport(double demanded, const ParameterTable& table, HomotopyParameters* start) {
  for (size_t i = 0; i < start->durations.size(); ++i) {
    const auto raise = [&](ParameterFamily family, double least) {
      const ParameterRow& row = table.row({family, static_cast<int>(i)});
      double& value = row.parameter.in(*start);
      if (!row.fixed) value = std::clamp(std::max(value, least), row.lower, row.upper);
    };
    raise(ParameterFamily::kZmpShift, demanded / start->durations[i]);
    raise(ParameterFamily::kDuration, demanded / start->zmp_shifts[i]);
  }
}

HomotopyParameters StartOf(const WalkProblem& problem, const ParameterTable& table,
                           const Forms& forms) {
  const HalfStepSequence& sequence = problem.sequence();
  HomotopyParameters start = table.Start();
  for (const ParameterRow& row : table.rows()) {
    if (row.fixed) continue;
    const ParameterFamily family = row.parameter.family;
    const int half_step = Traits(family).half_steps(row.parameter.index).first;
    const std::optional<double> value =
        ValueOf(*Nth(forms, half_step / 2), family, half_step % 2, problem.robot());
    if (value) row.parameter.in(start) = std::clamp(*value, row.lower, row.upper);
  }
  KeepDoubleSupport(problem.limits().demanded_of(MarginFamily::kDoubleSupport), table, &start);
  for (int i = 0; i < sequence.num_junctions(); ++i) {
    if (!table.free({ParameterFamily::kOverlap, i})) continue;
    const TypicalForm& own = *Nth(forms, i / 2);
    const bool up_down = KindOfJunction(i) == JunctionKind::kUpDown;
    Nth(start.overlaps, i) = (up_down ? own.up_down : own.down_up) * NaturalOverlapBound(start, i);
  }
  return start;
}

}  // namespace

std::span<const TypicalForm> TypicalForms() { return kForms; }

const TypicalForm& FormOfStep(const HalfStepSequence& sequence, int step, const RobotModel& robot) {
  const Foothold& from = Nth(sequence.half_steps, 2 * step).half_step.X_SF;
  const Foothold& to = Nth(sequence.half_steps, 2 * step + 1).half_step.X_SF;
  if (std::abs(to.y - from.y) > kAside * robot.standing_width) return Form("sideways");
  if (step == 0) return Form("first");
  if (step + 1 == sequence.num_steps()) return Form("last");
  if (std::abs(to.yaw - from.yaw) > kTurn) return Form("turning");
  return Form(to.x - from.x < -kBack * robot.com_height ? "backward" : "level");
}

HomotopyParameters TypicalStart(const WalkProblem& problem, const ParameterChoice& choice,
                                MarginEvaluator::Scratch* scratch, const TypicalForm* form) {
  const HalfStepSequence& sequence = problem.sequence();
  const ParameterTable table = problem.Parameters(choice);
  Forms forms;
  for (int j = 0; j < sequence.num_steps(); ++j) {
    forms.push_back(form != nullptr ? form : &FormOfStep(sequence, j, problem.robot()));
  }
  const HomotopyParameters start = StartOf(problem, table, forms);
  const Scene& scene = problem.scene();
  if (form != nullptr || (scene.obstacles.empty() && scene.ground->Solids().empty())) return start;
  const SuperposedWalk walk(sequence, start);
  const double demanded = problem.limits().demanded_of(MarginFamily::kClearance);
  for (int k = 0; k < sequence.size(); ++k) {
    for (int look = 0; look < kLooks; ++look) {
      const LocalTime at{k, (look + 0.5) / kLooks * Nth(start.durations, k)};
      const MarginSet margins = problem.evaluator().At(walk, at, scratch);
      const double clearance = Nth(margins, MarginFamily::kClearance).value;
      if (clearance >= demanded || !std::isfinite(clearance)) continue;
      Nth(forms, k / 2) = &Form("over");
      break;
    }
  }
  return StartOf(problem, table, forms);
}

}  // namespace halfstep
