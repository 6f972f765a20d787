#include "wpg/motion/link_motions.h"

#include "wpg/robot/leg_neighbourhood.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;
using JointRanges = std::array<Range, 6>;

// A frame that stays upright; `x` and `yaw` are indices of quantities, z is `height` or a quantity.
RigidMotion Upright(const IntervalMotion& motion, const WalkThirds& thirds, int x, int yaw,
                    std::optional<double> height) {
  const double h = motion.half_width;
  const Vector3d z = Vector3d::UnitZ();
  const int size = height ? 2 : 3;
  const auto place = [&](const WalkState& state) {
    Vector3d p(0, 0, 0);
    p.head(size) = state.segment(x, size);
    return p;
  };
  RigidMotion frame;
  const Range third = thirds.of(yaw);
  const double second =
      std::min(motion.second[yaw], std::abs(motion.jet.second[yaw]) + h * third.most());
  frame.turn = {motion.jet.first[yaw] * z, h * second};
  frame.turn1 = {motion.jet.second[yaw] * z, h * third.most()};
  frame.turn2 = {third.center * z, third.radius};
  frame.p3 = {place(thirds.center), place(thirds.radius).norm()};
  frame.p2 = {place(motion.jet.second), h * frame.p3.most()};
  frame.p1 = {place(motion.jet.first), h * std::min(place(motion.second).norm(), frame.p2.most())};
  frame.p = {place(motion.jet.value), h * frame.p1.most()};
  if (height) frame.p.center.z() = *height;
  frame.BoundTurned(h);
  return frame;
}

// One leg between the motions of waist and sole.
class LegMotion {
 public:
  LegMotion(const RigidMotion& waist, const RigidMotion& sole, const IntervalMotion& motion,
            size_t leg)
      : waist_(waist), sole_(sole), h_(motion.half_width) {
    const Posture& posture = motion.posture;
    const Eigen::Matrix3d R = posture.X_WB.linear();
    for (size_t j = 0; j < 6; ++j) {
      axis_[j] = R * posture.frames[leg].axis_B[j];
      point_[j] = posture.X_WB * posture.frames[leg].point_B[j];
    }
    // Of a twist about the knee's point.
    const Matrix6d& inverse = posture.jacobian_inverse[leg];
    by_velocity_ = inverse.rightCols<3>() * R.transpose();
    by_turn_ = inverse.leftCols<3>() * R.transpose() -
               by_velocity_ * CrossMatrix(sole.p.center - point_[3]);
  }

  void Place(const JointRanges& q1, const JointRanges& q2, const JointRanges& q3) {
    const RigidMotion* parent = &waist_;
    for (size_t j = 0; j < 3; ++j) {
      links[j] = parent->At(point_[j] - parent->p.center).Turned(axis_[j], q1[j], q2[j], q3[j], h_);
      parent = &links[j];
    }
    links[5] = sole_;
    for (size_t j = 5; j > 3; --j) {
      const RigidMotion& child = links[j];
      links[j - 1] =
          child.At(point_[j] - child.p.center).Turned(-axis_[j], q1[j], q2[j], q3[j], h_);
    }
  }

  // The joints' third derivatives, from links that were placed without them.
  std::optional<JointRanges> Thirds(const JointRanges& q1, const JointRanges& q2) const {
    const RigidMotion thigh = links[2].At(point_[3] - links[2].p.center);
    const RigidMotion shank = links[3].At(point_[3] - links[3].p.center);
    const VectorBall k = thigh.Carried(axis_[3]), k1 = Cross(thigh.turn, k);
    const VectorBall k2 = Cross(thigh.turn1, k) + Cross(thigh.turn, k1);
    const VectorBall turn = shank.turn2 - thigh.turn2 - 2.0 * (q2[3] * k1) - q1[3] * k2;
    const VectorBall velocity = shank.p3 - thigh.p3;
    const Vector6d center = by_turn_ * turn.center + by_velocity_ * velocity.center;
    const Vector6d turn_norms = by_turn_.rowwise().norm();
    const Vector6d velocity_norms = by_velocity_.rowwise().norm();
    const Vector6d spread = turn_norms * turn.radius + velocity_norms * velocity.radius;
    // What J differs from the one at m by.
    Matrix6d change;
    const auto add = [&](size_t j, const VectorBall& axis, const VectorBall& arm) {
      change.col(static_cast<Eigen::Index>(j)) =
          turn_norms * axis.radius + velocity_norms * Cross(axis, arm).radius;
    };
    VectorBall arm = links[2].Carried(point_[3] - point_[2]);
    for (size_t j = 3; j-- > 0;) {
      add(j, links[j].Carried(axis_[j]), arm);
      if (j > 0) arm += links[j - 1].Carried(point_[j] - point_[j - 1]);
    }
    add(3, k, {});
    arm = links[3].Carried(point_[3] - point_[4]);
    add(4, links[4].Carried(axis_[4]), arm);
    add(5, links[5].Carried(axis_[5]), arm + links[4].Carried(point_[4] - point_[5]));
    const auto contraction = Contraction::Of(change);
    if (!contraction) return std::nullopt;
    const Vector6d most = contraction->Resolve(change, center.cwiseAbs() + spread);
    const Vector6d radius = spread + change * most;
    JointRanges thirds;
    for (size_t j = 0; j < 6; ++j) {
      const Eigen::Index i = static_cast<Eigen::Index>(j);
      thirds[j] = {center[i], radius[i]};
    }
    return thirds;
  }

  std::array<RigidMotion, 6> links;

 private:
  const RigidMotion &waist_, &sole_;
  double h_;
  std::array<Vector3d, 6> axis_, point_;  // in W at m
  Eigen::Matrix<double, 6, 3> by_turn_, by_velocity_;
};

}  // namespace

std::optional<LinkMotions> LinkMotions::Over(const RobotModel& robot, const IntervalMotion& motion,
                                             const WalkThirds& thirds, const RobotDynamics& at_m) {
  const double h = motion.half_width;
  LinkMotions all;
  all.waist = Upright(motion, thirds, kComX, kWaistYaw, robot.waist_height);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const size_t s = static_cast<size_t>(Index(side));
    const int foot = FootIndex(side);
    const RigidMotion sole = Upright(motion, thirds, foot, foot + 3, std::nullopt);
    LegMotion leg(all.waist, sole, motion, s);
    JointRanges &q1 = all.speeds[s], &q2 = all.accelerations[s], &q3 = all.thirds[s];
    const JointBounds& bounds = motion.joints[s];
    for (size_t j = 0; j < 6; ++j) {
      const Eigen::Index i = static_cast<Eigen::Index>(j);
      const double acceleration = at_m.accelerations(side)[i];
      q1[j] = {motion.posture.speeds[s][i], h * bounds.acceleration[i]};
      q2[j] = {acceleration, std::abs(acceleration) + bounds.acceleration[i]};
    }
    // The first bound of q⃛ has a generous range of q̈, the second that which the first implies.
    for (int round = 0; round < 2; ++round) {
      leg.Place(q1, q2, {});
      const auto bounded = leg.Thirds(q1, q2);
      if (!bounded) return std::nullopt;
      q3 = *bounded;
      for (size_t j = 0; j < 6; ++j) {
        q2[j].radius = std::min(q2[j].radius, h * q3[j].most());
        q1[j].radius = std::min(q1[j].radius, h * q2[j].most());
      }
    }
    leg.Place(q1, q2, q3);
    all.links[s] = leg.links;
  }
  return all;
}

}  // namespace halfstep
