#include "smoothing/methods/uniform_scan.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/stopwatch.h"
#include "smoothing/program/overlap_program.h"
#include "wpg/check.h"

namespace halfstep {
namespace {

using opt::Ending;

// Where the start is tried and found feasible.
struct GridPoint {
  double duration = 1.0, height = 1.0;  // factors
  SmoothingResult smoothed;
};

// 1, then outwards by `step` as far as [least, most].
std::vector<double> Factors(double least, double most, double step, bool scan) {
  std::vector<double> factors = {1.0};
  if (!scan) return factors;
  constexpr double kRounding = 1e-9;
  for (int i = 1; 1.0 - i * step >= least - kRounding; ++i) factors.push_back(1.0 - i * step);
  for (int i = 1; 1.0 + i * step <= most + kRounding; ++i) factors.push_back(1.0 + i * step);
  return factors;
}

class Scan {
 public:
  Scan(const HalfStepSequence& sequence, const FeasibilityTest& test,
       const UniformScanOptions& options, std::stop_token stop)
      : sequence_(sequence), test_(test), options_(options), stop_(std::move(stop)) {}

  SmoothingResult Run(const std::function<void(double)>& progress) {
    result_.evidence = test_.evidence();
    result_.parameters = PlannedMotion(sequence_);
    const auto durations = Factors(options_.least_duration, options_.most_duration,
                                   options_.duration_step, options_.durations);
    const auto heights =
        Factors(options_.least_height, 1.0, options_.height_step, options_.heights);
    const double count = static_cast<double>(durations.size() * heights.size());
    double done = 0.0;
    for (double duration : durations) {
      for (double height : heights) {
        Try({duration, height, {}});
        if (stop_.stop_requested()) return Finish();
        if (progress) progress(0.8 * ++done / count);
      }
    }
    std::stable_sort(points_.begin(), points_.end(), [](const GridPoint& a, const GridPoint& b) {
      return a.smoothed.cost < b.smoothed.cost;
    });
    const size_t finalists = std::min(points_.size(), static_cast<size_t>(options_.finalists));
    for (size_t i = 0; i < finalists && !stop_.stop_requested(); ++i) {
      Smooth(points_[i], points_[i].smoothed.parameters, options_.fine);
      if (progress)
        progress(0.8 + 0.2 * static_cast<double>(i + 1) / static_cast<double>(finalists));
    }
    return Finish();
  }

 private:
  void Try(GridPoint point) {
    HomotopyParameters start = PlannedMotion(sequence_);
    for (double& T : start.durations) T *= point.duration;
    for (double& eta : start.height_scales) eta *= point.height;
    const bool planned = point.duration == 1.0 && point.height == 1.0;
    if (Smooth(point, start, options_.coarse)) {
      planned_feasible_ = planned_feasible_ || planned;
      points_.push_back(std::move(point));
    } else if (planned) {
      result_.message = std::move(point.smoothed.message);
    }
  }

  // False when the start is not feasible.
  bool Smooth(GridPoint& point, const HomotopyParameters& start, double tolerance) {
    SmoothingResult smoothed =
        Dichotomy(sequence_, test_, {.tolerance = tolerance, .start = start}, {}, stop_);
    result_.instants += smoothed.instants;
    result_.collision_queries += smoothed.collision_queries;
    const bool feasible = smoothed.feasible;
    smoothed.cost = DurationOf(smoothed.parameters);
    const bool better = feasible && (!found_ || smoothed.cost < result_.cost);
    SmoothingIterate iterate{.wall = stopwatch_.Seconds(),
                             .evaluations = result_.instants,
                             .candidate_duration = smoothed.cost,
                             .accepted = better,
                             .lambda = better ? 1.0 : 0.0};
    if (better) {
      found_ = true;
      result_.parameters = smoothed.parameters;
      result_.cost = smoothed.cost;
      result_.junctions = smoothed.junctions;
      best_ = {point.duration, point.height, {}};
      if (!result_.time_to_first_improvement)
        result_.time_to_first_improvement = stopwatch_.Seconds();
    }
    iterate.incumbent_duration = iterate.incumbent_cost =
        found_ ? result_.cost : DurationOf(result_.parameters);
    result_.iterates.push_back(iterate);
    point.smoothed = std::move(smoothed);
    return feasible;
  }

  SmoothingResult Finish() {
    result_.wall = stopwatch_.Seconds();
    result_.feasible = found_;
    if (!found_) {
      result_.cost = DurationOf(result_.parameters);
      result_.ending = Ending::kNotRun;  // also when interrupted: there is no feasible walk to keep
      return std::move(result_);
    }
    std::ostringstream message;
    message << "best of " << points_.size() << " feasible grid points: durations times "
            << best_.duration << ", heights times " << best_.height;
    result_.message = (stop_.stop_requested() ? "stopped from outside; " : "") + message.str();
    const bool improved = !planned_feasible_ || result_.cost < DurationOf(PlannedMotion(sequence_));
    result_.ending = !improved                ? Ending::kNoImprovement
                     : stop_.stop_requested() ? Ending::kInterrupted
                                              : Ending::kConverged;
    if (!improved) result_.message += "; no shorter than the planned motion";
    return std::move(result_);
  }

  const HalfStepSequence& sequence_;
  const FeasibilityTest& test_;
  const UniformScanOptions& options_;
  std::stop_token stop_;
  Stopwatch stopwatch_;
  std::vector<GridPoint> points_;
  GridPoint best_;
  bool found_ = false, planned_feasible_ = false;
  SmoothingResult result_;
};

}  // namespace

SmoothingResult UniformScan(const HalfStepSequence& sequence, const FeasibilityTest& test,
                            const UniformScanOptions& options,
                            const std::function<void(double)>& progress, std::stop_token stop) {
  HALFSTEP_CHECK(options.coarse > 0.0 && options.fine > 0.0 && options.finalists >= 1,
                 "tolerances " << options.coarse << ", " << options.fine << ", finalists "
                               << options.finalists);
  HALFSTEP_CHECK(options.least_height > 0.0 && options.least_duration > 0.0 &&
                     options.height_step > 0.0 && options.duration_step > 0.0,
                 "grid of durations from " << options.least_duration << " by "
                                           << options.duration_step << ", of heights from "
                                           << options.least_height << " by "
                                           << options.height_step);
  return Scan(sequence, test, options, std::move(stop)).Run(progress);
}

}  // namespace halfstep
