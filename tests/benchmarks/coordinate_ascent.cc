#include "tests/benchmarks/coordinate_ascent.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "smoothing/methods/accepted_in_parts.h"
#include "smoothing/proof/stretch_proofs.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/check.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

using opt::Ending;

// Factors of η that are tried, besides the least allowed.
constexpr double kHeightFactors[] = {0.5, 0.75, 0.9, 1.1, 1.3};

class Ascent {
 public:
  Ascent(const WalkProblem& problem, const CoordinateAscentOptions& options,
         SmoothingMonitor& monitor)
      : sequence_(problem.sequence()),
        problem_(problem),
        options_(options),
        monitor_(monitor),
        table_(problem.Parameters(options.parameters)),
        point_(options.start.value_or(problem.Start())),
        proofs_(problem.test(), sequence_.size()) {}

  SmoothingResult Run() {
    constexpr char kNoGain[] = "; no coordinate gained";
    if (!monitor_.BeginFeasibly(problem_, point_)) return monitor_.Refusal();
    for (int pass = 0; pass < options_.passes; ++pass) {
      const double before = DurationOf(point_);
      for (int step = 0; step < sequence_.num_steps(); ++step) {
        Improve(step);
        TryHeights(step);
        if (monitor_.stopped()) {
          Keep();
          return monitor_.FinishAgainstStart(
              monitor_.StopEnding(),
              monitor_.StopReason() + "; the parameters found so far are feasible", kNoGain);
        }
        monitor_.Progress((pass + (step + 1.0) / sequence_.num_steps()) / options_.passes);
      }
      const double now = DurationOf(point_);
      Keep();
      monitor_.Record({.candidate_duration = now,
                       .accepted = now < before,
                       .lambda = now < before ? 1.0 : 0.0});
      if (before - now < options_.tolerance) {
        return monitor_.FinishAgainstStart(
            Ending::kConverged, Formatted("a pass gained less than %f s", options_.tolerance),
            kNoGain);
      }
    }
    return monitor_.FinishAgainstStart(Ending::kLimit, "all passes done, the last one still gained",
                                       kNoGain);
  }

 private:
  using Family = ParameterFamily;

  void Keep() {
    monitor_.Adopt(AcceptedInParts::Walk(point_), DurationOf(point_), DurationOf(point_));
  }

  // Overlaps and durations of a step and the junctions beside it.
  void Improve(int step) {
    const int up = 2 * step;
    for (int i : {up, up + 1}) {
      if (!table_.free({Family::kDuration, i})) continue;
      LowerDuration(i, false);
      LowerDuration(i, true);
    }
    for (int i = std::max(up - 1, 0); i <= std::min(up + 1, sequence_.num_junctions() - 1); ++i) {
      if (table_.free({Family::kOverlap, i})) RaiseOverlap(i);
    }
  }

  void RaiseOverlap(int i) {
    const size_t j = static_cast<size_t>(i);
    HomotopyParameters target = point_;
    target.overlaps[j] = NaturalOverlapBound(point_, i);
    monitor_.result().junctions[j].limited_by = MoveTowards(target);
  }

  void LowerDuration(int i, bool scale) {
    const size_t k = static_cast<size_t>(i);
    HomotopyParameters target = point_;
    target.durations[k] = std::min(point_.durations[k], table_.row({Family::kDuration, i}).lower);
    if (scale) {
      const double factor = target.durations[k] / point_.durations[k];
      for (int junction : {i - 1, i}) {
        if (junction < 0 || junction >= sequence_.num_junctions()) continue;
        if (!table_.free({Family::kOverlap, junction})) continue;
        target.overlaps[static_cast<size_t>(junction)] *= factor;
      }
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
      if ((infeasible - feasible) * length <= options_.tolerance || monitor_.stopped()) {
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
    ClampOverlaps(from, &point);
    return point;
  }

  std::optional<Margin> Refusal(const HomotopyParameters& candidate) {
    const std::vector<Margin> refusals =
        proofs_.Refusals(SuperposedWalk(sequence_, candidate), monitor_.scratch());
    if (refusals.empty()) return std::nullopt;
    return refusals.front();
  }

  void TryHeights(int step) {
    const ParameterRow& row = table_.row({Family::kHeightScale, step});
    if (row.fixed) return;
    const size_t j = static_cast<size_t>(step);
    const double now = point_.height_scales[j];
    std::vector<double> candidates = {row.lower};
    for (double factor : kHeightFactors) {
      const double eta = factor * now;
      if (eta > row.lower && eta < row.upper) candidates.push_back(eta);
    }
    if (now < row.upper) candidates.push_back(row.upper);
    const std::vector<JunctionResult> junctions = monitor_.result().junctions;
    const HomotopyParameters before = point_;
    HomotopyParameters best = before;
    std::vector<JunctionResult> best_junctions = junctions;
    for (double eta : candidates) {
      point_ = before;
      monitor_.result().junctions = junctions;
      HomotopyParameters candidate = before;
      candidate.height_scales[j] = eta;
      if (!Refusal(candidate)) {
        point_ = candidate;
        Improve(step);
      }
      if (DurationOf(point_) < DurationOf(best) - options_.tolerance) {
        best = point_;
        best_junctions = monitor_.result().junctions;
      }
      if (monitor_.stopped()) break;
    }
    point_ = best;
    monitor_.result().junctions = best_junctions;
  }

  const HalfStepSequence& sequence_;
  const WalkProblem& problem_;
  const CoordinateAscentOptions& options_;
  SmoothingMonitor& monitor_;
  ParameterTable table_;
  HomotopyParameters point_;  // always found feasible
  StretchProofs proofs_;
};

}  // namespace

SmoothingResult CoordinateAscent(const WalkProblem& problem, const CoordinateAscentOptions& options,
                                 SmoothingMonitor& monitor) {
  HALFSTEP_CHECK(options.tolerance > 0.0 && options.passes >= 1,
                 "tolerance = " << options.tolerance << ", passes = " << options.passes);
  return Ascent(problem, options, monitor).Run();
}

}  // namespace halfstep
