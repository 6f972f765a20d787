#pragma once

#include <cmath>
#include <vector>

#include "smoothing/margins/margin_statements.h"
#include "smoothing/margins/rounding.h"
#include "wpg/elementary.h"

namespace halfstep {

/// Families with one statement about each sole that stands: how far its outline, seen from above,
/// is from something at rest [m]; +∞ for a foot in the air, and where there is nothing to watch.
/// There are rows where footsteps move (SlackSink::footsteps_move). Subject: Index(Side). `Family`
/// has
///   - `bool Watches()`: whether there is something to watch;
///   - `Margin Standing(const Instant&, Side)`: the margin of a sole that stands;
///   - `DistanceOf(const WalkState&, Side)`: that sole's distance as a function of its Pose2, what
///     it stands on held;
///   - `double Reach()`: how far the outline reaches from the sole's centre [m].
/// All but the first are asked only where it watches.
template <typename Family>
class StandingSoleFamily : public WholeFamily {
 public:
  /// The traits of the class.
  using WholeFamily::WholeFamily;
  int count() const final { return 2; }

  std::vector<Side> PlacedFeet(const Margin& margin) const final {
    if (margin.subject < 0) return {};
    return {static_cast<Side>(margin.subject)};
  }

  Margin Least(Instant* at, double) const final {
    Margin least = Of(kUnlimited, -1);
    for (const Side side : {Side::kLeft, Side::kRight}) Lower(OfSole(*at, side), &least);
    return least;
  }

  void AddRows(Instant* at, SlackSink* rows) const final {
    if (!rows->footsteps_move || !self().Watches()) return;
    // A distance of polygons is smooth but where another pair of features becomes the nearest, so
    // differences tell its slope to some nine digits.
    constexpr double kStep = 1e-6;
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const Margin margin = OfSole(*at, side);
      if (std::isinf(margin.value)) continue;
      const WalkState& x = at->jet().value;
      const auto distance = self().DistanceOf(x, side);
      rows->AddAlong(margin.value, [&](size_t i) {
        const WalkState move = kStep * rows->sensitivities[i].jet.value;
        return (distance(FootPose(x + move, side)) - distance(FootPose(x - move, side))) /
               (2.0 * kStep);
      });
    }
  }

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const final {
    for (const Side side : {Side::kLeft, Side::kRight}) {
      // A sole that stands does not move: its quantities change by 0 and rounding.
      const Margin margin = OfSole(interval.mid, side);
      const double moved = std::isinf(margin.value) ? 0.0 : Moved(interval.motion, side);
      const Eigen::Vector2d at = FootPose(interval.motion.jet.value, side).position();
      tightest->Add(margin,
                    std::isinf(margin.value) ? 0.0 : moved + PlanarRounding(at.x(), at.y()));
    }
  }

 private:
  const Family& self() const { return static_cast<const Family&>(*this); }
  // How far a point of the outline goes within an interval, at most [m].
  double Moved(const IntervalMotion& motion, Side side) const {
    const int foot = FootIndex(side);
    return Hypot(motion.Change(foot), motion.Change(foot + 1)) +
           self().Reach() * motion.Change(foot + 3);
  }
  Margin OfSole(const Instant& at, Side side) const {
    if (!self().Watches() || at.walk().InAir(at.at(), side)) return Of(kUnlimited, Index(side));
    return self().Standing(at, side);
  }
};

}  // namespace halfstep
