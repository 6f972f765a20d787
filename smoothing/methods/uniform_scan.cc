#include "smoothing/methods/uniform_scan.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "smoothing/methods/dichotomy.h"
#include "wpg/check.h"
#include "wpg/files/plain_locale.h"
#include "wpg/nth.h"

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
  Scan(const WalkProblem& problem, const UniformScanOptions& options, SmoothingMonitor& monitor)
      : problem_(problem),
        options_(options),
        monitor_(monitor),
        table_(problem.Parameters({.heights = options.heights, .durations = options.durations})) {}

  SmoothingResult Run() {
    monitor_.Begin(problem_, problem_.Start());
    const auto durations = Factors(options_.least_duration, options_.most_duration,
                                   options_.duration_step, options_.durations);
    const auto heights =
        Factors(options_.least_height, 1.0, options_.height_step, options_.heights);
    const double count = static_cast<double>(durations.size() * heights.size());
    double done = 0.0;
    for (double duration : durations) {
      for (double height : heights) {
        Try({duration, height, {}});
        if (monitor_.stopped()) return Finish();
        monitor_.Progress(0.8 * ++done / count);
      }
    }
    std::stable_sort(points_.begin(), points_.end(), [](const GridPoint& a, const GridPoint& b) {
      return a.smoothed.cost < b.smoothed.cost;
    });
    const size_t finalists = std::min(points_.size(), static_cast<size_t>(options_.finalists));
    for (size_t i = 0; i < finalists && !monitor_.stopped(); ++i) {
      Smooth(points_[i], points_[i].smoothed.parameters, options_.fine);
      monitor_.Progress(0.8 + 0.2 * static_cast<double>(i + 1) / static_cast<double>(finalists));
    }
    return Finish();
  }

 private:
  void Try(GridPoint point) {
    HomotopyParameters start = problem_.Start();
    for (const ParameterRow& row : table_.rows()) {
      if (row.fixed) continue;
      if (row.parameter.family == ParameterFamily::kDuration) {
        row.parameter.in(start) *= point.duration;
      } else if (row.parameter.family == ParameterFamily::kHeightScale) {
        row.parameter.in(start) *= point.height;
      }
    }
    for (int i = 0; i < problem_.sequence().num_junctions(); ++i) {  // fixed ones may not fit
      if (Nth(start.overlaps, i) > NaturalOverlapBound(start, i) + kOverlapTolerance) {
        return;
      }
    }
    const bool planned = point.duration == 1.0 && point.height == 1.0;
    if (Smooth(point, start, options_.coarse)) {
      planned_feasible_ = planned_feasible_ || planned;
      points_.push_back(std::move(point));
    } else if (planned) {
      refusal_ = std::move(point.smoothed.message);
    }
  }

  // False when the start is not feasible.
  bool Smooth(GridPoint& point, const HomotopyParameters& start, double tolerance) {
    SmoothingMonitor within(monitor_.Part(0.0, 0.0));
    SmoothingResult smoothed =
        Dichotomy(problem_, {.tolerance = tolerance, .start = start}, within);
    monitor_.Count(smoothed);
    smoothed.cost = DurationOf(smoothed.parameters);
    const bool better = smoothed.accepted && (!found_ || smoothed.cost < monitor_.cost());
    if (better) {
      found_ = true;
      monitor_.Adopt(*smoothed.accepted, smoothed.cost, smoothed.cost);
      monitor_.result().junctions = smoothed.junctions;
      best_ = {point.duration, point.height, {}};
    }
    monitor_.Record(
        {.candidate_duration = smoothed.cost, .accepted = better, .lambda = better ? 1.0 : 0.0});
    point.smoothed = std::move(smoothed);
    return point.smoothed.feasible;
  }

  SmoothingResult Finish() {
    // Also when stopped: there is no feasible walk to keep.
    if (!found_) return monitor_.Finish(Ending::kNotRun, refusal_);
    if (!planned_feasible_) monitor_.DropStart();
    PlainStream message;
    message << (monitor_.stopped() ? monitor_.StopReason() + "; " : "") << "best of "
            << points_.size() << " feasible grid points: durations times " << best_.duration
            << ", heights times " << best_.height;
    return monitor_.FinishAgainstStart(
        monitor_.stopped() ? monitor_.StopEnding() : Ending::kConverged, message.str(),
        "; no shorter than the planned motion");
  }

  const WalkProblem& problem_;
  const UniformScanOptions& options_;
  SmoothingMonitor& monitor_;
  ParameterTable table_;
  std::vector<GridPoint> points_;
  GridPoint best_;
  bool found_ = false, planned_feasible_ = false;
  std::string refusal_;
};

}  // namespace

SmoothingResult UniformScan(const WalkProblem& problem, const UniformScanOptions& options,
                            SmoothingMonitor& monitor) {
  HALFSTEP_CHECK(options.coarse > 0.0 && options.fine > 0.0 && options.finalists >= 1,
                 "tolerances " << options.coarse << ", " << options.fine << ", finalists "
                               << options.finalists);
  HALFSTEP_CHECK(options.least_height > 0.0 && options.least_duration > 0.0 &&
                     options.height_step > 0.0 && options.duration_step > 0.0,
                 "grid of durations from " << options.least_duration << " by "
                                           << options.duration_step << ", of heights from "
                                           << options.least_height << " by "
                                           << options.height_step);
  return Scan(problem, options, monitor).Run();
}

}  // namespace halfstep
