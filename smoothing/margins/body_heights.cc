#include "smoothing/margins/body_heights.h"

#include <algorithm>

namespace halfstep {

BodyHeights::BodyHeights(const RobotModel& robot, double floor)
    : robot_(robot), floor_(floor), of_waist_{.family = MarginFamily::kGround} {
  for (int b = 0; b < static_cast<int>(robot.bodies.size()); ++b) {
    if (body(b).leg >= 0) {
      (IsOnFoot(body(b)) ? on_feet_ : of_legs_).push_back(b);
      continue;
    }
    // The waist is upright.
    const double height =
        robot.waist_height - Support(body(b).shape, -Eigen::Vector3d::UnitZ()) - floor_;
    if (height < of_waist_.value) {
      of_waist_.value = height;
      of_waist_.subject = b;
    }
  }
}

Eigen::Vector3d BodyHeights::LowestPoint(int b, const Posture& posture) const {
  const Eigen::Isometry3d& X = posture.OfBody(body(b));
  return X * SupportPoint(body(b).shape, -X.linear().row(2).transpose());
}

double BodyHeights::LowestPossible(int b, const Posture& posture) const {
  const Eigen::Isometry3d& X = posture.OfBody(body(b));
  const ConvexBody& shape = body(b).shape;
  return X.linear().row(2).dot(shape.center) + X.translation().z() - shape.radius - floor_;
}

double BodyHeights::OnFoot(int b, const WalkState& x) const {
  const double height = x[FootIndex(static_cast<Side>(body(b).leg)) + 2] - floor_;
  return height >= -kSoleRounding ? std::numeric_limits<double>::infinity() : height;
}

Margin BodyHeights::Least(const Posture& posture, const WalkState& x, double enough) const {
  Margin least = of_waist_;
  least.value += x[kWaistZ];
  const auto lower = [&](int b, double height) {
    if (height >= least.value) return;
    least.value = height;
    least.subject = b;
  };
  for (int b : on_feet_) lower(b, OnFoot(b, x));
  for (int b : of_legs_) {
    if (LowestPossible(b, posture) >= std::min(enough, least.value)) continue;
    lower(b, LowestPoint(b, posture).z() - floor_);
  }
  return least;
}

}  // namespace halfstep
