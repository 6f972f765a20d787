// The oracle's statements about accelerations of joints, and about what the floor gives.
#include <cmath>

#include "tests/oracle/plain_soles.h"
#include "tests/oracle/walk_truth.h"

namespace halfstep::oracle {

const PlainDynamics& WalkTruth::DynamicsOf(Instant& at) const {
  if (!at.dynamics) at.dynamics.emplace(robot_, at.state, at.q, at.speed);
  return *at.dynamics;
}

// The wrench of the floor on one foot, as wpg/README.md has two feet share it: force, and moment
// about the ZMP.
std::array<Eigen::Vector3d, 2> WalkTruth::FloorOn(size_t foot, Instant& at,
                                                  const Stretch& s) const {
  const PlainDynamics& dynamics = DynamicsOf(at);
  const Eigen::Vector3d moment(0, 0, dynamics.yaw_moment);
  if (s.in_air >= 0) {
    if (s.in_air == static_cast<int>(foot)) return {Eigen::Vector3d(0, 0, 0), {0, 0, 0}};
    return {dynamics.force, moment};
  }
  const auto& feet = at.state.value.feet;
  const Eigen::Vector2d p = dynamics.zmp_in_world();
  const double left = FromSole(feet[0], robot_.sole_size, p);
  const double right = FromSole(feet[1], robot_.sole_size, p);
  const double lambda = left / (left + right);
  Eigen::Vector3d apart(0, 0, 0);
  apart.head<2>() = (feet[1] - feet[0]).head<2>();
  const Eigen::Vector3d couple =
      lambda * (1 - lambda) * dynamics.force.z() * apart.cross(Eigen::Vector3d(0, 0, 1));
  if (foot == 1) return {lambda * dynamics.force, lambda * moment + couple};
  return {(1 - lambda) * dynamics.force, (1 - lambda) * moment - couple};
}

// The coefficient that suffices for a pressure of two points.
double WalkTruth::FrictionNeeded(Instant& at, const Stretch& s) const {
  const PlainDynamics& dynamics = DynamicsOf(at);
  const double lever = LongestLever(SupportCorners(at.state, s), dynamics.zmp_in_world());
  if (!(lever > 0) || !(dynamics.force.z() > 0)) return kNever;
  return (dynamics.force.head<2>().norm() + std::abs(dynamics.yaw_moment) / lever) /
         dynamics.force.z();
}

void WalkTruth::AddDynamicStatements() {
  const double effort = robot_.mass * kGravity * 0.7 * robot_.size();  // [N m]
  statements_.push_back(
      {"zmp_robot", "", 20.0 * robot_.size(), [this](Instant& at, const Stretch& s) {
         if (!at.reaches || !(DynamicsOf(at).force.z() > 0)) return Exactly(-kNever);
         return Exactly(InsideHull(SupportCorners(at.state, s), DynamicsOf(at).zmp_in_world()));
       }});
  statements_.push_back({"friction", "", 20.0, [this](Instant& at, const Stretch& s) {
                           if (!at.reaches) return Exactly(-kNever);
                           return Exactly(demands_.friction - FrictionNeeded(at, s));
                         }});
  for (size_t leg = 0; leg < 2; ++leg) {
    for (size_t j = 0; j < 6; ++j) {
      const auto k = static_cast<Eigen::Index>(j);
      const auto& joint = robot_.joints[static_cast<size_t>(robot_.legs[leg].joints[j])];
      if (joint.effort < kNever) {
        statements_.push_back({"torque", joint.name, 40 * effort,
                               [this, &joint, leg, j](Instant& at, const Stretch& s) {
                                 if (!at.reaches || !(DynamicsOf(at).force.z() > 0))
                                   return Exactly(-kNever);
                                 const auto [force, moment] = FloorOn(leg, at, s);
                                 return Exactly(joint.effort - std::abs(DynamicsOf(at).Torque(
                                                                   leg, j, force, moment)));
                               },
                               true});
      }
      if (joint.acceleration < kNever) {
        statements_.push_back({"joint_acceleration", joint.name, 5000.0,
                               [this, &joint, leg, k](Instant& at, const Stretch&) {
                                 if (!at.reaches) return Exactly(-kNever);
                                 return Exactly(joint.acceleration -
                                                std::abs(DynamicsOf(at).acceleration[leg][k]));
                               }});
      }
    }
  }
}

}  // namespace halfstep::oracle
