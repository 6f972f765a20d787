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
  const auto of_corner = [&](const Vector2d& corner) -> const ZmpDrift& {
    return Nth(drifts, Index(SoleOf(corner)));
  };
  double least = Margin();
  for (int i = 0; i < hull_.size(); ++i) {
    const Vector2d a = hull_.corner(i), b = hull_.corner((i + 1) % hull_.size()), edge = b - a;
    if (edge.norm() < 1e-9) continue;
    const Vector2d inward = Vector2d(-edge.y(), edge.x()).normalized();
    const double fall = std::max(of_corner(a).Along(inward), of_corner(b).Along(inward));
    least = std::min(least, inward.dot(zmp_ - a) - fall);
  }
  return least >= 0.0 ? least : -std::numeric_limits<double>::infinity();
}

}  // namespace halfstep
