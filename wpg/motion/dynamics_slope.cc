#include "wpg/motion/dynamics_slope.h"

#include "wpg/motion/upright_slopes.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// How a body is displaced, and its velocity and acceleration change.
struct Change {
  Vector6d displacement, velocity, acceleration;
};

// Of the force I a + v ×* I v: all of it is displaced with the body, and what the body gains beyond
// that is added.
Vector6d ForceSlope(const RobotDynamics::Body& body, const Change& change) {
  const Vector6d gained = change.velocity - CrossMotion(change.displacement, body.velocity);
  const Vector6d pushed = change.acceleration - CrossMotion(change.displacement, body.acceleration);
  return CrossForce(change.displacement, body.force) + body.inertia * pushed +
         CrossForce(gained, body.inertia * body.velocity) +
         CrossForce(body.velocity, body.inertia * gained);
}

}  // namespace

DynamicsSlope::DynamicsSlope(const RobotModel& robot, const WalkJet& jet, const Posture& posture,
                             const RobotDynamics& dynamics, const DynamicsTangent& tangent) {
  const WaistSlope waist(robot, jet, posture, dynamics, tangent.jet);
  const Change of_waist{waist.displacement, waist.velocity, waist.acceleration};
  const Eigen::Matrix3d R_BW = posture.X_WB.linear().transpose();
  contact_ = ForceSlope(dynamics.waist(), of_waist);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const size_t s = static_cast<size_t>(Index(side));
    const RobotDynamics::LegBodies& bodies = dynamics.leg(side);
    std::array<Link, 6>& links = legs_[s];
    std::array<Change, 6> changes;
    // As if q̈ did not change.
    const RobotDynamics::Body* parent = &dynamics.waist();
    Change before = of_waist;
    for (size_t j = 0; j < 6; ++j) {
      const Eigen::Index i = static_cast<Eigen::Index>(j);
      const Vector6d& S = bodies[j].screw;
      const double speed = posture.speeds[s][i];
      const Vector6d dS = CrossMotion(before.displacement, S);
      const Vector6d turn_slope = tangent.speeds[s][i] * S + speed * dS;
      links[j].screw = dS;
      changes[j] = {before.displacement + tangent.q[s][i] * S, before.velocity + turn_slope,
                    before.acceleration + dynamics.accelerations(side)[i] * dS +
                        CrossMotion(before.velocity, speed * S) +
                        CrossMotion(parent->velocity, turn_slope)};
      before = changes[j];
      parent = &bodies[j];
    }
    // δq̈ = J⁻¹ (what the sole's acceleration gains − what q and q̇ give it).
    const Vector6d missing =
        SoleAccelerationSlope(side, jet, posture, dynamics, tangent.jet) - before.acceleration;
    const Vector3d sole = posture.X_WSole[s].translation() - dynamics.O(), turn = missing.head<3>();
    accelerations_[s] = posture.jacobian_inverse[s] *
                        Spatial(R_BW * turn, R_BW * (missing.tail<3>() + turn.cross(sole)));
    Vector6d added = Vector6d::Zero();
    for (size_t j = 0; j < 6; ++j) {
      added += accelerations_[s][static_cast<Eigen::Index>(j)] * bodies[j].screw;
      changes[j].acceleration += added;
      links[j].force = ForceSlope(bodies[j], changes[j]);
      contact_ += links[j].force;
    }
  }
}

}  // namespace halfstep
