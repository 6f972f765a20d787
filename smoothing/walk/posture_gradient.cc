#include "smoothing/walk/posture_gradient.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

bool Any(const Vector6d& x) { return (x.array() != 0.0).any(); }

// The gradient of by_twist · (δJ·q̇) with respect to δq. Joint k carries along all joints beyond it,
// and moves the sole's origin p under those before it and itself:
// δJ·q̇ = δq_k (ω_k × Ω_{>k}, ω_k × V_{>k} + Ω_{≤k} × (ω_k × (p − o_k))), Ω = Σ q̇_j ω_j, V = that of
// p.
Vector6d ByJacobian(const LegFrames& frames, const Vector6d& speeds, const Vector6d& by_twist) {
  const Vector3d by_turn = by_twist.head<3>(), by_move = by_twist.tail<3>();
  const Vector3d sole = frames.X_BLink[6].translation();
  std::array<Vector3d, 6> moves;  // of the sole, per unit of each joint
  Vector3d turn{0, 0, 0};         // by joints up to k
  Vector3d turn_beyond{0, 0, 0}, velocity_beyond{0, 0, 0};
  for (size_t k = 0; k < 6; ++k) {
    moves[k] = frames.axis_B[k].cross(sole - frames.point_B[k]);
    turn += speeds[static_cast<Eigen::Index>(k)] * frames.axis_B[k];
  }
  Vector6d by_q;
  for (size_t k = 6; k-- > 0;) {
    const Eigen::Index i = static_cast<Eigen::Index>(k);
    by_q[i] = frames.axis_B[k].dot(turn_beyond.cross(by_turn) + velocity_beyond.cross(by_move)) +
              by_move.cross(turn).dot(moves[k]);
    turn -= speeds[i] * frames.axis_B[k];
    turn_beyond += speeds[i] * frames.axis_B[k];
    velocity_beyond += speeds[i] * moves[k];
  }
  return by_q;
}

}  // namespace

void PostureGradient::AddPoint(const RobotBody& body, const Posture& posture, const Vector3d& p_W,
                               const Vector3d& weight_W) {
  const Vector3d from_waist = p_W - posture.X_WB.translation();
  waist += weight_W;
  waist_yaw += weight_W.y() * from_waist.x() - weight_W.x() * from_waist.y();
  if (body.leg < 0) return;
  const size_t s = static_cast<size_t>(body.leg);
  const LegFrames& frames = posture.frames[s];
  const Eigen::Matrix3d R_BW = posture.X_WB.linear().transpose();
  const Vector3d p_B = R_BW * from_waist, weight_B = R_BW * weight_W;
  for (int j = 0; j <= body.link; ++j) {
    const size_t i = static_cast<size_t>(j);
    q[s][j] += weight_B.dot(frames.axis_B[i].cross(p_B - frames.point_B[i]));
  }
}

WalkJet PulledBack(const RobotModel& robot, const WalkJet& jet, const Posture& posture,
                   const PostureGradient& of) {
  const Vector3d z{0, 0, 1};
  const Eigen::Matrix3d& R = posture.X_WB.linear();
  const Vector3d x_W = R.col(0), y_W = R.col(1);
  const double yaw_rate = jet.first[kWaistYaw];
  WalkJet by = of.jet;
  Vector3d by_waist = of.waist, by_waist_velocity{0, 0, 0};
  double by_yaw = of.waist_yaw, by_yaw_rate = 0.0;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const size_t s = static_cast<size_t>(Index(side));
    const int foot = FootIndex(side);
    const bool of_speeds = Any(of.speeds[s]);
    if (!of_speeds && !Any(of.q[s]) && of.sole_B[s].isZero(0.0)) continue;
    const Vector3d lever = posture.X_WSole[s].translation() - posture.X_WB.translation();
    const Vector3d carried = z.cross(lever);
    const auto J_inverse_transposed = posture.jacobian_inverse[s].transpose();
    Vector6d by_q = of.q[s];
    Vector3d by_lever{0, 0, 0};
    if (of_speeds) {
      const Vector6d by_twist = J_inverse_transposed * of.speeds[s];
      by_q -= ByJacobian(posture.frames[s], posture.speeds[s], by_twist);
      const Vector3d w = jet.first.segment<3>(foot) - posture.waist_velocity - yaw_rate * carried;
      const Vector3d by_w = R * by_twist.tail<3>();
      by.first.segment<3>(foot) += by_w;
      by.first[foot + 3] += by_twist[2];
      by_yaw -= by_w.dot(z.cross(w));
      by_yaw_rate -= by_twist[2] + by_w.dot(carried);
      by_waist_velocity -= by_w;
      by_lever -= yaw_rate * by_w.cross(z);
    }
    Vector6d by_pose = J_inverse_transposed * by_q;
    by_pose.tail<3>() += of.sole_B[s];
    const Vector3d by_seen_from_B = R * by_pose.tail<3>();
    by_lever += by_seen_from_B;
    by_yaw -= by_pose[2] + by_seen_from_B.dot(carried);
    by.value[foot + 3] += by_pose[2];
    by.value.segment<3>(foot) += by_lever;
    by_waist -= by_lever;
  }
  const double com_x = robot.com_x_B;
  by.first.segment<2>(kComX) += by_waist_velocity.head<2>();
  by.first[kWaistYaw] += by_yaw_rate - com_x * y_W.dot(by_waist_velocity);
  by.value.segment<2>(kComX) += by_waist.head<2>();
  by.first[kWaistZ] += by_waist_velocity.z();
  by.value[kWaistZ] += by_waist.z();
  by.value[kWaistYaw] +=
      by_yaw - com_x * (y_W.dot(by_waist) - yaw_rate * x_W.dot(by_waist_velocity));
  return by;
}

}  // namespace halfstep
