#include "smoothing/walk/posture_tangent.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// δJ·b when the joint angles change by a: column j is (ω_j, ω_j × (p − o_j)), p the sole's origin.
Vector6d JacobianTangent(const LegFrames& frames, const Vector6d& a, const Vector6d& b) {
  const Vector3d sole = frames.X_BLink[6].translation();
  Vector3d turn{0, 0, 0};        // Σ_{k<j} a_k ω_k: how the frame before joint j turns
  Vector3d sole_moves{0, 0, 0};  // of p, by joints k ≥ j, in the frame before joint j
  for (int k = 0; k < 6; ++k) {
    const size_t i = static_cast<size_t>(k);
    sole_moves += a[k] * frames.axis_B[i].cross(sole - frames.point_B[i]);
  }
  Vector3d angular{0, 0, 0}, linear{0, 0, 0};
  for (int j = 0; j < 6; ++j) {
    const size_t i = static_cast<size_t>(j);
    const Vector3d& axis = frames.axis_B[i];
    const Vector3d arm = sole - frames.point_B[i];
    const Vector3d axis_moves = turn.cross(axis);
    angular += b[j] * axis_moves;
    linear += b[j] * (axis_moves.cross(arm) + axis.cross(turn.cross(arm) + sole_moves));
    sole_moves -= a[j] * axis.cross(arm);
    turn += a[j] * axis;
  }
  Vector6d result;
  result << angular, linear;
  return result;
}

}  // namespace

PostureTangent Differentiate(const RobotModel& robot, const WalkJet& jet, const Posture& posture,
                             const WalkJet& d) {
  const Vector3d z{0, 0, 1};
  const Eigen::Matrix3d& R = posture.X_WB.linear();
  const Vector3d x_W = R.col(0), y_W = R.col(1);
  const double yaw_rate = jet.first[kWaistYaw];
  const double d_yaw = d.value[kWaistYaw], d_yaw_rate = d.first[kWaistYaw];
  PostureTangent tangent;
  tangent.waist_yaw = d_yaw;
  tangent.waist << d.value.segment<2>(kComX), d.value[kWaistZ];
  tangent.waist -= d_yaw * robot.com_x_B * y_W;
  Vector3d d_waist_velocity;
  d_waist_velocity << d.first.segment<2>(kComX), d.first[kWaistZ];
  d_waist_velocity -= robot.com_x_B * (d_yaw_rate * y_W - yaw_rate * d_yaw * x_W);
  for (Side side : {Side::kLeft, Side::kRight}) {
    const size_t s = static_cast<size_t>(Index(side));
    const int foot = FootIndex(side);
    const Vector3d lever = posture.X_WSole[s].translation() - posture.X_WB.translation();
    const Vector3d d_lever = d.value.segment<3>(foot) - tangent.waist;
    tangent.sole_B[s] = R.transpose() * (d_lever - d_yaw * z.cross(lever));
    Vector6d d_pose;
    d_pose << (d.value[foot + 3] - d_yaw) * z, tangent.sole_B[s];
    tangent.q[s] = posture.jacobian_inverse[s] * d_pose;
    // V = ((ψ̇_S − ψ̇_B)ẑ, Rᵀw) with w = v_S − v_B − ψ̇_B ẑ × lever.
    const Vector3d w =
        jet.first.segment<3>(foot) - posture.waist_velocity - yaw_rate * z.cross(lever);
    const Vector3d d_w = d.first.segment<3>(foot) - d_waist_velocity - d_yaw_rate * z.cross(lever) -
                         yaw_rate * z.cross(d_lever);
    Vector6d d_twist;
    d_twist << (d.first[foot + 3] - d_yaw_rate) * z, R.transpose() * (d_w - d_yaw * z.cross(w));
    tangent.speeds[s] =
        posture.jacobian_inverse[s] *
        (d_twist - JacobianTangent(posture.frames[s], tangent.q[s], posture.speeds[s]));
  }
  return tangent;
}

Vector3d PointTangent(const RobotBody& body, const Posture& posture, const PostureTangent& tangent,
                      const Vector3d& p_W) {
  const Vector3d from_waist = p_W - posture.X_WB.translation();
  Vector3d moves = tangent.waist + tangent.waist_yaw * Vector3d::UnitZ().cross(from_waist);
  if (body.leg < 0) return moves;
  const size_t s = static_cast<size_t>(body.leg);
  const Eigen::Matrix3d& R = posture.X_WB.linear();
  const Vector3d p_B = R.transpose() * from_waist;
  Vector3d moves_B{0, 0, 0};
  for (int j = 0; j <= body.link; ++j) {
    const size_t i = static_cast<size_t>(j);
    const LegFrames& frames = posture.frames[s];
    moves_B += tangent.q[s][j] * frames.axis_B[i].cross(p_B - frames.point_B[i]);
  }
  return moves + R * moves_B;
}

}  // namespace halfstep
