#include "wpg/robot/robot_model.h"

#include "wpg/robot/paden_kahan.h"

namespace halfstep {

Eigen::Vector3d Leg::AxisPoint(size_t joint) const {
  const Eigen::Vector3d& near = joint < 4 ? hip_B : ankle_B;
  if (closed_form() && joint != 3) return near;
  const LegJoint& of = joints[joint];
  return of.point_B + of.axis_B * of.axis_B.dot(near - of.point_B);
}

LegFrames PlaceLeg(const Leg& leg, const Vector6d& q) {
  LegFrames frames;
  // x ↦ R x + t: the displacement from the zero posture of what joints 0 … i move.
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
  const auto displaced = [&R, &t](const Eigen::Isometry3d& X) {
    Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
    moved.linear().noalias() = R * X.linear();
    moved.translation() = R * X.translation() + t;
    return moved;
  };
  for (size_t i = 0; i < 6; ++i) {
    const LegJoint& joint = leg.joints[i];
    const Eigen::Vector3d axis = R * joint.axis_B;
    const Eigen::Vector3d point = R * joint.point_B + t;
    const Turn turn = Turn::FromAngle(q[static_cast<Eigen::Index>(i)]);
    for (int column = 0; column < 3; ++column) {
      R.col(column) = Rotate(axis, turn, Eigen::Vector3d(R.col(column)));
    }
    t = point - R * joint.point_B;
    frames.axis_B[i] = axis;
    frames.point_B[i] = point;
    frames.X_BLink[i] = displaced(joint.X_BLink);
  }
  frames.X_BLink[6] = displaced(leg.X_BSole);
  return frames;
}

}  // namespace halfstep
