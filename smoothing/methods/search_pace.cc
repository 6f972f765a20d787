#include "smoothing/methods/search_pace.h"

#include <algorithm>
#include <cmath>

namespace halfstep {
namespace {

constexpr double kGain = 1e-3;
// Rounds whose mean gain is the pace.
constexpr size_t kPaceRounds = 6;

}  // namespace

bool SearchPace::Gained(double before, double after) {
  if (!std::isfinite(before)) return std::isfinite(after);
  return before - after >= kGain * std::abs(before);
}

void SearchPace::Note(double end, double before, double after) {
  const bool gained = Gained(before, after) || Gained(least_, end);
  if (gained) {
    poor_ = 0;
  } else if (!Gained(after, end)) {
    ++poor_;
  }
  ends_.push_back(end);
  least_ = std::min(least_, end);
  if (ends_.size() <= kPaceRounds || end <= after) return;
  const double gain = (ends_[ends_.size() - 1 - kPaceRounds] - end) / kPaceRounds;
  const double left = static_cast<double>(rounds_) - static_cast<double>(ends_.size());
  out_of_reach_ = end - after > gain * left;
}

}  // namespace halfstep
