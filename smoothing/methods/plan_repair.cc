#include "smoothing/methods/plan_repair.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "smoothing/proof/sampled_feasibility.h"
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
  Repair(const HalfStepSequence& plan, const FeasibilityTest& test, const RepairRange& range,
         const std::stop_token& stop)
      : plan_(plan), test_(test), range_(range), scratch_(test.evaluator().MakeScratch()) {
    scratch_.stop = stop;
    result_.sequence = plan;
  }

  PlanRepair Run() {
    if (!test_.evaluator().scene().rests()) {
      result_.failures.push_back("among obstacles that move no step can be looked at by itself");
      return std::move(result_);
    }
    for (int step = 0; step < plan_.num_steps() && !Stopped(); ++step) RepairStep(step);
    if (result_.failures.empty() && !Stopped()) {
      const SuperposedWalk walk(result_.sequence, PlannedMotion(result_.sequence));
      const Feasibility whole = test_.Check(walk, {0.0, walk.duration()}, &scratch_);
      if (whole.verdict != Verdict::kFeasible) {
        result_.failures.push_back("the repaired plan is not feasible as a whole: " +
                                   test_.evaluator().Describe(whole.witness));
      }
    }
    result_.stopped = Stopped();
    return std::move(result_);
  }

 private:
  bool Stopped() const { return scratch_.stop.stop_requested(); }

  // The step with another duration and height, by itself.
  HalfStepSequence Alone(int step, double duration, double height) const {
    HalfStepSequence alone = plan_;
    const auto first = plan_.half_steps.begin() + 2 * step;
    alone.half_steps.assign(first, first + 2);
    const PlacedHalfStep& up = alone.half_steps.front();
    Nth(alone.start, Index(up.half_step.support)) = up.X_WS;
    Nth(alone.start, Index(up.half_step.swing())) = up.X_WS * up.half_step.X_SF;
    Change(duration, height, &alone.half_steps[0]);
    Change(duration, height, &alone.half_steps[1]);
    return alone;
  }

  static void Change(double duration, double height, PlacedHalfStep* placed) {
    placed->half_step.duration = duration;
    placed->half_step.via_height = height;
  }

  bool Proved(int step, double duration, double height) {
    const HalfStepSequence alone = Alone(step, duration, height);
    const SuperposedWalk walk(alone, PlannedMotion(alone));
    return test_.Check(walk, {0.0, walk.duration()}, &scratch_).verdict == Verdict::kFeasible;
  }

  // The margin with the least slack at samples of the step.
  Margin Worst(int step, double duration, double height) {
    const HalfStepSequence alone = Alone(step, duration, height);
    const SuperposedWalk walk(alone, PlannedMotion(alone));
    return WorstOf(SampleMargins(test_.evaluator(), walk, kPeriod, &scratch_),
                   test_.evaluator().limits());
  }

  double Slack(const Margin& margin) const { return test_.evaluator().limits().Slack(margin); }

  // What the robot misses where it stands at rest on both feet, before or after the step.
  std::optional<Margin> MissedAtRest(int step) {
    const HalfStep& half_step = Nth(plan_.half_steps, 2 * step).half_step;
    const HalfStepSequence alone = Alone(step, half_step.duration, half_step.via_height);
    const SuperposedWalk walk(alone, PlannedMotion(alone));
    for (const double t : {0.0, walk.duration()}) {
      const Margin worst = WorstOf(test_.evaluator().At(walk, walk.Locate(t), &scratch_),
                                   test_.evaluator().limits());
      if (Slack(worst) < 0.0) return worst;
    }
    return std::nullopt;
  }

  void RepairStep(int step) {
    const HalfStep& planned = Nth(plan_.half_steps, 2 * step).half_step;
    if (Proved(step, planned.duration, planned.via_height) || Stopped()) return;
    PlainStream why;
    why << "footstep " << step + 1;
    if (const std::optional<Margin> missed = MissedAtRest(step)) {
      why << " cannot be made at any duration and height: " << Told(*missed);
      result_.failures.push_back(why.str());
      return;
    }
    Margin least_missed;
    double least_slack = -std::numeric_limits<double>::infinity();
    for (const double longer : kDurations) {
      for (const double higher : kHeights) {
        const double duration = longer * planned.duration, height = higher * planned.via_height;
        if (Stopped()) return;
        if (duration > range_.most_duration) continue;
        if (height < range_.least_height || height > range_.most_height) continue;
        const Margin worst = Worst(step, duration, height);
        if (Slack(worst) > least_slack) {
          least_slack = Slack(worst);
          least_missed = worst;
        }
        if (Slack(worst) < kWorthProving || !Proved(step, duration, height)) continue;
        Keep(step, Shortest(step, planned.duration, duration, height), height);
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
    told << Name(margin.family) << " of " << test_.evaluator().Subject(margin) << " ";
    if (!std::isfinite(margin.value)) {
      told << "cannot be told, since a leg does not reach or is stretched";
      return told.str();
    }
    told << margin.value << " " << Unit(margin.family) << ", "
         << test_.evaluator().limits().demanded_of(margin.family) << " demanded";
    return told.str();
  }

  // Between a duration that may be too short and one that was proved at this height.
  double Shortest(int step, double shorter, double proved, double height) {
    double refused = shorter;
    if (proved <= shorter) return proved;
    while (proved - refused > kDurationStep * proved && !Stopped()) {
      const double middle = 0.5 * (refused + proved);
      (Proved(step, middle, height) ? proved : refused) = middle;
    }
    return proved;
  }

  void Keep(int step, double duration, double height) {
    const size_t up = static_cast<size_t>(2 * step);
    Change(duration, height, &result_.sequence.half_steps[up]);
    Change(duration, height, &result_.sequence.half_steps[up + 1]);
    result_.steps.push_back({step, duration, height});
  }

  const HalfStepSequence& plan_;
  const FeasibilityTest& test_;
  const RepairRange& range_;
  MarginEvaluator::Scratch scratch_;
  PlanRepair result_;
};

}  // namespace

PlanRepair RepairPlan(const HalfStepSequence& plan, const FeasibilityTest& test,
                      const RepairRange& range, const std::stop_token& stop) {
  return Repair(plan, test, range, stop).Run();
}

}  // namespace halfstep
