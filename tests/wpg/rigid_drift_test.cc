// Bounds of rigid bodies' motions, as algebra: what is claimed of all states within given bounds,
// at random states in which few parts differ, so that every term is once the only one.

#include "wpg/motion/rigid_drift.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "tests/draws.h"
#include "tests/wpg/algebra_draw.h"
#include "wpg/motion/contact_rate.h"
#include "wpg/motion/knee_match.h"
#include "wpg/motion/mass_drift.h"
#include "wpg/motion/rigid_motion.h"
#include "wpg/motion/spatial.h"
#include "wpg/motion/zmp_drift.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// A body's state: how it turns, and how its point moves.
struct State {
  Vector3d turn{0, 0, 0}, turn1{0, 0, 0}, turn2{0, 0, 0}, p{0, 0, 0}, p1{0, 0, 0}, p2{0, 0, 0},
      p3{0, 0, 0};

  // Of another point, which is `d` from this one.
  State At(const Vector3d& d) const {
    State other = *this;
    const Vector3d d1 = turn.cross(d), d2 = turn1.cross(d) + turn.cross(d1);
    other.p += d;
    other.p1 += d1;
    other.p2 += d2;
    other.p3 += turn2.cross(d) + 2 * turn1.cross(d1) + turn.cross(d2);
    return other;
  }
  // Of a body that turns about the axis `a` of this one.
  State Turned(const Vector3d& a, double q1, double q2, double q3) const {
    State body = *this;
    const Vector3d a1 = turn.cross(a), a2 = turn1.cross(a) + turn.cross(a1);
    body.turn += q1 * a;
    body.turn1 += q2 * a + q1 * a1;
    body.turn2 += q3 * a + 2 * q2 * a1 + q1 * a2;
    return body;
  }
};

// A body with balls for all that it does, and one of the states within them; h = 0.01.
struct Within {
  RigidMotion motion;
  Eigen::Matrix3d turned;
  State state;

  explicit Within(AlgebraDraw* draw) {
    motion.turn = draw->Ball(5);
    motion.turn1 = draw->Ball(30);
    motion.turn2 = draw->Ball(300);
    motion.p = draw->Ball(1);
    motion.p1 = draw->Ball(2);
    motion.p2 = draw->Ball(20);
    motion.p3 = draw->Ball(200);
    motion.turned = draw->Sparse(3);
    turned = draw->Turn(motion.turned);
    state = {draw->In(motion.turn), draw->In(motion.turn1), draw->In(motion.turn2),
             draw->In(motion.p),    draw->In(motion.p1),    draw->In(motion.p2),
             draw->In(motion.p3)};
  }
};

void CompareAll(const State& truth, const RigidMotion& motion, std::array<AlgebraTally, 7>* parts) {
  (*parts)[0].Compare(truth.turn, motion.turn);
  (*parts)[1].Compare(truth.turn1, motion.turn1);
  (*parts)[2].Compare(truth.turn2, motion.turn2);
  (*parts)[3].Compare(truth.p, motion.p);
  (*parts)[4].Compare(truth.p1, motion.p1);
  (*parts)[5].Compare(truth.p2, motion.p2);
  (*parts)[6].Compare(truth.p3, motion.p3);
}

TEST(RigidMotion, OfAnotherPointHoldsAllThatItCanDo) {
  AlgebraDraw draw(1);
  std::array<AlgebraTally, 7> parts;
  for (int i = 0; i < Draws(20000); ++i) {
    const Within body(&draw);
    const Vector3d d = draw.Sparse3(1);
    CompareAll(body.state.At(body.turned * d), body.motion.At(d), &parts);
  }
  for (size_t part = 0; part < 7; ++part) {
    EXPECT_LT(parts[part].excess, 1.0) << part;
    EXPECT_GT(parts[part].nearest, 0.9) << part;
  }
}

TEST(RigidMotion, OfATurnedBodyHoldsAllThatItCanDo) {
  AlgebraDraw draw(2);
  std::array<AlgebraTally, 7> parts;
  const auto range = [&](double most) { return Range{draw.Sparse(most), draw.Sparse(most)}; };
  const auto in = [&](const Range& x) {
    return x.center + (draw.Uniform(0, 1) < 0.5 ? -1 : 1) * x.radius;
  };
  for (int i = 0; i < Draws(20000); ++i) {
    const Within base(&draw);
    const Vector3d axis = draw.Direction();
    const JointRates joint{range(5), range(30), range(300)};
    const RigidMotion body = Turned(base.motion, axis, joint, 0.01);
    EXPECT_EQ(body.turned, 0.01 * body.turn.most());
    CompareAll(base.state.Turned(base.turned * axis, in(joint.speed), in(joint.acceleration),
                                 in(joint.third)),
               body, &parts);
  }
  for (size_t part = 0; part < 3; ++part) {
    EXPECT_LT(parts[part].excess, 1.0) << part;
    EXPECT_GT(parts[part].nearest, 0.9) << part;
  }
}

// A body at m, and one of the states that its drift allows.
struct Drifted {
  RigidDrift drift;
  Eigen::Matrix3d turned;
  State at_m, there;

  explicit Drifted(AlgebraDraw* draw) {
    at_m.turn = draw->Sparse3(5);
    at_m.turn1 = draw->Sparse3(30);
    at_m.p2 = draw->Sparse3(20);
    drift = {.speed = at_m.turn.norm(), .acceleration = at_m.turn1.norm()};
    drift.turned = draw->Sparse(1);
    drift.turn = draw->Sparse(3);
    drift.turn1 = draw->Sparse(20);
    drift.p = draw->Sparse(0.3);
    drift.p2 = draw->Sparse(10);
    turned = draw->Turn(drift.turned);
    there = {.turn = draw->In({at_m.turn, drift.turn}),
             .turn1 = draw->In({at_m.turn1, drift.turn1})};
    there.p = draw->In({at_m.p, drift.p});
    there.p2 = draw->In({at_m.p2, drift.p2});
  }
};

TEST(RigidDrift, OfAnotherPointIsNotExceeded) {
  AlgebraDraw draw(3);
  std::array<AlgebraTally, 2> parts;
  for (int i = 0; i < Draws(20000); ++i) {
    const Drifted body(&draw);
    const Vector3d d = draw.Sparse3(1);
    const RigidDrift drift = body.drift.At(d.norm());
    const State now = body.at_m.At(d), then = body.there.At(body.turned * d);
    parts[0].Compare((then.p - now.p).norm(), drift.p, 1.0);
    parts[1].Compare((then.p2 - now.p2).norm(), drift.p2, then.p2.norm());
  }
  for (const AlgebraTally& part : parts) {
    EXPECT_LT(part.excess, 1.0);
    EXPECT_GT(part.nearest, 0.9);
  }
}

TEST(RigidDrift, OfATurnedBodyIsNotExceeded) {
  AlgebraDraw draw(4);
  std::array<AlgebraTally, 2> parts;
  for (int i = 0; i < Draws(20000); ++i) {
    const Drifted base(&draw);
    const Vector3d axis = draw.Direction();
    const double q1 = draw.Sparse(5), q2 = draw.Sparse(30), off1 = draw.Sparse(2),
                 off2 = draw.Sparse(20);
    const State now = base.at_m.Turned(axis, q1, q2, 0);
    const State then = base.there.Turned(base.turned * axis, q1 + off1, q2 - off2, 0);
    const JointDrift joint{
        .speed = q1, .acceleration = q2, .speed_drift = off1, .acceleration_drift = off2};
    const RigidDrift drift = Turned(base.drift, joint, now.turn.norm(), now.turn1.norm(), 0.01);
    EXPECT_EQ(drift.turned, 0.01 * drift.fastest());
    parts[0].Compare((then.turn - now.turn).norm(), drift.turn, then.turn.norm());
    parts[1].Compare((then.turn1 - now.turn1).norm(), drift.turn1, then.turn1.norm());
  }
  for (const AlgebraTally& part : parts) {
    EXPECT_LT(part.excess, 1.0);
    EXPECT_GT(part.nearest, 0.9);
  }
}

// Of an inertia that turns with its body.
Vector3d InertialMoment(const Eigen::Matrix3d& I, const State& state) {
  return I * state.turn1 + state.turn.cross(I * state.turn);
}

TEST(MassDrift, OfTheInertiasMomentIsNotExceeded) {
  AlgebraDraw draw(5);
  AlgebraTally moment;
  for (int i = 0; i < Draws(20000); ++i) {
    const Drifted of(&draw);
    RobotDynamics::Body body;
    body.inertia.mass = 2.0;
    body.inertia.com = draw.Sparse3(1);
    body.inertia.about_com = draw.Inertia();
    body.velocity = Spatial(of.at_m.turn, draw.Sparse3(2));
    body.acceleration = Spatial(of.at_m.turn1, draw.Sparse3(20));
    const MassDrift drift = MassDrift::Of(body, of.drift, 9.81);
    const Eigen::Matrix3d &I = body.inertia.about_com,
                          there = of.turned * I * of.turned.transpose();
    const Vector3d then = InertialMoment(there, of.there);
    moment.Compare((then - InertialMoment(I, of.at_m)).norm(), drift.moment, then.norm());
    // Of its centre of mass, as the wrench has it.
    const Vector6d wrench =
        body.inertia * body.acceleration + CrossForce(body.velocity, body.inertia * body.velocity);
    EXPECT_LT((wrench.tail<3>() / 2.0 - (drift.acceleration + 9.81 * Vector3d::UnitZ())).norm(),
              1e-10);
  }
  EXPECT_LT(moment.excess, 1.0);
  EXPECT_GT(moment.nearest, 0.5);
}

// No inertia is like this, but the bound is one for every symmetric matrix: here ω and I ω both
// grow, each as much as it can, and what they do to ω × I ω adds up.
TEST(MassDrift, HoldsForAMatrixThatIsNoInertia) {
  RobotDynamics::Body body;
  body.inertia.mass = 1.0;
  body.inertia.about_com = Vector3d(1, -1, 0).asDiagonal();
  State now, then;
  now.turn = Vector3d(1, 1, 0).normalized(), then.turn = 1.1 * now.turn;
  body.velocity = Spatial(now.turn, {0, 0, 0});
  const MassDrift drift = MassDrift::Of(body, {.speed = 1.0, .turn = 0.1}, 9.81);
  const Eigen::Matrix3d& I = body.inertia.about_com;
  const double truth = (InertialMoment(I, then) - InertialMoment(I, now)).norm();
  EXPECT_GT(truth, 1.3 * 0.1 * 1.1 * I.norm());  // what one of the two alone could do
  EXPECT_LE(truth, drift.moment);
}

// The rate of m (r − p) × (a + g ẑ) + I ω̇ + ω × I ω.
TEST(ContactRate, OfABodyHoldsAllThatItCanAsk) {
  AlgebraDraw draw(6);
  AlgebraTally moment, force;
  for (int i = 0; i < Draws(40000); ++i) {
    const Within body(&draw);
    SpatialInertia inertia;
    inertia.mass = draw.Sparse(10);
    inertia.about_com = draw.Inertia();
    const Vector3d pole = draw.Sparse3(0.3);
    ContactRate rate;
    rate.Add(inertia, body.motion, pole, 9.81);
    const State& s = body.state;
    const Eigen::Matrix3d I = body.turned * inertia.about_com * body.turned.transpose();
    const auto turns = [&](const Vector3d& x) -> Vector3d {  // İ x
      return s.turn.cross(I * x) - I * s.turn.cross(x);
    };
    const Vector3d of_mass = s.p1.cross(s.p2 + 9.81 * Vector3d::UnitZ()) + (s.p - pole).cross(s.p3);
    const Vector3d of_inertia = turns(s.turn1) + I * s.turn2 + s.turn1.cross(I * s.turn) +
                                s.turn.cross(turns(s.turn) + I * s.turn1);
    moment.Compare(inertia.mass * of_mass + of_inertia, rate.moment);
    force.Compare(inertia.mass * s.p3, rate.force);
  }
  EXPECT_LT(moment.excess, 1.0);
  EXPECT_LT(force.excess, 1.0);
  EXPECT_GT(moment.nearest, 0.9);
  EXPECT_GT(force.nearest, 0.9);
}

// Six joints' axes in W, each with its arm to the knee's point, both turned with the links.
struct KneeAxes {
  std::array<Vector3d, 6> axes, points;

  Matrix6d Jacobian(const std::array<Eigen::Matrix3d, 6>& turned) const {
    constexpr std::array<size_t, 6> kFixedIn = {0, 1, 2, 2, 4, 5};
    const auto carried = [&](size_t link, size_t to, size_t from) -> Vector3d {
      return turned[link] * (points[to] - points[from]);
    };
    std::array<Vector3d, 6> arms;
    arms[2] = carried(2, 3, 2);
    arms[1] = arms[2] + carried(1, 2, 1);
    arms[0] = arms[1] + carried(0, 1, 0);
    arms[3].setZero();
    arms[4] = carried(3, 3, 4);
    arms[5] = arms[4] + carried(4, 4, 5);
    Matrix6d J;
    for (size_t j = 0; j < 6; ++j) {
      const Vector3d axis = turned[kFixedIn[j]] * axes[j];
      J.col(static_cast<Eigen::Index>(j)) << axis, axis.cross(arms[j]);
    }
    return J;
  }
};

// Any points and any matrix, so that each distance and each half of its rows is once all that
// counts.
TEST(KneeMatch, HoldsHowMuchTheJacobianChanges) {
  AlgebraDraw draw(7);
  AlgebraTally change;
  for (int i = 0; i < Draws(10000); ++i) {
    IntervalMotion motion;
    Posture& posture = motion.posture;
    posture.X_WB.linear() = draw.Turn(1.0);
    posture.X_WB.translation() = draw.Sparse3(1);
    posture.X_WSole[0].setIdentity();
    posture.X_WSole[0].translation() = draw.Sparse3(1);
    for (Vector3d& point : posture.frames[0].point_B) point = draw.Sparse3(1);
    Matrix6d& inverse = posture.jacobian_inverse[0];
    for (Eigen::Index row = 0; row < 6; ++row) {
      const double turn = draw.Uniform(0, 1) < 0.5 ? 1.0 : 0.0;
      inverse.row(row) << turn * draw.Direction().transpose(), draw.Direction().transpose();
    }
    const KneeMatch knee(motion, Side::kLeft);
    // A twist about the knee's point, about the sole's and in B.
    const Vector3d turn = draw.Sparse3(1), velocity = draw.Sparse3(1);
    const Eigen::Matrix3d& R = posture.X_WB.linear();
    const Vector3d of_sole =
        velocity + turn.cross(posture.X_WSole[0].translation() - knee.points()[3]);
    const Vector6d joints = inverse * Spatial(R.transpose() * turn, R.transpose() * of_sole);
    EXPECT_LT((knee.Joints(turn, velocity) - joints).norm(), 1e-12);
    // Links turn, few of them.
    KneeAxes leg{.axes = {}, .points = knee.points()};
    for (Vector3d& axis : leg.axes) axis = draw.Direction();
    std::array<double, 6> angles;
    std::array<Eigen::Matrix3d, 6> turned, still;
    still.fill(Eigen::Matrix3d::Identity());
    for (size_t link = 0; link < 6; ++link) {
      angles[link] = draw.Sparse(0.1);
      turned[link] = draw.Turn(angles[link]);
    }
    const Matrix6d bound = knee.Change(angles), J = leg.Jacobian(turned) - leg.Jacobian(still);
    for (Eigen::Index j = 0; j < 6; ++j) {
      const Vector6d asked = knee.Joints(J.col(j).head<3>(), J.col(j).tail<3>());
      for (Eigen::Index k = 0; k < 6; ++k) change.Compare(std::abs(asked[k]), bound(k, j), 1.0);
    }
  }
  EXPECT_LT(change.excess, 1.0);
  EXPECT_GT(change.nearest, 0.9);
}

// What solves J(t)·x = r, with r in balls and asked for along each row of J(m)⁻¹, where it counts
// most.
TEST(KneeMatch, HoldsAllSolutionsWhileLinksTurn) {
  AlgebraDraw draw(8);
  AlgebraTally solved, lowered;
  int none = 0;
  for (int i = 0; i < Draws(20000); ++i) {
    IntervalMotion motion;
    Posture& posture = motion.posture;
    posture.X_WB.linear() = draw.Turn(1.0);
    posture.X_WSole[0].setIdentity();
    posture.X_WSole[0].translation() = draw.Sparse3(1);
    for (Vector3d& point : posture.frames[0].point_B) point = draw.Uniform(0, 1) * draw.Direction();
    KneeAxes leg;
    for (size_t j = 0; j < 6; ++j) {
      leg.axes[j] = draw.Direction();
      leg.points[j] = posture.X_WB * posture.frames[0].point_B[j];
    }
    std::array<Eigen::Matrix3d, 6> turned, still;
    still.fill(Eigen::Matrix3d::Identity());
    const Matrix6d J = leg.Jacobian(still), Y = J.inverse();
    if (!(Y.norm() < 100)) continue;
    // Twists of the sole in B, from those of the knee's point.
    const Eigen::Matrix3d& R = posture.X_WB.linear();
    Matrix6d of_sole = Matrix6d::Zero();
    of_sole.topLeftCorner<3, 3>() = of_sole.bottomRightCorner<3, 3>() = R.transpose();
    of_sole.bottomLeftCorner<3, 3>() =
        -R.transpose() * CrossMatrix(posture.X_WSole[0].translation() - leg.points[3]);
    posture.jacobian_inverse[0] = Y * of_sole.inverse();
    const KneeMatch knee(motion, Side::kLeft);
    std::array<double, 6> angles;
    const double far = draw.Uniform(0, 1) < 0.1 ? 1.0 : 0.1;
    for (size_t link = 0; link < 6; ++link) {
      angles[link] = draw.Sparse(far);
      turned[link] = draw.Turn(angles[link]);
    }
    const Matrix6d there = leg.Jacobian(turned).inverse();
    const Eigen::Index row = static_cast<Eigen::Index>(draw.Uniform(0, 6));
    Vector6d along;
    along << Vector3d(Y.row(row).head<3>()).normalized(),
        Vector3d(Y.row(row).tail<3>()).normalized();
    VectorBall turn = draw.Ball(3), velocity = draw.Ball(3);
    const double sign = draw.Uniform(0, 1) < 0.5 ? -1 : 1;
    const Vector6d off =
        sign * Spatial(turn.radius * along.head<3>(), velocity.radius * along.tail<3>());
    const auto all = knee.Solve(turn, velocity, angles);
    none += !all;
    if (all) {
      const Vector6d x = there * (Spatial(turn.center, velocity.center) + off);
      for (Eigen::Index k = 0; k < 6; ++k) {
        solved.Compare(std::abs(x[k] - all->center[k]), all->radius[k], x.norm());
      }
    }
    const Vector6d x = (there * off).cwiseAbs();
    const Vector6d less =
        knee.Lowered(draw.Uniform(1, 3) * x, turn.radius, velocity.radius, angles);
    for (Eigen::Index k = 0; k < 6; ++k) lowered.Compare(x[k], less[k], x.norm());
  }
  EXPECT_GT(none, Draws(20000) / 100);
  EXPECT_LT(solved.excess, 1.0);
  EXPECT_LT(lowered.excess, 1.0);
  EXPECT_GT(solved.nearest, 0.85);  // an eighth is added to what is found
  EXPECT_GT(lowered.nearest, 0.99);
}

// Each part of the floor's moment, and its push, at the edge of what rates let them be.
TEST(ZmpDrift, ByRatesIsNotExceeded) {
  AlgebraDraw draw(9);
  AlgebraTally along, most;
  for (int i = 0; i < Draws(20000); ++i) {
    const ContactRate rate{
        .half_width = 0.01, .moment = draw.Ball(3000), .force = draw.Ball(40000)};
    const double push = 300;
    const ZmpDrift drift = ZmpDrift::At(rate, push);
    if (!(drift.least_push > 0)) {
      EXPECT_TRUE(std::isinf(drift.Most()));
      continue;
    }
    const double tau = draw.Uniform(0, 1) < 0.5 ? -0.01 : 0.01;
    const Vector3d moment = tau * draw.In(rate.moment);
    const double up =
        tau * (rate.force.center.z() + (draw.Uniform(0, 1) < 0.5 ? -1 : 1) * rate.force.radius);
    const Eigen::Vector2d way = Eigen::Vector2d(-moment.y(), moment.x()) / (push + up);
    const double angle = draw.Uniform(0, 6.3);
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    along.Compare(std::abs(direction.dot(way)), drift.Along(direction), way.norm());
    most.Compare(way.norm(), drift.Most(), way.norm());
  }
  for (const AlgebraTally& part : {along, most}) {
    EXPECT_LT(part.excess, 1.0);
    EXPECT_GT(part.nearest, 0.95);
  }
}

}  // namespace
}  // namespace halfstep
