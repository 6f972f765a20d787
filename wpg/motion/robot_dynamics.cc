#include "wpg/motion/robot_dynamics.h"

#include <cmath>

namespace halfstep {
namespace {

using Eigen::Vector3d;

// I a + v ×* I v.
Vector6d ForceOf(const RobotDynamics::Body& body) {
  return body.inertia * body.acceleration + CrossForce(body.velocity, body.inertia * body.velocity);
}

}  // namespace

Vector6d UprightVelocity(const Vector3d& p, const Vector3d& v, double rate) {
  const Vector3d turn = rate * Vector3d::UnitZ();
  return Spatial(turn, v - turn.cross(p));
}

Vector6d UprightAcceleration(const Vector3d& p, const Vector3d& v, const Vector3d& a, double rate,
                             double acceleration) {
  const Vector3d turn = rate * Vector3d::UnitZ(), more = acceleration * Vector3d::UnitZ();
  return Spatial(more, a - more.cross(p) - turn.cross(v));
}

Vector3d WaistAcceleration(const RobotModel& robot, const WalkJet& jet, const Posture& posture) {
  const Eigen::Matrix3d& R = posture.X_WB.linear();
  const double rate = jet.first[kWaistYaw];
  Vector3d a(jet.second[kComX], jet.second[kComY], jet.second[kWaistZ]);
  a -= robot.com_x_B * (jet.second[kWaistYaw] * R.col(1) - rate * rate * R.col(0));
  return a;
}

RobotDynamics::RobotDynamics(const RobotModel& robot, const WalkJet& jet, const Posture& posture,
                             double gravity)
    : O_(posture.X_WB.translation().x(), posture.X_WB.translation().y(), 0.0) {
  const auto from_O = [this](Eigen::Isometry3d X) {
    X.translation() -= O_;
    return X;
  };
  const Eigen::Isometry3d X_OB = from_O(posture.X_WB);
  const Eigen::Matrix3d& R = X_OB.linear();
  const double rate = jet.first[kWaistYaw];
  waist_.velocity = UprightVelocity(X_OB.translation(), posture.waist_velocity, rate);
  waist_.acceleration =
      UprightAcceleration(X_OB.translation(), posture.waist_velocity,
                          WaistAcceleration(robot, jet, posture), rate, jet.second[kWaistYaw]);
  waist_.acceleration[5] += gravity;
  waist_.inertia = SpatialInertia(robot.masses.waist, X_OB);
  waist_.force = ForceOf(waist_);
  contact_ = waist_.force;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const size_t s = static_cast<size_t>(Index(side));
    const LegFrames& frames = posture.frames[s];
    // With q̈ = 0 first.
    const Body* parent = &waist_;
    for (size_t j = 0; j < 6; ++j) {
      Body& body = legs_[s][j];
      const Vector3d axis = R * frames.axis_B[j];
      body.screw = Spatial(axis, (X_OB * frames.point_B[j]).cross(axis));
      const Vector6d turn = posture.speeds[s][static_cast<Eigen::Index>(j)] * body.screw;
      body.velocity = parent->velocity + turn;
      body.acceleration = parent->acceleration + CrossMotion(parent->velocity, turn);
      parent = &body;
    }
    const int foot = FootIndex(side);
    const Vector3d sole = posture.X_WSole[s].translation() - O_;
    Vector6d demanded =
        UprightAcceleration(sole, jet.first.segment<3>(foot), jet.second.segment<3>(foot),
                            jet.first[foot + 3], jet.second[foot + 3]);
    demanded[5] += gravity;
    const Vector6d missing = demanded - legs_[s][5].acceleration;
    const Vector3d turn = missing.head<3>();
    // As the posture's Jacobian has it: of the sole's origin, in B.
    accelerations_[s] =
        posture.jacobian_inverse[s] *
        Spatial(R.transpose() * turn, R.transpose() * (missing.tail<3>() + turn.cross(sole)));
    Vector6d added = Vector6d::Zero();
    for (size_t j = 0; j < 6; ++j) {
      Body& body = legs_[s][j];
      added += accelerations_[s][static_cast<Eigen::Index>(j)] * body.screw;
      body.acceleration += added;
      body.inertia = SpatialInertia(robot.masses.links[s][j], from_O(posture.X_WLink[s][j]));
      body.force = ForceOf(body);
      contact_ += body.force;
    }
  }
  if (!robot.masses.known()) contact_.setConstant(std::nan(""));
}

std::optional<Eigen::Vector2d> RobotDynamics::Zmp(double height) const {
  const double push = contact_[5];
  if (!(push > 0.0)) return std::nullopt;
  const Eigen::Vector2d on_floor(O_.x() - contact_[1] / push, O_.y() + contact_[0] / push);
  if (height == 0.0) return on_floor;
  return on_floor + height * Tilt();
}

Eigen::Vector2d RobotDynamics::ZmpSlope(const Vector6d& contact_slope, double height) const {
  const double push = contact_[5];
  const Eigen::Vector2d from_O = Eigen::Vector2d(-contact_[1], contact_[0]) / push;
  const Eigen::Vector2d on_floor =
      (Eigen::Vector2d(-contact_slope[1], contact_slope[0]) - contact_slope[5] * from_O) / push;
  if (height == 0.0) return on_floor;
  return on_floor + height * TiltSlope(contact_, contact_slope);
}

Vector6d RobotDynamics::ZmpGradient(const Eigen::Vector2d& along, double height) const {
  const double push = contact_[5];
  const Eigen::Vector2d from_O = Eigen::Vector2d(-contact_[1], contact_[0]) / push;
  Vector6d gradient = Vector6d::Zero();
  gradient[0] = along.y() / push;
  gradient[1] = -along.x() / push;
  gradient[5] = -along.dot(from_O) / push;
  if (height == 0.0) return gradient;
  gradient.segment<2>(3) = height * along / push;
  gradient[5] -= height * along.dot(Tilt()) / push;
  return gradient;
}

Eigen::Vector2d TiltSlope(const Vector6d& contact, const Vector6d& contact_slope) {
  const Eigen::Vector2d tilt = contact.segment<2>(3) / contact[5];
  return (contact_slope.segment<2>(3) - contact_slope[5] * tilt) / contact[5];
}

}  // namespace halfstep
