#include "wpg/motion_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wpg/check.h"

namespace halfstep {
namespace {

// Distance of a point of a shape posed at X from the vertical axis of X's base, at most.
double Lever(const Eigen::Vector3d& center, double radius) {
  return center.head<2>().norm() + radius;
}

// √(x² + y²) of two quantities' sups.
double Planar(const WalkVector& x, int quantity) {
  return std::hypot(x[quantity], x[quantity + 1]);
}

}  // namespace

MotionBounds::MotionBounds(const RobotModel& robot)
    : robot_(robot), extents_{LegExtents(robot.legs[0]), LegExtents(robot.legs[1])} {}

MotionBounds::BaseRates MotionBounds::SoleRates(const IntervalMotion& motion, Side side) {
  const int i = FootIndex(side);
  const Eigen::Vector3d second = motion.second.segment<3>(i);
  BaseRates rates;
  rates.acceleration = second.norm();
  rates.speed = motion.jet.first.segment<3>(i).norm() + motion.half_width * rates.acceleration;
  rates.yaw_acceleration = motion.second[i + 3];
  rates.yaw_rate = std::abs(motion.jet.first[i + 3]) + motion.RateChange(i + 3);
  return rates;
}

MotionBounds::BaseRates MotionBounds::WaistRates(const IntervalMotion& motion) const {
  // p_WB = c − R(yaw)·(com_x, 0).
  BaseRates rates;
  rates.yaw_acceleration = motion.second[kWaistYaw];
  rates.yaw_rate = std::abs(motion.jet.first[kWaistYaw]) + motion.RateChange(kWaistYaw);
  const double arm = std::abs(robot_.com_x_B);
  rates.acceleration = Planar(motion.second, kComX) +
                       arm * (rates.yaw_acceleration + rates.yaw_rate * rates.yaw_rate);
  rates.speed = Planar(motion.jet.first, kComX) + motion.half_width * Planar(motion.second, kComX) +
                arm * rates.yaw_rate;
  return rates;
}

double MotionBounds::WorldAcceleration(const BaseRates& base, const PointBound& relative,
                                       double lever) {
  return base.acceleration + (base.yaw_acceleration + base.yaw_rate * base.yaw_rate) * lever +
         2.0 * base.yaw_rate * relative.speed + relative.acceleration;
}

bool MotionBounds::BoundLeg(Side side, const BaseRates& waist, IntervalMotion* motion) const {
  const size_t s = static_cast<size_t>(Index(side));
  const BaseRates sole = SoleRates(*motion, side);
  const double h = motion->half_width;
  const double relative_speed = sole.speed + waist.speed;
  const Eigen::Vector3d lever =
      motion->posture.X_WSole[s].translation() - motion->posture.X_WB.translation();
  const double distance = lever.head<2>().norm() + h * relative_speed;
  // Seen from the turning waist: ẍ − ψ̈ẑ×d − 2ψ̇ẑ×ḋ + ψ̇²d.
  const TwistRateBound twist_rate{
      .angular = sole.yaw_acceleration + waist.yaw_acceleration,
      .linear = sole.acceleration + waist.acceleration +
                (waist.yaw_acceleration + waist.yaw_rate * waist.yaw_rate) * distance +
                2.0 * waist.yaw_rate * relative_speed};
  const auto bounds = BoundJoints(extents_[s], motion->posture.jacobian_inverse[s],
                                  motion->posture.speeds[s], twist_rate, h);
  if (!bounds) return false;
  motion->joints[s] = *bounds;
  const double knee_change =
      h * (std::abs(motion->posture.speeds[s][3]) + 0.5 * h * bounds->acceleration[3]);
  motion->leg_length_change[s] =
      LegLengthChange(robot_.legs[s], motion->posture.frames[s], knee_change);
  return true;
}

// With a, b from the knee to hip and ankle, d = ‖b − a‖: d' = ω·(a × b)/d and
// |d''| ≤ (‖a‖‖b‖ + d'²)/d, where |d'| ≤ min(‖a‖, ‖b‖).
double MotionBounds::LegLengthChange(const Leg& leg, const LegFrames& frames, double knee_change) {
  const Eigen::Isometry3d& X_BShank = frames.X_BLink[3];
  const Eigen::Vector3d ankle_B = X_BShank * (leg.joints[3].X_BLink.inverse() * leg.ankle_B);
  const Eigen::Vector3d a = leg.hip_B - frames.point_B[3], b = ankle_B - frames.point_B[3];
  const double least = std::min(a.norm(), b.norm());
  const double distance = (b - a).norm();
  const double shortest = distance - least * knee_change;
  if (!(shortest > 0.0)) return std::numeric_limits<double>::infinity();
  const double first = std::abs(frames.axis_B[3].dot(a.cross(b))) / distance;
  const double second = (a.norm() * b.norm() + least * least) / shortest;
  return knee_change * (first + 0.5 * knee_change * second);
}

void MotionBounds::BoundBody(size_t index, const BaseRates& waist, IntervalMotion* motion) const {
  const RobotBody& body = robot_.bodies[index];
  const Posture& posture = motion->posture;
  const double h = motion->half_width;
  const double radius = body.shape.radius;

  // Velocity at m of the body's sphere, exact, seen from the waist; and bounds along the leg.
  Eigen::Vector3d center_B = body.shape.center, velocity_B{0, 0, 0}, omega_B{0, 0, 0};
  PointBound from_waist;
  double world = std::numeric_limits<double>::infinity();
  if (body.leg >= 0) {
    const size_t s = static_cast<size_t>(body.leg);
    const LegFrames& frames = posture.frames[s];
    const JointBounds& joints = motion->joints[s];
    center_B = frames.X_BLink[static_cast<size_t>(body.link)] * body.shape.center;
    std::array<ChainJoint, 6> chain;
    const auto joint = [&](int j) {
      return ChainJoint{joints.speed[j], joints.acceleration[j], extents_[s].ToBody(j, body)};
    };
    for (int j = 0; j <= body.link; ++j) {
      const size_t i = static_cast<size_t>(j);
      const Eigen::Vector3d turn = posture.speeds[s][j] * frames.axis_B[i];
      omega_B += turn;
      velocity_B += turn.cross(center_B - frames.point_B[i]);
      chain[i] = joint(j);
    }
    from_waist = BoundChain({chain.data(), static_cast<size_t>(body.link) + 1});
    // The same point, carried by the sole and the joints below it.
    size_t n = 0;
    for (int j = 5; j > body.link; --j) chain[n++] = joint(j);
    const PointBound from_sole = BoundChain({chain.data(), n});
    const Eigen::Vector3d center_S = frames.X_BLink[6].inverse() * center_B;
    world = WorldAcceleration(SoleRates(*motion, static_cast<Side>(body.leg)), from_sole,
                              Lever(center_S, radius) + h * from_sole.speed);
  }
  world = std::min(
      world, WorldAcceleration(waist, from_waist, Lever(center_B, radius) + h * from_waist.speed));

  const Eigen::Matrix3d& R = posture.X_WB.linear();
  const Eigen::Vector3d omega_W =
      R * omega_B + motion->jet.first[kWaistYaw] * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d velocity_W =
      posture.waist_velocity + R * velocity_B +
      motion->jet.first[kWaistYaw] * Eigen::Vector3d::UnitZ().cross(R * center_B);
  const double speed_W = velocity_W.norm() + omega_W.norm() * radius;
  const double speed_B = velocity_B.norm() + omega_B.norm() * radius;
  motion->displacement[index] = h * (speed_W + 0.5 * h * world);
  motion->displacement_B[index] = h * (speed_B + 0.5 * h * from_waist.acceleration);
}

void MotionBounds::Bound(const WalkJet& mid, const WalkVector& second, double half_width,
                         IntervalMotion* motion) const {
  HALFSTEP_CHECK(half_width >= 0.0, "half_width = " << half_width);
  motion->half_width = half_width;
  motion->jet = mid;
  motion->second = second;
  motion->displacement.resize(robot_.bodies.size());
  motion->displacement_B.resize(robot_.bodies.size());
  motion->posture = SolvePosture(robot_, motion->jet.value);
  motion->bounded = motion->posture.reachable;
  if (!motion->bounded) return;
  motion->bounded = SolveJointSpeeds(robot_, motion->jet, &motion->posture);
  const BaseRates waist = WaistRates(*motion);
  for (Side side : {Side::kLeft, Side::kRight}) {
    motion->bounded = motion->bounded && BoundLeg(side, waist, motion);
  }
  if (!motion->bounded) return;
  for (size_t b = 0; b < robot_.bodies.size(); ++b) BoundBody(b, waist, motion);
}

}  // namespace halfstep
