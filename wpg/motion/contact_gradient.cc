#include "wpg/motion/contact_gradient.h"

#include "wpg/motion/upright_slopes.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// Sums over the bodies that one joint moves: gradients with respect to an acceleration and to a
// velocity that all of them gain, and their force.
struct Composite {
  Vector6d by_acceleration = Vector6d::Zero(), by_velocity = Vector6d::Zero();
  Vector6d force = Vector6d::Zero();

  // Of by_contact · (I a + v ×* I v).
  void Add(const RobotDynamics::Body& body, const Vector6d& by_contact) {
    const Vector6d momentum = body.inertia * by_contact;
    by_acceleration += momentum;
    by_velocity += CrossForce(body.velocity, momentum) -
                   body.inertia * CrossMotion(body.velocity, by_contact) -
                   CrossForce(by_contact, body.inertia * body.velocity);
    force += body.force;
  }
  void Add(const Composite& other) {
    by_acceleration += other.by_acceleration;
    by_velocity += other.by_velocity;
    force += other.force;
  }
};

}  // namespace

ContactGradient::ContactGradient(const RobotModel& robot, const WalkJet& x, const Posture& posture,
                                 const RobotDynamics& dynamics, const Vector6d& by_contact) {
  const RobotDynamics::Body& waist = dynamics.waist();
  const Eigen::Matrix3d& R = posture.X_WB.linear();
  Composite all;
  all.Add(waist, by_contact);
  std::array<Vector6d, 2> by_sole;  // of the sole's spatial acceleration
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const size_t s = static_cast<size_t>(Index(side));
    const RobotDynamics::LegBodies& leg = dynamics.leg(side);
    const Vector6d &v_sole = leg[5].velocity, &a_sole = leg[5].acceleration;
    const auto parent_of = [&](size_t j) -> const RobotDynamics::Body& {
      return j == 0 ? waist : leg[j - 1];
    };
    Vector6d by_acceleration;
    std::array<Vector6d, 6> carried;  // each joint's screw, by the body before it
    Composite moved;
    for (size_t j = 6; j-- > 0;) {
      const Eigen::Index i = static_cast<Eigen::Index>(j);
      moved.Add(leg[j], by_contact);
      const RobotDynamics::Body& parent = parent_of(j);
      const Vector6d& S = leg[j].screw;
      const Vector6d S1 = CrossMotion(parent.velocity, S);
      const Vector6d S2 = CrossMotion(parent.acceleration, S) + CrossMotion(parent.velocity, S1);
      by_acceleration[i] = S.dot(moved.by_acceleration);
      speeds[s][i] = S.dot(moved.by_velocity) + 2.0 * S1.dot(moved.by_acceleration);
      q[s][i] = by_contact.dot(CrossForce(S, moved.force)) + S1.dot(moved.by_velocity) +
                S2.dot(moved.by_acceleration);
      carried[j] = S1;
    }
    all.Add(moved);
    // δq̈ = J⁻¹ (what the sole's acceleration gains − what q and q̇ give it).
    const Vector6d by_twist = posture.jacobian_inverse[s].transpose() * by_acceleration;
    const Vector3d sole = posture.X_WSole[s].translation() - dynamics.O();
    const Vector3d by_move = R * by_twist.tail<3>();
    by_sole[s] = Spatial(R * by_twist.head<3>() + sole.cross(by_move), by_move);
    // Of what carries the sole with a screw.
    const Vector6d carrying = CrossForce(v_sole, by_sole[s]);
    for (size_t j = 0; j < 6; ++j) {
      const Eigen::Index i = static_cast<Eigen::Index>(j);
      const RobotDynamics::Body& parent = parent_of(j);
      const Vector6d &S = leg[j].screw, &S1 = carried[j];
      q[s][i] -= S.dot(CrossForce(a_sole - parent.acceleration, by_sole[s])) +
                 S1.dot(CrossForce(v_sole - parent.velocity, by_sole[s]));
      speeds[s][i] -= 2.0 * S1.dot(by_sole[s]) + S.dot(carrying);
    }
  }
  // Everything is displaced with the waist; beyond that, all bodies gain a velocity and an
  // acceleration. What the soles gain by these is not left to the joints.
  WaistGradient by_waist;
  by_waist.acceleration = all.by_acceleration - by_sole[0] - by_sole[1];
  by_waist.velocity = all.by_velocity - CrossForce(waist.velocity, all.by_acceleration);
  by_waist.displacement = -CrossForce(by_contact, dynamics.contact());
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const RobotDynamics::Body& sole = dynamics.leg(side)[5];
    const Vector6d& by = by_sole[static_cast<size_t>(Index(side))];
    by_waist.velocity -= CrossForce(sole.velocity - waist.velocity, by);
    by_waist.displacement -= CrossForce(sole.acceleration, by);
    AddSoleAcceleration(side, x, posture, dynamics, by, &jet);
  }
  by_waist.displacement -= CrossForce(waist.velocity, by_waist.velocity) +
                           CrossForce(waist.acceleration, by_waist.acceleration);
  by_waist.AddTo(robot, x, posture, dynamics, &jet);
}

}  // namespace halfstep
