#include "smoothing/methods/coordinate_ascent.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "smoothing/methods/stopwatch.h"
#include "smoothing/program/overlap_program.h"
#include "smoothing/proof/stretch_proofs.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/check.h"

namespace halfstep {
namespace {

using opt::Ending;

// Factors of η that are tried, besides the least allowed.
constexpr double kHeightFactors[] = {0.5, 0.75, 0.9, 1.1, 1.3};

class Ascent {
 public:
  Ascent(const HalfStepSequence& sequence, const FeasibilityTest& test,
         const CoordinateAscentOptions& options, std::stop_token stop)
      : sequence_(sequence),
        test_(test),
        options_(options),
        stop_(std::move(stop)),
        planned_(PlannedMotion(sequence)),
        point_(options.start.value_or(planned_)),
        scratch_(test.evaluator().MakeScratch()),
        proofs_(test, sequence.size()) {
    result_.evidence = test.evidence();
    for (int i = 0; i < sequence.num_junctions(); ++i) {
      result_.junctions.push_back({.kind = KindOfJunction(i)});
    }
  }

  SmoothingResult Run(const std::function<void(double)>& progress) {
    const SuperposedWalk walk(sequence_, point_);
    const Feasibility start = test_.Check(walk, {0.0, walk.duration()}, &scratch_);
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
    for (int pass = 0; pass < options_.passes; ++pass) {
      const double before = DurationOf(point_);
      for (int step = 0; step < sequence_.num_steps(); ++step) {
        Improve(step);
        if (options_.heights) TryHeights(step);
        if (stop_.stop_requested()) {
          result_.message = "stopped from outside; the parameters found so far are feasible";
          return Finish(Ending::kInterrupted);
        }
        if (progress) {
          progress((pass + (step + 1.0) / sequence_.num_steps()) / options_.passes);
        }
      }
      const double now = DurationOf(point_);
      result_.iterates.push_back({.wall = stopwatch_.Seconds(),
                                  .evaluations = scratch_.instants,
                                  .candidate_duration = now,
                                  .accepted = now < before,
                                  .lambda = now < before ? 1.0 : 0.0,
                                  .incumbent_duration = now,
                                  .incumbent_cost = now});
      if (now < before && !result_.time_to_first_improvement) {
        result_.time_to_first_improvement = stopwatch_.Seconds();
      }
      if (before - now < options_.tolerance) {
        result_.message = "a pass gained less than " + std::to_string(options_.tolerance) + " s";
        return Finish(Ending::kConverged);
      }
    }
    result_.message = "all passes done, the last one still gained";
    return Finish(Ending::kLimit);
  }

 private:
  // Overlaps and durations of a step and the junctions beside it.
  void Improve(int step) {
    const int up = 2 * step;
    if (options_.durations) {
      for (int i : {up, up + 1}) {
        LowerDuration(i, false);
        LowerDuration(i, true);
      }
    }
    for (int i = std::max(up - 1, 0); i <= std::min(up + 1, sequence_.num_junctions() - 1); ++i) {
      RaiseOverlap(i);
    }
  }

  void RaiseOverlap(int i) {
    const size_t j = static_cast<size_t>(i);
    HomotopyParameters target = point_;
    target.overlaps[j] = NaturalOverlapBound(sequence_, point_.durations, i);
    result_.junctions[j].limited_by = MoveTowards(target);
  }

  void LowerDuration(int i, bool scale) {
    const size_t k = static_cast<size_t>(i);
    HomotopyParameters target = point_;
    target.durations[k] =
        std::min(point_.durations[k], options_.least_duration * planned_.durations[k]);
    if (scale) {
      const double factor = target.durations[k] / point_.durations[k];
      if (i > 0) target.overlaps[k - 1] *= factor;
      if (i < sequence_.num_junctions()) target.overlaps[k] *= factor;
    }
    MoveTowards(target);
  }

  // Bisects between the point and a target; what refused it where it ends. Only points that last
  // less are asked about.
  std::optional<Margin> MoveTowards(const HomotopyParameters& target) {
    const double length = Distance(target);
    std::optional<Margin> refused;
    const HomotopyParameters from = point_;
    double feasible = 0.0, infeasible = 1.0;
    if (length <= 0.0) return refused;
    for (double lambda = 1.0;; lambda = 0.5 * (feasible + infeasible)) {
      const HomotopyParameters candidate = Between(from, target, lambda);
      std::optional<Margin> refusal;
      if (DurationOf(candidate) < DurationOf(point_)) {
        refusal = Refusal(candidate);
        if (refusal) refused = refusal;
        if (!refusal) point_ = candidate;
      } else if (lambda == 1.0) {
        return refused;  // a line on which durations fall linearly: nothing to gain
      }
      (refusal ? infeasible : feasible) = lambda;
      if (lambda == 1.0 && !refusal) return refused;
      if ((infeasible - feasible) * length <= options_.tolerance || stop_.stop_requested()) {
        return refused;
      }
    }
  }

  // The largest change of a time along the way [s].
  double Distance(const HomotopyParameters& target) const {
    double distance = 0.0;
    for (size_t i = 0; i < target.overlaps.size(); ++i) {
      distance = std::max(distance, std::abs(target.overlaps[i] - point_.overlaps[i]));
    }
    for (size_t i = 0; i < target.durations.size(); ++i) {
      distance = std::max(distance, std::abs(target.durations[i] - point_.durations[i]));
    }
    return distance;
  }

  HomotopyParameters Between(const HomotopyParameters& from, const HomotopyParameters& to,
                             double lambda) const {
    HomotopyParameters point = from;
    for (size_t i = 0; i < point.overlaps.size(); ++i) {
      point.overlaps[i] += lambda * (to.overlaps[i] - from.overlaps[i]);
    }
    for (size_t i = 0; i < point.durations.size(); ++i) {
      point.durations[i] += lambda * (to.durations[i] - from.durations[i]);
    }
    for (int i = 0; i < sequence_.num_junctions(); ++i) {
      double& overlap = point.overlaps[static_cast<size_t>(i)];
      overlap = std::min(overlap, NaturalOverlapBound(sequence_, point.durations, i));
    }
    return point;
  }

  std::optional<Margin> Refusal(const HomotopyParameters& candidate) {
    const std::vector<Margin> refusals =
        proofs_.Refusals(SuperposedWalk(sequence_, candidate), &scratch_);
    if (refusals.empty()) return std::nullopt;
    return refusals.front();
  }

  void TryHeights(int step) {
    const size_t j = static_cast<size_t>(step);
    const double now = point_.height_scales[j];
    std::vector<double> candidates = {options_.least_height_scale};
    for (double factor : kHeightFactors) {
      const double eta = factor * now;
      if (eta > options_.least_height_scale && eta < 1.0) candidates.push_back(eta);
    }
    if (now < 1.0) candidates.push_back(1.0);
    const std::vector<JunctionResult> junctions = result_.junctions;
    const HomotopyParameters before = point_;
    HomotopyParameters best = before;
    std::vector<JunctionResult> best_junctions = junctions;
    for (double eta : candidates) {
      point_ = before;
      result_.junctions = junctions;
      HomotopyParameters candidate = before;
      candidate.height_scales[j] = eta;
      if (!Refusal(candidate)) {
        point_ = candidate;
        Improve(step);
      }
      if (DurationOf(point_) < DurationOf(best) - options_.tolerance) {
        best = point_;
        best_junctions = result_.junctions;
      }
      if (stop_.stop_requested()) break;
    }
    point_ = best;
    result_.junctions = best_junctions;
  }

  SmoothingResult Finish(Ending ending) {
    const bool ran = ending != Ending::kNotRun;
    const bool improved = DurationOf(point_) < DurationOf(options_.start.value_or(planned_));
    if (ran && !improved) result_.message += "; no coordinate gained";
    for (int i = 0; i < sequence_.num_junctions(); ++i) {
      JunctionResult& junction = result_.junctions[static_cast<size_t>(i)];
      junction.overlap = point_.overlaps[static_cast<size_t>(i)];
      junction.upper_bound = NaturalOverlapBound(sequence_, point_.durations, i);
    }
    result_.ending = ran && !improved ? Ending::kNoImprovement : ending;
    result_.parameters = point_;
    result_.cost = DurationOf(point_);
    result_.instants = scratch_.instants;
    result_.collision_queries = scratch_.bodies.queries;
    result_.wall = stopwatch_.Seconds();
    return std::move(result_);
  }

  const HalfStepSequence& sequence_;
  const FeasibilityTest& test_;
  const CoordinateAscentOptions& options_;
  std::stop_token stop_;
  HomotopyParameters planned_;
  HomotopyParameters point_;  // always found feasible
  MarginEvaluator::Scratch scratch_;
  StretchProofs proofs_;
  Stopwatch stopwatch_;
  SmoothingResult result_;
};

}  // namespace

SmoothingResult CoordinateAscent(const HalfStepSequence& sequence, const FeasibilityTest& test,
                                 const CoordinateAscentOptions& options,
                                 const std::function<void(double)>& progress,
                                 std::stop_token stop) {
  HALFSTEP_CHECK(options.tolerance > 0.0 && options.passes >= 1,
                 "tolerance = " << options.tolerance << ", passes = " << options.passes);
  return Ascent(sequence, test, options, std::move(stop)).Run(progress);
}

}  // namespace halfstep
