#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <optional>

#include "tests/smoothing/test_walks.h"
#include "wpg/motion/motion_bounds.h"
#include "wpg/motion/robot_dynamics.h"
#include "wpg/motion/walk_thirds.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// A motion of a walk's quantities about the instant 0 with constant third derivatives. It is no
/// walk: any quantity may rest while another one moves as fast as is wanted, so that one term of a
/// bound is the only one that counts.
struct HandMadeMotion {
  WalkJet mid;                          ///< at the instant 0
  WalkState third = WalkState::Zero();  ///< [unit/s³]

  /// All quantities at the instant t [s].
  WalkJet At(double t) const {
    WalkJet jet = mid;
    jet.value += t * (mid.first + t * (mid.second / 2 + t * third / 6));
    jet.first += t * (mid.second + t * third / 2);
    jet.second += t * third;
    return jet;
  }
  /// As walks give them, exact here.
  WalkThirds Thirds() const { return {third, WalkState::Zero()}; }
  /// Of |second derivatives| over [−h, h], exact.
  WalkState SecondBounds(double h) const { return mid.second.cwiseAbs() + h * third.cwiseAbs(); }
};

/// The robot stands as its file says, its CoM above W's origin, and nothing moves.
inline WalkJet Standing(const RobotModel& robot) {
  WalkJet jet;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Leg& leg = robot.legs[static_cast<size_t>(Index(side))];
    const Eigen::Vector3d sole_B = PlaceLeg(leg, leg.standing_q).X_BLink[6].translation();
    jet.value.segment<2>(FootIndex(side)) = sole_B.head<2>() - Eigen::Vector2d(robot.com_x_B, 0);
  }
  return jet;
}

/// One robot's hand-made motion over [−h, h], with its bounds, and with what is true at its
/// instants. Robot and motion are borrowed.
class HandMadeInterval {
 public:
  /// Not bounded() where a leg does not reach or is nearly stretched.
  HandMadeInterval(const RobotModel& robot, const HandMadeMotion& motion, double h)
      : robot_(robot), motion_(motion) {
    MotionBounds(robot).Bound(motion.mid, motion.SecondBounds(h), h, &interval);
    if (interval.bounded) at_m.emplace(robot, motion.mid, interval.posture, kGravity);
  }

  static constexpr double kGravity = 9.81;  ///< [m/s²]

  bool bounded() const { return interval.bounded; }  ///< whether there is anything to compare
  double h() const { return interval.half_width; }   ///< [s]
  /// At the instant t of the interval; all legs reach there.
  Posture PostureAt(double t) const {
    const WalkJet jet = motion_.At(t);
    Posture posture = SolvePosture(robot_, jet.value);
    EXPECT_TRUE(posture.reachable && SolveJointSpeeds(robot_, jet, &posture));
    return posture;
  }
  /// The same with all velocities and accelerations.
  RobotDynamics At(double t) const { return {robot_, motion_.At(t), PostureAt(t), kGravity}; }

  IntervalMotion interval;            ///< bounds of it
  std::optional<RobotDynamics> at_m;  ///< at the instant 0

 private:
  const RobotModel& robot_;
  const HandMadeMotion& motion_;
};

/// Takes all masses from a robot; tests give some bodies others.
inline void WithoutMasses(RobotModel* robot) {
  robot->masses.waist = {};
  for (auto& leg : robot->masses.links) leg.fill({});
}

/// A random motion in which one or two quantities move, in some orders of their derivatives.
inline HandMadeMotion DrawSparseMotion(const RobotModel& robot, double size, WalkDraw* draw) {
  HandMadeMotion motion{.mid = Standing(robot)};
  for (int q = 0; q < kNumQuantities; ++q) {
    const bool yaw = q == kWaistYaw || q == kLeftYaw || q == kRightYaw;
    const bool height = q == kLeftZ || q == kRightZ;
    motion.mid.value[q] +=
        height ? size * draw->Uniform(0.0, 0.2) : (yaw ? 3.0 : size) * draw->Uniform(-0.15, 0.15);
  }
  const int count = 1 + static_cast<int>(draw->Uniform(0, 2));
  for (int k = 0; k < count; ++k) {
    const int q = static_cast<int>(draw->Uniform(0, kNumQuantities));
    const double unit = q == kWaistYaw || q == kLeftYaw || q == kRightYaw ? 2.0 : size;
    const auto move = [&](double most) {
      const double sign = draw->Uniform(0, 1) < 0.5 ? -1 : 1;
      const double x = sign * unit * most * std::pow(30, draw->Uniform(-1, 0));
      return draw->Uniform(0, 1) < 0.5 ? x : 0.0;
    };
    motion.mid.first[q] = move(2);
    motion.mid.second[q] = move(30);
    motion.third[q] = move(2000);
  }
  return motion;
}

/// Gives one or two of a robot's bodies random masses and inertias, and the others none.
inline void DrawSparseMasses(RobotModel* robot, WalkDraw* draw) {
  WithoutMasses(robot);
  const int count = 1 + static_cast<int>(draw->Uniform(0, 2));
  for (int k = 0; k < count; ++k) {
    const size_t body = static_cast<size_t>(draw->Uniform(0, 13));
    BodyMass& of = body == 12 ? robot->masses.waist : robot->masses.links[body / 6][body % 6];
    of.mass = std::pow(10, draw->Uniform(-1, 1.5));
    of.com = Eigen::Vector3d(draw->Uniform(-0.2, 0.2), draw->Uniform(-0.2, 0.2),
                             draw->Uniform(-0.2, 0.2));
    if (draw->Uniform(0, 1) < 0.5) continue;
    Eigen::Matrix3d A;
    for (double& entry : A.reshaped()) entry = draw->Uniform(-1, 1);
    of.inertia = std::pow(10, draw->Uniform(-1, 1)) * (A * A.transpose());
  }
}

}  // namespace halfstep
