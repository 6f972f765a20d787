#include "wpg/motion/zmp_slopes.h"

#include "wpg/check.h"
#include "wpg/motion/upright_slopes.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// Twice the matrix B with 2Bx = v ×* I x − I (v × x) + x ×* I v.
Matrix6d VelocityMatrix(const Matrix6d& I, const Vector6d& v) {
  const Eigen::Matrix3d W = CrossMatrix(v.head<3>()), U = CrossMatrix(v.tail<3>());
  const Vector6d momentum = I * v;
  Matrix6d K;
  K.topRows<3>() = W * I.topRows<3>() + U * I.bottomRows<3>();
  K.bottomRows<3>() = W * I.bottomRows<3>();
  Matrix6d B = K + K.transpose();
  const Eigen::Matrix3d N = CrossMatrix(momentum.head<3>()), L = CrossMatrix(momentum.tail<3>());
  B.topLeftCorner<3, 3>() -= N;
  B.topRightCorner<3, 3>() -= L;
  B.bottomLeftCorner<3, 3>() -= L;
  return B;
}

// Sums over the bodies that one joint moves.
struct Composite {
  Matrix6d inertia = Matrix6d::Zero(), velocity = Matrix6d::Zero();
  Vector6d force = Vector6d::Zero();

  void Add(const RobotDynamics::Body& body) {
    const Matrix6d I = body.inertia.Matrix();
    inertia += I;
    velocity += VelocityMatrix(I, body.velocity);
    force += body.force;
  }
  void Add(const Composite& other) {
    inertia += other.inertia;
    velocity += other.velocity;
    force += other.force;
  }
};

}  // namespace

ZmpSlopes::ZmpSlopes(const RobotModel& robot, const WalkJet& jet, const Posture& posture,
                     const RobotDynamics& dynamics)
    : robot_(robot), jet_(jet), posture_(posture), dynamics_(dynamics) {
  const auto zmp = dynamics.Zmp();
  HALFSTEP_CHECK(zmp.has_value(), "the floor does not push");
  const Eigen::Vector2d p = *zmp - dynamics.O().head<2>();
  const double push = dynamics.contact()[5];
  // p_x = −n_y/f_z, p_y = n_x/f_z.
  by_force_ << 0, -1, 0, 0, 0, -p.x(), 1, 0, 0, 0, 0, -p.y();
  by_force_ /= push;
  Composite all;
  all.Add(dynamics.waist());
  const Eigen::Matrix3d R_BW = posture.X_WB.linear().transpose();
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const size_t s = static_cast<size_t>(Index(side));
    const RobotDynamics::LegBodies& leg = dynamics.leg(side);
    const Vector6d &v_sole = leg[5].velocity, &a_sole = leg[5].acceleration;
    LegRows& rows = legs_[s];
    Rows by_acceleration;
    Composite moved;
    for (size_t j = 6; j-- > 0;) {
      const Eigen::Index column = static_cast<Eigen::Index>(j);
      moved.Add(leg[j]);
      const RobotDynamics::Body& parent = j == 0 ? dynamics.waist() : leg[j - 1];
      const Vector6d& S = leg[j].screw;
      const Vector6d S1 = CrossMotion(parent.velocity, S);
      const Vector6d S2 = CrossMotion(parent.acceleration, S) + CrossMotion(parent.velocity, S1);
      const Rows inertia = by_force_ * moved.inertia, velocity = by_force_ * moved.velocity;
      by_acceleration.col(column) = inertia * S;
      rows.by_speed.col(column) = velocity * S + 2.0 * (inertia * S1);
      rows.by_q.col(column) = by_force_ * CrossForce(S, moved.force) + velocity * S1 + inertia * S2;
    }
    all.Add(moved);
    // δq̈ = J⁻¹ (what the sole's acceleration gains − what q and q̇ give it).
    const Rows by_twist = by_acceleration * posture.jacobian_inverse[s];
    const Vector3d sole = posture.X_WSole[s].translation() - dynamics.O();
    rows.by_sole.rightCols<3>() = by_twist.rightCols<3>() * R_BW;
    rows.by_sole.leftCols<3>() =
        by_twist.leftCols<3>() * R_BW - rows.by_sole.rightCols<3>() * CrossMatrix(sole);
    for (size_t j = 0; j < 6; ++j) {
      const Eigen::Index column = static_cast<Eigen::Index>(j);
      const RobotDynamics::Body& parent = j == 0 ? dynamics.waist() : leg[j - 1];
      const Vector6d& S = leg[j].screw;
      const Vector6d S1 = CrossMotion(parent.velocity, S);
      const Vector6d beyond = v_sole - parent.velocity;
      rows.by_q.col(column) -=
          rows.by_sole * (CrossMotion(S, a_sole - parent.acceleration) + CrossMotion(S1, beyond));
      rows.by_speed.col(column) -= rows.by_sole * (2.0 * S1 - CrossMotion(v_sole, S));
    }
  }
  by_push_ = by_force_ * all.inertia;
  by_drift_ = by_force_ * all.velocity;
}

Eigen::Vector2d ZmpSlopes::Along(const DynamicsTangent& tangent) const {
  const WaistSlope given_to_all(robot_, jet_, posture_, dynamics_, tangent.jet);
  // Everything is displaced with the waist; beyond that, all bodies gain a velocity and an
  // acceleration.
  const Vector6d& X = given_to_all.displacement;
  const RobotDynamics::Body& waist = dynamics_.waist();
  const Vector6d gained = given_to_all.velocity - CrossMotion(X, waist.velocity);
  const Vector6d pushed = given_to_all.acceleration - CrossMotion(X, waist.acceleration);
  Eigen::Vector2d slope = by_force_ * CrossForce(X, dynamics_.contact()) + by_drift_ * gained +
                          by_push_ * (pushed + CrossMotion(waist.velocity, gained));
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const size_t s = static_cast<size_t>(Index(side));
    const RobotDynamics::Body& sole = dynamics_.leg(side)[5];
    const Vector6d demanded = SoleAccelerationSlope(side, jet_, posture_, dynamics_, tangent.jet);
    const Vector6d given = CrossMotion(X, sole.acceleration) + pushed +
                           CrossMotion(gained, sole.velocity - waist.velocity);
    const LegRows& rows = legs_[s];
    slope += rows.by_q * tangent.q[s] + rows.by_speed * tangent.speeds[s] +
             rows.by_sole * (demanded - given);
  }
  return slope;
}

}  // namespace halfstep
