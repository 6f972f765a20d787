#include "experiments/control/sole_loads.h"

#include <algorithm>

#include "wpg/elementary.h"
#include "wpg/geometry/support_polygon.h"
#include "wpg/motion/foot_loads.h"
#include "wpg/nth.h"

namespace halfstep::control {
namespace {

using Eigen::Vector2d;

std::array<Pose2, 2> Places(const PlannedState& plan) {
  std::array<Pose2, 2> places;
  for (size_t s = 0; s < 2; ++s) {
    const Eigen::Isometry3d& X = plan.X_WSole[s];
    places[s] = {X.translation().x(), X.translation().y(), Atan2(X(1, 0), X(0, 0))};
  }
  return places;
}

Vector2d NearestOnEdge(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  const double x = (p - a).dot(b - a) / (b - a).squaredNorm();
  return a + std::clamp(x, 0.0, 1.0) * (b - a);
}

}  // namespace

std::array<bool, 2> SolesOnFloor(const PlannedState& plan) {
  return plan.stands[0] || plan.stands[1] ? plan.stands : std::array<bool, 2>{true, true};
}

Vector2d NearestInSupport(const PlannedState& plan, const Vector2d& sole_size, double inset,
                          const Vector2d& p) {
  const auto [left, right] = Places(plan);
  const std::array<bool, 2> down = SolesOnFloor(plan);
  const Vector2d size = (1.0 - 2.0 * inset) * sole_size;
  const SupportPolygon polygon = down[0] && down[1] ? SupportPolygon(left, right, size)
                                                    : SupportPolygon(down[0] ? left : right, size);
  if (polygon.Margin(p) >= 0.0) return p;
  Vector2d nearest = polygon.corner(0);
  for (int i = 0; i < polygon.size(); ++i) {
    const Vector2d here =
        NearestOnEdge(polygon.corner(i), polygon.corner((i + 1) % polygon.size()), p);
    if ((here - p).squaredNorm() < (nearest - p).squaredNorm()) nearest = here;
  }
  return nearest;
}

std::array<SoleLoad, 2> SharedLoads(const PlannedState& plan, const Vector2d& sole_size,
                                    const Vector2d& zmp) {
  const std::array<Pose2, 2> places = Places(plan);
  const std::array<bool, 2> down = SolesOnFloor(plan);
  const FootLoads shares = down[0] && down[1]
                               ? FootLoads::BothFeet(places[0], places[1], sole_size, zmp)
                               : FootLoads::OneFoot(down[0] ? Side::kLeft : Side::kRight);
  Vector6d contact;  // about W's origin
  contact << zmp.y() * plan.force, -zmp.x() * plan.force, 0.0, 0.0, 0.0, plan.force;
  std::array<SoleLoad, 2> loads;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Vector6d on_foot = shares.On(side, contact);
    if (!(on_foot[5] > 0.0)) continue;
    const Vector2d centre(-on_foot[1] / on_foot[5], on_foot[0] / on_foot[5]);
    Nth(loads, Index(side)) = {on_foot[5], Nth(places, Index(side)).Inverse() * centre};
  }
  return loads;
}

}  // namespace halfstep::control
