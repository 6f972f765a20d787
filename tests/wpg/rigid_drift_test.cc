// Bounds of rigid bodies' motions, as algebra: what is claimed of all states within given bounds,
// at random states in which few parts differ, so that every term is once the only one.

#include "wpg/motion/rigid_drift.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "tests/draws.h"
#include "tests/wpg/algebra_draw.h"
#include "wpg/motion/contact_rate.h"
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
