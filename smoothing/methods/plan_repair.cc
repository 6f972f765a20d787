#include "smoothing/methods/plan_repair.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "smoothing/proof/sampled_feasibility.h"
#include "smoothing/walk/splice.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/files/plain_locale.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// Of the planned duration and height: what is tried, in this order.
constexpr double kDurations[] = {1.0, 1.15, 1.3, 1.5, 1.75, 2.0, 2.5, 3.0};
constexpr double kHeights[] = {1.0, 1.2, 1.5, 2.0, 0.8, 0.6, 0.4};
constexpr double kPeriod = 0.02;         // of samples [s]
constexpr double kWorthProving = -1e-9;  // a least slack below it is not worth a proof
constexpr double kDurationStep = 0.01;   // of the duration: how finely it is lowered

class Repair {
 public:
  Repair(const HalfStepSequence& plan, const FeasibilityTest& test, const ChangeRange& range,
         const std::stop_token& stop)
      : plan_(plan), test_(test), range_(range), scratch_(test.evaluator().MakeScratch()) {
    scratch_.stop = stop;
    result_.sequence = plan;
  }

  PlanRepair Run() {
    if (!evaluator().scene().rests()) {
      result_.failures.push_back("among obstacles that move no step can be looked at by itself");
      return std::move(result_);
    }
    for (int step = 0; step < plan_.num_steps() && !Stopped(); ++step) RepairStep(step);
    if (result_.failures.empty() && !Stopped()) {
      const Feasibility whole = CheckPlanned(result_.sequence, test_, &scratch_);
      if (whole.verdict != Verdict::kFeasible) {
        result_.failures.push_back("the repaired plan is not feasible as a whole: " +
                                   evaluator().Describe(whole.witness));
      }
    }
    result_.stopped = Stopped();
    return std::move(result_);
  }

 private:
  bool Stopped() const { return scratch_.stop.stop_requested(); }
  const MarginEvaluator& evaluator() const { return test_.evaluator(); }

  // A step as planned.
  PlanChange Planned(int step) const {
    const HalfStep& up = Nth(plan_.half_steps, 2 * step).half_step;
    return {.step = step, .duration = up.duration, .via_height = up.via_height};
  }

  // The changed step by itself.
  HalfStepSequence Alone(const PlanChange& change) const {
    HalfStepSequence alone = PlannedPart(plan_, 2 * *change.step, 2 * *change.step + 2);
    for (PlacedHalfStep& placed : alone.half_steps) Change(change, &placed);
    return alone;
  }

  static void Change(const PlanChange& change, PlacedHalfStep* placed) {
    placed->half_step.duration = *change.duration;
    placed->half_step.via_height = *change.via_height;
  }

  bool Proved(const PlanChange& change) {
    return CheckPlanned(Alone(change), test_, &scratch_).verdict == Verdict::kFeasible;
  }

  // The margin with the least slack at samples of the step.
  Margin Worst(const PlanChange& change) {
    const HalfStepSequence alone = Alone(change);
    const SuperposedWalk walk(alone, PlannedMotion(alone));
    return WorstOf(SampleMargins(evaluator(), walk, kPeriod, &scratch_), evaluator().limits());
  }

  double Slack(const Margin& margin) const { return evaluator().limits().Slack(margin); }

  // What the robot misses where it stands at rest on both feet, before or after the step.
  std::optional<Margin> MissedAtRest(const PlanChange& planned) {
    const HalfStepSequence alone = Alone(planned);
    const SuperposedWalk walk(alone, PlannedMotion(alone));
    for (const double t : {0.0, walk.duration()}) {
      const Margin worst =
          WorstOf(evaluator().At(walk, walk.Locate(t), &scratch_), evaluator().limits());
      if (Slack(worst) < 0.0) return worst;
    }
    return std::nullopt;
  }

  void RepairStep(int step) {
    const PlanChange planned = Planned(step);
    if (Proved(planned) || Stopped()) return;
    PlainStream why;
    why << "footstep " << step + 1;
    if (const std::optional<Margin> missed = MissedAtRest(planned)) {
      why << " cannot be made at any duration and height: " << Told(*missed);
      result_.failures.push_back(why.str());
      return;
    }
    Margin least_missed;
    double least_slack = -std::numeric_limits<double>::infinity();
    for (const double longer : kDurations) {
      for (const double higher : kHeights) {
        const PlanChange change{.step = step,
                                .duration = longer * *planned.duration,
                                .via_height = higher * *planned.via_height};
        if (Stopped()) return;
        if (!range_.Contains(change) || LeastHeightScale(Alone(change), 0) > 1.0) continue;
        const Margin worst = Worst(change);
        if (Slack(worst) > least_slack) {
          least_slack = Slack(worst);
          least_missed = worst;
        }
        if (Slack(worst) < kWorthProving || !Proved(change)) continue;
        Keep(Shortest(*planned.duration, change));
        return;
      }
    }
    why << ": nothing was found up to " << range_.most_duration << " s, at heights from "
        << kHeights[std::size(kHeights) - 1]
        << " to 2 times the planned; missed least: " << Told(least_missed);
    result_.failures.push_back(why.str());
  }

  // "reach of left leg −0.031 m, 0 demanded"
  std::string Told(const Margin& margin) const {
    PlainStream told;
    told << Name(margin.family) << " of " << evaluator().Subject(margin) << " ";
    if (!std::isfinite(margin.value)) {
      told << "cannot be told, since a leg does not reach or is stretched";
      return told.str();
    }
    told << margin.value << " " << Unit(margin.family) << ", "
         << evaluator().limits().demanded_of(margin.family) << " demanded";
    return told.str();
  }

  // Between a duration that may be too short and that of a change that was proved.
  PlanChange Shortest(double refused, PlanChange proved) {
    while (*proved.duration - refused > kDurationStep * *proved.duration && !Stopped()) {
      PlanChange middle = proved;
      middle.duration = 0.5 * (refused + *proved.duration);
      if (Proved(middle)) {
        proved = middle;
      } else {
        refused = *middle.duration;
      }
    }
    return proved;
  }

  void Keep(const PlanChange& change) {
    for (const int i : {2 * *change.step, 2 * *change.step + 1}) {
      Change(change, &Nth(result_.sequence.half_steps, i));
    }
    result_.steps.push_back(change);
  }

  const HalfStepSequence& plan_;
  const FeasibilityTest& test_;
  const ChangeRange& range_;
  MarginEvaluator::Scratch scratch_;
  PlanRepair result_;
};

}  // namespace

Feasibility CheckPlanned(const HalfStepSequence& plan, const FeasibilityTest& test,
                         MarginEvaluator::Scratch* scratch) {
  const SuperposedWalk walk(plan, PlannedMotion(plan));
  return test.Check(walk, {0.0, walk.duration()}, scratch);
}

PlanRepair RepairPlan(const HalfStepSequence& plan, const FeasibilityTest& test,
                      const ChangeRange& range, const std::stop_token& stop) {
  return Repair(plan, test, range, stop).Run();
}

}  // namespace halfstep
