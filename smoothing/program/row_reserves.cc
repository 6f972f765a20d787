#include "smoothing/program/row_reserves.h"

#include <algorithm>

namespace halfstep {
namespace {

// What a reserve is multiplied by: where a proof refused, where a sample is violated or the next
// proof may refuse, and after a proof of all.
constexpr double kRefused = 2.0, kViolated = 1.3, kShrink = 0.8;
// Of a reserve that was refused: what it does not shrink below again.
constexpr double kAboveRefused = 1.5;
constexpr double kLeast = 1e-3, kMost = 0.4;
// A row that is violated by no more is kept.
constexpr double kKept = 5e-3;
// A slack within this may be the next that a proof refuses in a half-step that was refused.
constexpr double kTight = 0.5;

}  // namespace

RowReserves::RowReserves(int half_steps, int families, double reserve)
    : families_(families),
      reserves_(static_cast<size_t>(half_steps) * static_cast<size_t>(families), reserve),
      least_(reserves_.size(), kLeast) {}

void RowReserves::SetAll(double reserve) {
  std::ranges::fill(reserves_, reserve);
  std::ranges::fill(least_, kLeast);
}

void RowReserves::Learn(const Seen& seen, const std::vector<Place>& refused, bool tried) {
  const auto grow = [&](size_t i, double factor) {
    if (seen.rows[i] < -kKept) return;
    reserves_[i] = std::max(reserves_[i], std::min(kMost, factor * reserves_[i]));
  };
  std::vector<bool> refused_here(reserves_.size(), false), refused_near(reserves_.size(), false);
  for (const Place& place : refused) {
    const size_t i = Index(place);
    refused_here[i] = true;
    for (int family = 0; family < families_; ++family) {
      refused_near[Index({place.first, family})] = true;
    }
    if (seen.rows[i] < -kKept) continue;
    least_[i] = std::max(least_[i], std::min(kMost, kAboveRefused * reserves_[i]));
  }
  for (size_t i = 0; i < reserves_.size(); ++i) {
    if (refused_here[i]) {
      grow(i, kRefused);
    } else if (seen.samples[i] < (refused_near[i] ? kTight : 0.0)) {
      grow(i, kViolated);
    } else if (tried && refused.empty()) {
      reserves_[i] = std::min(reserves_[i], std::max(least_[i], kShrink * reserves_[i]));
    }
  }
}

}  // namespace halfstep
