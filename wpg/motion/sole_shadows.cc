#include "wpg/motion/sole_shadows.h"

#include <algorithm>
#include <limits>

namespace halfstep {
namespace {

using Eigen::Vector2d;

Pose2 Shadow(const WalkState& x, Side side, const StandingHeights& heights, const Vector2d& tilt) {
  const Vector2d offset = (heights.middle() - heights.of(side)) * tilt;
  Pose2 place = FootPose(x, side);
  place.x += offset.x();
  place.y += offset.y();
  return place;
}

}  // namespace

SoleShadows::SoleShadows(const WalkState& x, const StandingHeights& heights,
                         const Vector2d& sole_size, const RobotDynamics& dynamics)
    : heights_(heights),
      tilt_(dynamics.Tilt()),
      zmp_(*dynamics.Zmp(heights.middle())),
      sole_size_(sole_size),
      places_{Shadow(x, Side::kLeft, heights, tilt_), Shadow(x, Side::kRight, heights, tilt_)},
      hull_(places_[0], places_[1], sole_size) {}

double SoleShadows::LeastOver(const ZmpDrift& drift) const {
  // A corner rests, so it is the ZMP in the plane of its own sole that moves as seen from it.
  const double half_rise = 0.5 * heights_.rise();
  const std::array<ZmpDrift, 2> drifts = {drift.Raised(-half_rise), drift.Raised(half_rise)};
  const int n = hull_.size();
  const auto edge = [&](int i) -> Vector2d { return hull_.corner((i + 1) % n) - hull_.corner(i); };
  constexpr double kNone = 1e-9;  // shorter edges have no direction
  bool shared = false;            // a corner that is nearly one of both soles
  for (int i = 0; i < n; ++i) shared = shared || edge(i).norm() < kNone;
  const auto fall = [&](int corner, const Vector2d& inward) {
    const auto of = [&](Side side) { return Nth(drifts, Index(side)).Along(inward); };
    return shared ? std::max(of(Side::kLeft), of(Side::kRight))
                  : of(SoleOf(hull_.corner(corner % n)));
  };
  double least = Margin();
  for (int i = 0; i < n; ++i) {
    if (edge(i).norm() < kNone) continue;
    const Vector2d inward = Vector2d(-edge(i).y(), edge(i).x()).normalized();
    const double inside = inward.dot(zmp_ - hull_.corner(i));
    least = std::min(least, inside - std::max(fall(i, inward), fall(i + 1, inward)));
  }
  if (shared) least -= kNone;
  return least >= 0.0 ? least : -std::numeric_limits<double>::infinity();
}

}  // namespace halfstep
