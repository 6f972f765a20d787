#include "planner/search/goal_region.h"

#include <cmath>
#include <numbers>

namespace halfstep {

bool GoalRegion::IsValid() const {
  return std::isfinite(X_WG.x) && std::isfinite(X_WG.y) && std::isfinite(X_WG.yaw) &&
         std::isfinite(radius) && radius >= 0.0 &&
         (!box || (box->allFinite() && box->minCoeff() >= 0.0)) &&
         (!yaw_tolerance || (std::isfinite(*yaw_tolerance) && *yaw_tolerance >= 0.0)) &&
         (!height || std::isfinite(*height));
}

double GoalRegion::Distance(const Eigen::Vector2d& p_W) const {
  const Eigen::Vector2d from_center = p_W - X_WG.position();
  if (!box) return std::fmax(0.0, from_center.norm() - radius);
  const Eigen::Vector2d p_G = X_WG.rotation().transpose() * from_center;
  return (p_G.cwiseAbs() - 0.5 * *box).cwiseMax(0.0).norm();
}

double GoalRegion::Turn(double yaw) const {
  if (!yaw_tolerance) return 0.0;
  const double difference = std::remainder(yaw - X_WG.yaw, 2.0 * std::numbers::pi);
  return std::fmax(0.0, std::fabs(difference) - *yaw_tolerance);
}

bool GoalRegion::Contains(const Pose2& X_W) const {
  return Distance(X_W.position()) <= 0.0 && Turn(X_W.yaw) <= 0.0;
}

bool GoalRegion::ContainsStance(const std::array<Foothold, 2>& feet) const {
  if (part == GoalPart::kMidFeet) {
    return IsLevel(feet[0]) && IsLevel(feet[1]) &&
           Contains(MidFeet(feet[0].Planar(), feet[1].Planar()));
  }
  const auto holds = [this](const Foothold& X_WF) {
    return IsLevel(X_WF) && Contains(X_WF.Planar());
  };
  return (part != GoalPart::kRightFoot && holds(feet[Index(Side::kLeft)])) ||
         (part != GoalPart::kLeftFoot && holds(feet[Index(Side::kRight)]));
}

bool GoalRegion::ContainsLanding(Side side, const Foothold& X_WF, const Foothold& X_WS) const {
  if (!IsLevel(X_WF) || (part == GoalPart::kMidFeet && !IsLevel(X_WS))) return false;
  switch (part) {
    case GoalPart::kLeftFoot:
      return side == Side::kLeft && Contains(X_WF.Planar());
    case GoalPart::kRightFoot:
      return side == Side::kRight && Contains(X_WF.Planar());
    case GoalPart::kEitherFoot:
      return Contains(X_WF.Planar());
    case GoalPart::kMidFeet:
      return Contains(MidFeet(X_WF.Planar(), X_WS.Planar()));
  }
  return false;
}

Pose2 MidFeet(const Pose2& X_WL, const Pose2& X_WR) {
  return {0.5 * (X_WL.x + X_WR.x), 0.5 * (X_WL.y + X_WR.y), 0.5 * (X_WL.yaw + X_WR.yaw)};
}

}  // namespace halfstep
