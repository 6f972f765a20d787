#include "wpg/robot/met_leg.h"

#include <Eigen/QR>

#include "wpg/robot/leg_ik.h"

namespace halfstep {

using Eigen::Vector3d;

Vector3d NearestPoint(const std::vector<Vector3d>& axes, const std::vector<Vector3d>& points,
                      const std::vector<double>& weights) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Vector3d b = Vector3d::Zero();
  for (size_t i = 0; i < axes.size(); ++i) {
    const Eigen::Matrix3d off_axis =
        weights[i] * (Eigen::Matrix3d::Identity() - axes[i] * axes[i].transpose());
    A += off_axis;
    b += off_axis * points[i];
  }
  return A.completeOrthogonalDecomposition().solve(b);
}

Leg WithAxesThatMeet(const Leg& leg) {
  const LegFrames at = PlaceLeg(leg, leg.standing_q);
  const auto meeting = [&](size_t first, size_t count) {
    std::vector<Vector3d> axes, points;
    std::vector<double> weights;
    for (size_t i = first; i < first + count; ++i) {
      axes.push_back(at.axis_B[i]);
      points.push_back(at.point_B[i]);
      const double along = at.axis_B[i].dot(at.axis_B[3]);
      weights.push_back(0.01 + along * along);
    }
    return NearestPoint(axes, points, weights);
  };
  const auto turn = [&](size_t link) {  // from q = 0 to standing
    return Eigen::Matrix3d(at.X_BLink[link].linear() *
                           leg.joints[link].X_BLink.linear().transpose());
  };
  const Vector3d hip = meeting(0, 3), knee = at.point_B[3], ankle = meeting(4, 2);
  const Vector3d sole = at.X_BLink[6].translation();
  Leg met = leg;
  met.met.clear();
  met.offsets.clear();
  met.hip_B = hip;
  const Vector3d knee_B = hip + turn(2).transpose() * (knee - hip);
  met.ankle_B = knee_B + turn(3).transpose() * (ankle - knee);
  met.X_BSole.translation() = met.ankle_B + turn(5).transpose() * (sole - ankle);
  for (size_t i = 0; i < 6; ++i) {
    met.joints[i].point_B = i < 3 ? met.hip_B : i == 3 ? knee_B : met.ankle_B;
  }
  met.branch = LegBranchOf(met, met.standing_q);
  return met;
}

}  // namespace halfstep
