#include "wpg/motion/foot_friction.h"

#include <algorithm>
#include <limits>

namespace halfstep {
namespace {

using Eigen::Vector2d;

// About the vertical axis, of a force in the plane at the end of an arm.
double YawMoment(const Vector2d& arm, const Vector2d& force) {
  return arm.x() * force.y() - arm.y() * force.x();
}

}  // namespace

std::optional<FootFriction> FootFriction::Of(const RobotDynamics& dynamics,
                                             const SupportPolygon& polygon) {
  const auto zmp = dynamics.Zmp();
  if (!zmp || !(polygon.Margin(*zmp) > 0.0)) return std::nullopt;
  return FootFriction(dynamics, polygon, *zmp);
}

FootFriction::FootFriction(const RobotDynamics& dynamics, const SupportPolygon& polygon,
                           const Vector2d& zmp)
    : dynamics_(dynamics),
      polygon_(polygon),
      zmp_(zmp),
      pull_(dynamics.contact().segment<2>(3)),
      turn_(dynamics.contact()[2] - YawMoment(zmp - dynamics.O().head<2>(), pull_)),
      push_(dynamics.contact()[5]) {
  for (int i = 0; i < polygon.size(); ++i) {
    const Vector2d edge = polygon.corner((i + 1) % polygon.size()) - polygon.corner(i);
    if (edge.norm() < 1e-9) continue;
    const Reach reach = ReachAlong(edge.normalized());
    if (reach.distance <= reach_.distance) continue;
    reach_ = reach;
    along_ = edge.normalized();
  }
}

template <typename Visit>
void FootFriction::ForEachReach(const Vector2d& direction, const Visit& visit) const {
  for (int i = 0; i < polygon_.size(); ++i) {
    const Vector2d a = polygon_.corner(i), edge = polygon_.corner((i + 1) % polygon_.size()) - a;
    if (edge.norm() < 1e-9) continue;
    const Vector2d inward = Vector2d(-edge.y(), edge.x()).normalized();
    const double share = std::abs(inward.dot(direction));
    if (share < 1e-9) continue;
    visit(Reach{inward.dot(zmp_ - a) / share, inward / share});
  }
}

FootFriction::Reach FootFriction::ReachAlong(const Vector2d& direction) const {
  Reach least{std::numeric_limits<double>::infinity(), {0, 0}};
  ForEachReach(direction, [&](const Reach& reach) {
    if (reach.distance < least.distance) least = reach;
  });
  return least;
}

double FootFriction::Slope(const Vector6d& slope) const {
  const Vector2d zmp_slope = dynamics_.ZmpSlope(slope), pull_slope = slope.segment<2>(3);
  const double turn_slope = slope[2] - YawMoment(zmp_slope, pull_) -
                            YawMoment(zmp_ - dynamics_.O().head<2>(), pull_slope);
  const double pull = pull_.norm(), distance = reach_.distance;
  double sum_slope = (turn_ < 0.0 ? -1.0 : 1.0) * turn_slope / distance -
                     std::abs(turn_) * reach_.normal.dot(zmp_slope) / (distance * distance);
  if (pull > 0.0) sum_slope += pull_.dot(pull_slope) / pull;
  return (sum_slope - needed() * slope[5]) / push_;
}

double FootFriction::Drift(const RobotDrift& robot, const ZmpDrift& zmp) const {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  double reach = kNone;
  ForEachReach(along_, [&](const Reach& at_m) {
    const double length = at_m.normal.norm();
    reach = std::min(reach, at_m.distance - length * zmp.Along(at_m.normal / length));
  });
  if (!(reach > 0.0) || !(zmp.least_push > 0.0)) return kNone;
  // The ZMP may leave by an edge along `along_` as well, and then nothing suffices.
  for (int i = 0; i < polygon_.size(); ++i) {
    const Vector2d a = polygon_.corner(i), edge = polygon_.corner((i + 1) % polygon_.size()) - a;
    if (edge.norm() < 1e-9) continue;
    const Vector2d inward = Vector2d(-edge.y(), edge.x()).normalized();
    if (!(inward.dot(zmp_ - a) > zmp.Along(inward))) return kNone;
  }
  Eigen::Vector3d below(0, 0, 0);
  below.head<2>() = zmp_ - dynamics_.O().head<2>();
  const double pull = pull_.norm() + robot.ForceDrift();
  const double turn = std::abs(turn_) + robot.YawMomentDrift(below) + zmp.Most() * pull;
  return (pull + turn / reach) / zmp.least_push - needed();
}

}  // namespace halfstep
