#include "smoothing/methods/plan_remedies.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "smoothing/walk/splice.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr size_t kMostFootsteps = 3;
// Tried in this order, the smallest changes first.
constexpr double kHigher[] = {0.01, 0.02,  0.03, 0.04,  0.06, 0.08,  0.1,  -0.01,
                              0.13, -0.02, 0.16, -0.04, 0.2,  -0.06, 0.25, -0.1};  // [m]
constexpr double kTimesLonger[] = {1.1, 1.2, 1.35, 1.5, 1.75, 2.0, 2.5, 3.0, 4.0};
constexpr double kHigherAndLonger[] = {0.01, 0.02, 0.03, 0.04, 0.06, 0.08, 0.1, 0.13};  // [m]
constexpr double kTimesLongerAndHigher[] = {1.1, 1.25, 1.5, 2.0};
constexpr double kLower[] = {0.005, 0.01, 0.02, 0.03, 0.04, 0.06, 0.08};  // [m]
constexpr double kFarther[] = {0.01,  -0.01, 0.02,  -0.02, 0.03, -0.03,
                               -0.04, 0.04,  -0.06, 0.06,  0.08, -0.08};  // [m]

// Values as they are told, so that exactly what is told was tried.
double Rounded(double value, double grid) { return std::round(value / grid) * grid; }
double Higher(const PlanChange& planned, double by) {
  return Rounded(*planned.via_height + by, 0.001);
}
double Longer(const PlanChange& planned, double by) {
  return Rounded(by * *planned.duration, 0.01);
}

// Footsteps by their worst demand, the worst first.
std::vector<int> FootstepsThatMiss(const MissedDemands& missed) {
  std::vector<int> steps;
  for (const MissedDemand& demand : missed.demands) {
    const int step = demand.footstep;
    if (step < 0) continue;  // no footstep mends where a foot stands at the start
    if (std::ranges::find(steps, step) == steps.end()) steps.push_back(step);
  }
  return steps;
}

class RemedySearch {
 public:
  RemedySearch(const ChangeablePlan& plan, const FeasibilityTest& test, const std::stop_token& stop)
      : plan_(plan), test_(test), scratch_(test.evaluator().MakeScratch()) {
    scratch_.stop = stop;
  }

  PlanRemedies Run(const MissedDemands& missed) {
    PlanRemedies remedies;
    std::vector<int> steps = FootstepsThatMiss(missed);
    if (steps.size() > kMostFootsteps) steps.resize(kMostFootsteps);
    if (steps.size() > 1) remedies.of_all = HeightOrDuration(plan_.usual);
    if (!LegsReach(missed)) TryCrouching(&remedies);
    std::vector<PlanChange> together;
    for (size_t k = 0; k < steps.size(); ++k) {
      remedies.steps.push_back(OfStep(steps[k]));
      const std::vector<PlanChange>& found = remedies.steps.back().found;
      if (!found.empty()) together.push_back(found.front());
      if (together.size() < steps.size()) continue;
      const std::optional<HalfStepSequence> changed = plan_.With(together);
      if (!changed) continue;
      const Feasibility whole = Check(*changed);
      remedies.together = whole.verdict == Verdict::kFeasible;
      // What is missed between the instants that were looked at shows itself now.
      const int next = whole.witness.at.half_step / 2;
      if (!remedies.together && steps.size() < kMostFootsteps &&
          std::ranges::find(steps, next) == steps.end()) {
        steps.push_back(next);
      }
    }
    return Stopped() ? PlanRemedies{} : remedies;
  }

 private:
  bool Stopped() const { return scratch_.stop.stop_requested(); }
  Feasibility Check(const HalfStepSequence& plan) { return CheckPlanned(plan, test_, &scratch_); }

  static bool LegsReach(const MissedDemands& missed) {
    return std::ranges::none_of(missed.demands, [](const MissedDemand& demand) {
      return demand.worst.family == MarginFamily::kReach;
    });
  }

  void TryCrouching(PlanRemedies* remedies) {
    std::vector<PlanChange> changes;
    for (const double by : kLower) changes.push_back({.crouch = *plan_.usual.crouch + by});
    const size_t others = remedies->of_all.size();
    Keep(changes, 1, &remedies->of_all);
    if (remedies->of_all.size() > others) return;
    for (const PlanChange& change : changes) {
      const std::optional<HalfStepSequence> lower = plan_.With({change});
      if (!lower || Stopped()) return;
      const SuperposedWalk walk(*lower, PlannedMotion(*lower));
      if (!LegsReach(FindMissedDemands(test_.evaluator(), walk, Check(*lower).witness))) continue;
      remedies->crouch_to_reach = change.crouch;
      return;
    }
  }

  StepRemedies OfStep(int step) {
    const HalfStep& up = Nth(plan_.sequence.half_steps, 2 * step).half_step;
    const PlanChange planned{.step = step, .duration = up.duration, .via_height = up.via_height};
    StepRemedies remedies{.step = step, .found = HeightOrDuration(planned)};
    if (remedies.found.empty()) Keep(HeightsAndDurations(planned), 1, &remedies.found);
    // The two steps after it begin elsewhere then.
    Keep(Landings(step), 3, &remedies.found);
    return remedies;
  }

  std::vector<PlanChange> HeightOrDuration(const PlanChange& planned) {
    std::vector<PlanChange> heights, durations, found;
    for (const double by : kHigher) {
      heights.push_back({.step = planned.step, .via_height = Higher(planned, by)});
    }
    for (const double by : kTimesLonger) {
      durations.push_back({.step = planned.step, .duration = Longer(planned, by)});
    }
    Keep(heights, 1, &found);
    Keep(durations, 1, &found);
    return found;
  }

  // A higher via point needs more time.
  static std::vector<PlanChange> HeightsAndDurations(const PlanChange& planned) {
    std::vector<PlanChange> changes;
    for (const double longer : kTimesLongerAndHigher) {
      for (const double higher : kHigherAndLonger) {
        changes.push_back({.step = planned.step,
                           .duration = Longer(planned, longer),
                           .via_height = Higher(planned, higher)});
      }
    }
    return changes;
  }

  // Farther or nearer on its way.
  std::vector<PlanChange> Landings(int step) const {
    const auto& [up, X_WS, rest] = Nth(plan_.sequence.half_steps, 2 * step);
    const Foothold from = X_WS * up.X_SF;
    const Foothold to = Nth(StanceAfter(plan_.sequence, 2 * step), Index(up.swing()));
    const Eigen::Vector2d way(to.x - from.x, to.y - from.y);
    if (way.norm() < 0.01) return {};  // it steps in place
    const Ground& ground = *test_.evaluator().scene().ground;
    std::vector<PlanChange> changes;
    for (const double farther : kFarther) {
      const Eigen::Vector2d shift = farther * way.normalized();
      const double x = Rounded(to.x + shift.x(), 0.001), y = Rounded(to.y + shift.y(), 0.001);
      if (!ground.Standing(test_.evaluator().robot().sole_outline, {x, y, to.yaw})) continue;
      changes.push_back({.step = step, .landing = Eigen::Vector2d(x, y), .farther = farther});
    }
    return changes;
  }

  // The first of the changes with which the step and those behind it, `steps` in all, are feasible
  // by themselves; without a step, all of them.
  void Keep(const std::vector<PlanChange>& changes, int steps, std::vector<PlanChange>* found) {
    const auto helps = [&](const PlanChange& change) {
      if (Stopped() || !ChangeRange().Contains(change)) return false;
      std::optional<HalfStepSequence> plan = plan_.With({change});
      if (!plan) return false;
      if (change.step) {
        const int end = std::min(*change.step + steps, plan->num_steps());
        plan = PlannedPart(*plan, 2 * *change.step, 2 * end);
      }
      return Check(*plan).verdict == Verdict::kFeasible;
    };
    const auto first = std::ranges::find_if(changes, helps);
    if (first != changes.end()) found->push_back(*first);
  }

  const ChangeablePlan& plan_;
  const FeasibilityTest& test_;
  MarginEvaluator::Scratch scratch_;
};

}  // namespace

PlanRemedies FindRemedies(const ChangeablePlan& plan, const FeasibilityTest& test,
                          const MissedDemands& missed, const std::stop_token& stop) {
  if (!test.evaluator().scene().rests()) return {};
  return RemedySearch(plan, test, stop).Run(missed);
}

}  // namespace halfstep
