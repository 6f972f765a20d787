// What a candidate teaches WatchedInstants: where to look, and how much to keep in reserve.

#include <algorithm>
#include <cmath>

#include "smoothing/program/slack_samples.h"
#include "smoothing/program/watched_instants.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// Slacks that are near the level, and that are far from it.
constexpr double kNear = 0.3, kFar = 1.0;

}  // namespace

bool WatchedInstants::Learn(const SuperposedWalk& walk, const LocalTime& at, bool of_branch) {
  const bool learned = Look(walk, at, of_branch, Instant::Why::kLearned);
  CountRows();
  return learned;
}

bool WatchedInstants::Look(const SuperposedWalk& walk, const LocalTime& at, bool of_branch,
                           Instant::Why why) {
  constexpr double kSame = 1e-3;  // of T
  if (!options_.range.contains(at.half_step)) return false;
  const double T = walk.tracks(at.half_step).duration();
  double fraction = at.tau / T;
  const Instant::Of of = of_branch ? Instant::Of::kBranch : Instant::Of::kHalfStep;
  if (of_branch) {
    const double stretch = StretchOf(walk, at.half_step);
    fraction = stretch < T ? (at.tau - stretch) / (T - stretch) : 1.0;
  }
  std::vector<Instant>& instants = Nth(instants_, at.half_step);
  for (const Instant& known : instants) {
    if (known.of == of && !known.far && std::abs(known.fraction - fraction) < kSame) return false;
  }
  instants.push_back({std::clamp(fraction, 0.0, 1.0), of, why});
  return true;
}

std::vector<double> WatchedInstants::Focus(const SuperposedWalk& walk, double period,
                                           double level) {
  // Rows by half-step cost no more for looking at more instants; long rounds need them.
  if (options_.row_per_instant) {
    NoteRows(walk, level);
    for (std::vector<Instant>& instants : instants_) {
      std::erase_if(instants, [](const Instant& i) { return i.why == Instant::Why::kMinimum; });
    }
  }
  std::vector<double> least(instants_.size(), level + kFar);
  FocusOn(walk, std::nullopt, period, level, &least);
  for (int k = 0; k + 1 < walk.num_half_steps(); ++k) {
    if (!WatchesBranch(k) || walk.end_of(k) <= walk.start_of(k + 1)) continue;
    FocusOn(walk, k, period, level, &least);
  }
  CountRows();
  return least;
}

void WatchedInstants::FocusOn(const SuperposedWalk& walk, std::optional<int> branch, double period,
                              double level, std::vector<double>* least) {
  const double far = level + kFar;
  const double begin = branch ? walk.start_of(*branch + 1) : 0.0;
  const double end = branch ? walk.end_of(*branch) : walk.duration();
  const std::vector<LeastSlacks> samples =
      SampledSlacks(branch ? walk.StopBranch(*branch) : walk, evaluator_, options_.range,
                    {.begin = begin, .period = period, .cutoff = far}, workers_, work_);
  const int last = static_cast<int>(samples.size()) - 1;
  const auto lowest = [&samples](int i) { return std::ranges::min(Nth(samples, i)); };
  ParameterRates moving;
  const int from = branch.value_or(0), to = branch.value_or(walk.num_half_steps() - 1);
  for (int k = from; options_.row_per_instant && k <= to; ++k) {
    for (Instant& instant : Nth(instants_, k)) {
      if ((instant.of == Instant::Of::kBranch) != branch.has_value()) continue;
      const double t = walk.start_of(k) + At(walk, k, instant, &moving).tau;
      const int i = std::clamp(static_cast<int>((t - begin) / period), 0, last);
      instant.far = lowest(i) >= far && lowest(std::min(i + 1, last)) >= far;
    }
  }
  for (int i = 0; i <= last; ++i) {
    const int k = branch ? *branch : walk.Locate(std::min(begin + i * period, end)).half_step;
    Nth(*least, k) = std::min(Nth(*least, k), lowest(i));
    if (options_.row_per_instant) NoteSample(k, Nth(samples, i), level);
    const double minimum = LocalMinimum(samples, i, far);
    if (minimum >= far) continue;
    // It moves with the parameters.
    const int around = minimum < level + kNear ? 2 : 0;
    for (int j = -around; j <= around; ++j) {
      const double t = std::clamp(begin + (i + j) * period, begin, end);
      const LocalTime at = branch ? LocalTime{*branch, t - walk.start_of(*branch)} : walk.Locate(t);
      Look(walk, at, branch.has_value(), Instant::Why::kMinimum);
    }
  }
}

void WatchedInstants::NoteRows(const SuperposedWalk& walk, double level) {
  const int families = NumRowFamilies();
  Eigen::VectorXd values;
  EvaluateOn(walk, {}, &values, nullptr);
  seen_.rows.assign(instants_.size() * static_cast<size_t>(families), kFar);
  seen_.samples.assign(seen_.rows.size(), kFar);
  for (int k = 0, row = 0; k < walk.num_half_steps(); ++k) {
    for (; row < Nth(first_rows_, k + 1); ++row) {
      double& least = Nth(seen_.rows, k * families + row % families);
      least = std::min(least, values[row] - level);
    }
  }
}

void WatchedInstants::NoteSample(int half_step, const LeastSlacks& slacks, double level) {
  for (const MarginFamily family : AllMarginFamilies()) {
    const int row = order_.row(family);
    if (row < 0) continue;
    double& least = Nth(seen_.samples, half_step * NumRowFamilies() + row);
    least = std::min(least, Nth(slacks, family) - level);
  }
}

void WatchedInstants::LearnReserves(bool tried, const std::vector<Margin>& refusals) {
  if (seen_.rows.empty()) return;
  std::vector<RowReserves::Place> refused;
  for (const Margin& refusal : refusals) {
    const int row = order_.row(refusal.family);
    if (row >= 0) refused.emplace_back(refusal.at.half_step, row);
  }
  reserves_.Learn(seen_, refused, tried && refused.size() == refusals.size());
}

}  // namespace halfstep
