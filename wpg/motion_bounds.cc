#include "wpg/motion_bounds.h"

#include <algorithm>
#include <cmath>

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
    : robot_(robot), anchors_{LegAnchors(robot.legs[0]), LegAnchors(robot.legs[1])} {
  for (const RobotBody& body : robot.bodies) {
    reach_.push_back(body.leg < 0 ? 0.0 : anchors_[static_cast<size_t>(body.leg)].Reach(body));
  }
}

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

double MotionBounds::AccelerationFrom(const BaseRates& base, const TurnBound& turn, double reach,
                                      double lever) {
  return base.acceleration + (base.yaw_acceleration + base.yaw_rate * base.yaw_rate) * lever +
         (2.0 * base.yaw_rate * turn.speed + turn.acceleration + turn.speed * turn.speed) * reach;
}

// Seen from the turning waist: ẍ − ψ̈ẑ×d − 2ψ̇ẑ×ḋ + ψ̇²d.
MotionBounds::BaseRates MotionBounds::SoleFromWaist(const IntervalMotion& motion, Side side,
                                                    const BaseRates& waist) {
  const size_t s = static_cast<size_t>(Index(side));
  const BaseRates sole = SoleRates(motion, side);
  const double speed = sole.speed + waist.speed;
  const Eigen::Vector3d lever =
      motion.posture.X_WSole[s].translation() - motion.posture.X_WB.translation();
  const double distance = lever.head<2>().norm() + motion.half_width * speed;
  BaseRates rates;
  rates.yaw_acceleration = sole.yaw_acceleration + waist.yaw_acceleration;
  rates.yaw_rate = std::abs(motion.jet.first[FootIndex(side) + 3] - motion.jet.first[kWaistYaw]) +
                   motion.half_width * rates.yaw_acceleration;
  rates.acceleration = sole.acceleration + waist.acceleration +
                       (waist.yaw_acceleration + waist.yaw_rate * waist.yaw_rate) * distance +
                       2.0 * waist.yaw_rate * speed;
  return rates;
}

bool MotionBounds::BoundLeg(Side side, const BaseRates& waist, IntervalMotion* motion) const {
  const size_t s = static_cast<size_t>(Index(side));
  const int foot = FootIndex(side);
  const LegAnchors& anchors = anchors_[s];
  const Posture& posture = motion->posture;
  const WalkVector& first = motion->jet.first;
  const double h = motion->half_width;
  const BaseRates sole = SoleRates(*motion, side);
  const BaseRates relative = SoleFromWaist(*motion, side, waist);
  const auto turning = [](const BaseRates& base) {
    return base.yaw_acceleration + base.yaw_rate * base.yaw_rate;
  };

  // w = hip − ankle, in W.
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d hip_W = posture.X_WB.linear() * anchors.hip_B();
  const Eigen::Vector3d ankle_W = posture.X_WSole[s].linear() * anchors.ankle_S();
  const Eigen::Vector3d w =
      posture.X_WB.translation() + hip_W - posture.X_WSole[s].translation() - ankle_W;
  const Eigen::Vector3d w_rate = posture.waist_velocity + first[kWaistYaw] * z.cross(hip_W) -
                                 first.segment<3>(foot) - first[foot + 3] * z.cross(ankle_W);
  const double hip_lever = std::hypot(anchors.hip_B().x() - robot_.com_x_B, anchors.hip_B().y());
  const double ankle_lever = anchors.ankle_S().head<2>().norm();
  Eigen::Vector3d second = motion->second.segment<3>(foot);
  second.head<2>() +=
      motion->second.segment<2>(kComX) +
      Eigen::Vector2d::Constant(turning(waist) * hip_lever + turning(sole) * ankle_lever);
  const Eigen::Vector3d rate = w_rate.cwiseAbs() + h * second;
  const Eigen::Vector3d most = w.cwiseAbs() + h * (w_rate.cwiseAbs() + 0.5 * h * second);
  const LegDemand demand{.half_square = rate.squaredNorm() + most.dot(second),
                         // Seen from the turning sole: ẅ − ψ̈ẑ×w − 2ψ̇ẑ×ẇ − ψ̇²w.
                         .horizontal = second.head<2>().norm() +
                                       turning(sole) * most.head<2>().norm() +
                                       2.0 * sole.yaw_rate * rate.head<2>().norm(),
                         .vertical = second.z(),
                         .yaw_rate = relative.yaw_rate,
                         .yaw_acceleration = relative.yaw_acceleration};
  const auto bounds = BoundJoints(anchors, posture.frames[s], posture.speeds[s],
                                  first[foot + 3] - first[kWaistYaw], demand, h);
  if (!bounds) return false;
  motion->joints[s] = *bounds;
  const double change = 2.0 * h * (std::abs(w.dot(w_rate)) + 0.5 * h * demand.half_square);
  const double nearest2 = std::max(0.0, w.squaredNorm() - change);
  motion->leg_length_change[s] = change / (w.norm() + std::sqrt(nearest2));
  return true;
}

void MotionBounds::BoundBody(size_t index, const BaseRates& waist, IntervalMotion* motion) const {
  const RobotBody& body = robot_.bodies[index];
  const Posture& posture = motion->posture;
  const double h = motion->half_width;
  const double radius = body.shape.radius;

  // Velocity at m of the body's sphere, exact, seen from the waist; and sups from where it hangs.
  Eigen::Vector3d center_B = body.shape.center, velocity_B{0, 0, 0}, omega_B{0, 0, 0};
  double world, from_waist = 0.0;
  if (body.leg < 0) {
    world = AccelerationFrom(waist, {}, 0.0, Lever(center_B, radius));
  } else {
    const size_t s = static_cast<size_t>(body.leg);
    const LegFrames& frames = posture.frames[s];
    center_B = frames.X_BLink[static_cast<size_t>(body.link)] * body.shape.center;
    for (int j = 0; j <= body.link; ++j) {
      const size_t i = static_cast<size_t>(j);
      const Eigen::Vector3d turn = posture.speeds[s][j] * frames.axis_B[i];
      omega_B += turn;
      velocity_B += turn.cross(center_B - frames.point_B[i]);
    }
    const TurnBound& turn = motion->joints[s].turns[static_cast<size_t>(body.link)];
    const double reach = reach_[index];
    const double moved = h * turn.speed * reach;
    if (LegAnchors::OnHip(body.link)) {
      from_waist = AccelerationFrom({}, turn, reach, 0.0);
      world = AccelerationFrom(waist, turn, reach, Lever(center_B, radius) + moved);
    } else {
      const Side side = static_cast<Side>(body.leg);
      const double lever = Lever(frames.X_BLink[6].inverse() * center_B, radius) + moved;
      from_waist = AccelerationFrom(SoleFromWaist(*motion, side, waist), turn, reach, lever);
      world = AccelerationFrom(SoleRates(*motion, side), turn, reach, lever);
    }
  }

  const Eigen::Matrix3d& R = posture.X_WB.linear();
  const Eigen::Vector3d omega_W =
      R * omega_B + motion->jet.first[kWaistYaw] * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d velocity_W =
      posture.waist_velocity + R * velocity_B +
      motion->jet.first[kWaistYaw] * Eigen::Vector3d::UnitZ().cross(R * center_B);
  const double speed_W = velocity_W.norm() + omega_W.norm() * radius;
  const double speed_B = velocity_B.norm() + omega_B.norm() * radius;
  motion->displacement[index] = h * (speed_W + 0.5 * h * world);
  motion->displacement_B[index] = h * (speed_B + 0.5 * h * from_waist);
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
