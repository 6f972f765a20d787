#include "smoothing/methods/dichotomy.h"

#include <optional>

#include "smoothing/methods/stopwatch.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/check.h"

namespace halfstep {
namespace {

using opt::Ending;

class Bisection {
 public:
  Bisection(const HalfStepSequence& sequence, const FeasibilityTest& test,
            const DichotomyOptions& options, std::stop_token stop)
      : sequence_(sequence),
        test_(test),
        options_(options),
        stop_(std::move(stop)),
        walk_(sequence, options.start.value_or(PlannedMotion(sequence))),
        scratch_(test.evaluator().MakeScratch()) {
    for (int i = 0; i < sequence.num_junctions(); ++i) {
      const JunctionKind kind = KindOfJunction(i);
      const double cap = kind == JunctionKind::kUpDown ? options.up_down_cap : options.down_up_cap;
      const double bound = NaturalOverlapBound(sequence, walk_.parameters().durations, i);
      const double overlap = walk_.parameters().overlaps[static_cast<size_t>(i)];
      result_.junctions.push_back({.kind = kind, .overlap = overlap, .upper_bound = cap * bound});
    }
    result_.evidence = test.evidence();
  }

  SmoothingResult Run(const std::function<void(double)>& progress) {
    const Feasibility start = test_.Check(walk_, {0.0, walk_.duration()}, &scratch_);
    if (start.stopped) {
      result_.message = "stopped from outside before the start was looked at";
      return Finish(Ending::kNotRun);
    }
    if (start.verdict != Verdict::kFeasible) {
      result_.message = std::string(options_.start ? "the start" : "the planned motion") +
                        " is not feasible: " + test_.evaluator().Describe(start.witness);
      return Finish(Ending::kNotRun);
    }
    result_.feasible = true;
    const int n = sequence_.num_junctions();
    for (int pass = 0; pass < options_.passes; ++pass) {
      for (int k = 0; k < n; ++k) {
        const bool forward = options_.order == DichotomyOptions::Order::kLeftToRight;
        if (!BisectJunction(forward ? k : n - 1 - k)) {
          result_.message = "stopped from outside; the overlaps found so far are feasible";
          return Finish(result_.iterates.empty() ? Ending::kNotRun : Ending::kInterrupted);
        }
        if (progress) progress(static_cast<double>(pass * n + k + 1) / (options_.passes * n));
      }
    }
    result_.message = "every junction bisected to " + std::to_string(options_.tolerance) + " s";
    return Finish(Ending::kConverged);
  }

 private:
  // False when asked to stop.
  bool BisectJunction(int junction) {
    JunctionResult& result = result_.junctions[static_cast<size_t>(junction)];
    double feasible = result.overlap;
    double infeasible = result.upper_bound;
    if (feasible >= infeasible) return !stop_.stop_requested();
    // The bound itself first; after that only what lies between counts.
    std::optional<Margin> refused = Try(junction, infeasible, feasible);
    if (!refused) {
      result.overlap = infeasible;
      result.limited_by.reset();
      return !stop_.stop_requested();
    }
    while (infeasible - feasible > options_.tolerance && !stop_.stop_requested()) {
      const double middle = 0.5 * (feasible + infeasible);
      const std::optional<Margin> refusal = Try(junction, middle, feasible);
      if (refusal) {
        infeasible = middle;
        refused = refusal;
      } else {
        feasible = middle;
      }
    }
    walk_.SetOverlap(junction, feasible);
    result.overlap = feasible;
    result.limited_by = refused;
    return !stop_.stop_requested();
  }

  // Leaves the walk at the candidate and returns what refuses it, if anything does.
  std::optional<Margin> Try(int junction, double candidate, double incumbent) {
    walk_.SetOverlap(junction, incumbent);
    const double incumbent_duration = walk_.duration();
    walk_.SetOverlap(junction, candidate);
    // Just before t_{i+1}: an interval that ends there is cut anew, also where e_i = t_{i+2} and
    // the window would be a whole stretch.
    const TimeWindow window{std::nextafter(walk_.start_of(junction + 1), -1.0),
                            walk_.end_of(junction)};
    const Feasibility answer = test_.Check(walk_, window, &scratch_);
    const bool accepted = answer.verdict == Verdict::kFeasible;
    SmoothingIterate iterate{
        .wall = stopwatch_.Seconds(),
        .evaluations = scratch_.instants,
        .candidate_duration = walk_.duration(),
        .accepted = accepted,
        .lambda = accepted ? 1.0 : 0.0,
        .incumbent_duration = accepted ? walk_.duration() : incumbent_duration};
    if (accepted) {
      if (!result_.time_to_first_improvement) result_.time_to_first_improvement = iterate.wall;
    } else if (answer.verdict == Verdict::kViolated) {
      iterate.candidate_slack = test_.evaluator().limits().Slack(answer.witness);
    }
    result_.iterates.push_back(iterate);
    if (accepted) return std::nullopt;
    return answer.witness;
  }

  SmoothingResult Finish(Ending ending) {
    const bool improved = result_.time_to_first_improvement.has_value();
    result_.ending = improved || ending == Ending::kNotRun ? ending : Ending::kNoImprovement;
    if (result_.ending == Ending::kNoImprovement) result_.message += "; none could be made longer";
    result_.parameters = walk_.parameters();
    result_.cost = walk_.duration();
    result_.instants = scratch_.instants;
    result_.collision_queries = scratch_.bodies.queries;
    result_.wall = stopwatch_.Seconds();
    return std::move(result_);
  }

  const HalfStepSequence& sequence_;
  const FeasibilityTest& test_;
  const DichotomyOptions& options_;
  std::stop_token stop_;
  SuperposedWalk walk_;
  MarginEvaluator::Scratch scratch_;
  Stopwatch stopwatch_;
  SmoothingResult result_;
};

}  // namespace

SmoothingResult Dichotomy(const HalfStepSequence& sequence, const FeasibilityTest& test,
                          const DichotomyOptions& options,
                          const std::function<void(double)>& progress, std::stop_token stop) {
  HALFSTEP_CHECK(options.tolerance > 0.0 && options.passes >= 0,
                 "tolerance = " << options.tolerance << ", passes = " << options.passes);
  HALFSTEP_CHECK(options.up_down_cap >= 0.0 && options.up_down_cap <= 1.0 &&
                     options.down_up_cap >= 0.0 && options.down_up_cap <= 1.0,
                 "caps " << options.up_down_cap << ", " << options.down_up_cap);
  return Bisection(sequence, test, options, std::move(stop)).Run(progress);
}

}  // namespace halfstep
