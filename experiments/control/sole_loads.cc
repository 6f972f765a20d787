#include "experiments/control/sole_loads.h"

#include <algorithm>
#include <optional>

#include "wpg/elementary.h"
#include "wpg/geometry/support_polygon.h"
#include "wpg/motion/foot_loads.h"
#include "wpg/motion/standing_heights.h"
#include "wpg/motion/walk_state.h"
#include "wpg/nth.h"

namespace halfstep::control {
namespace {

using Eigen::Vector2d;

// Where the soles of a plan are on which the robot stands.
class Soles {
 public:
  explicit Soles(const PlannedState& plan)
      : plan_(plan),
        down_(SolesOnFloor(plan)),
        x_(QuantitiesOf(plan)),
        heights_(x_, both() ? std::nullopt : std::optional(only())) {}

  bool both() const { return down_[0] && down_[1]; }
  Side only() const { return down_[0] ? Side::kLeft : Side::kRight; }
  Pose2 place(Side side) const { return FootPose(x_, side); }
  // How much a sole is higher than the plane of the plan's ZMP.
  double Above(Side side) const { return heights_.of(side) - plan_.zmp_height; }
  // Where the line through `zmp` in that plane crosses the plane of a sole.
  Vector2d Crossed(Side side, const Vector2d& zmp) const { return zmp + Above(side) * plan_.tilt; }
  Pose2 Shadow(Side side) const {
    Pose2 shadow = place(side);
    const Vector2d offset = Above(side) * plan_.tilt;
    shadow.x -= offset.x();
    shadow.y -= offset.y();
    return shadow;
  }
  FootLoads Shares(const Vector2d& sole_size, const Vector2d& zmp) const {
    if (!both()) return FootLoads::OneFoot(only());
    const std::array<Vector2d, 2> zmps = {Crossed(Side::kLeft, zmp), Crossed(Side::kRight, zmp)};
    if (!heights_.level()) {
      if (const auto loads = FootLoads::OnLevels(x_, heights_, sole_size, zmps)) return *loads;
    }
    return FootLoads::BothFeet(place(Side::kLeft), place(Side::kRight), sole_size, zmps[0]);
  }

 private:
  static WalkState QuantitiesOf(const PlannedState& plan) {
    WalkState x = WalkState::Zero();
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const Eigen::Isometry3d& X = Nth(plan.X_WSole, Index(side));
      x.segment<4>(FootIndex(side)) << X.translation(), Atan2(X(1, 0), X(0, 0));
    }
    return x;
  }

  const PlannedState& plan_;
  std::array<bool, 2> down_;
  WalkState x_;
  StandingHeights heights_;
};

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
  const Soles soles(plan);
  const Vector2d size = (1.0 - 2.0 * inset) * sole_size;
  const SupportPolygon polygon =
      soles.both() ? SupportPolygon(soles.Shadow(Side::kLeft), soles.Shadow(Side::kRight), size)
                   : SupportPolygon(soles.Shadow(soles.only()), size);
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
  const Soles soles(plan);
  const FootLoads shares = soles.Shares(sole_size, zmp);
  Vector6d contact;  // about W's z axis in the plane of the ZMP; nobody asks for the yaw moment
  contact << zmp.y() * plan.force, -zmp.x() * plan.force, 0.0, plan.force * plan.tilt, plan.force;
  std::array<SoleLoad, 2> loads;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Vector6d on_foot = shares.On(side, contact);
    if (!(on_foot[5] > 0.0)) continue;
    const Vector2d in_plane(-on_foot[1] / on_foot[5], on_foot[0] / on_foot[5]);
    const Vector2d centre = in_plane + soles.Above(side) * on_foot.segment<2>(3) / on_foot[5];
    Nth(loads, Index(side)) = {on_foot[5], soles.place(side).Inverse() * centre};
  }
  return loads;
}

}  // namespace halfstep::control
