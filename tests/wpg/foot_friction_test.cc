// Bounds of friction, and sums over a robot's bodies, as algebra: whatever floor and links may do
// within given bounds, few things at a time.

#include "wpg/motion/foot_friction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/draws.h"
#include "tests/wpg/algebra_draw.h"
#include "tests/wpg/asking_robot.h"
#include "tests/wpg/hrp2.h"
#include "wpg/motion/foot_loads.h"
#include "wpg/motion/motion_bounds.h"
#include "wpg/motion/robot_drift.h"
#include "wpg/motion/torque_drift.h"
#include "wpg/motion/zmp_drift.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// About the ZMP at m: what there is after a while, of a moment and a force that have changed.
Given After(const Given& at_m, const Vector3d& moment, const Vector3d& force) {
  Given then{
      .zmp = {}, .pull = at_m.pull + force.head<2>(), .turn = 0, .push = at_m.push + force.z()};
  const Vector2d way = Vector2d(-moment.y(), moment.x()) / then.push;
  then.zmp = at_m.zmp + way;
  then.turn = at_m.turn + moment.z() - (way.x() * then.pull.y() - way.y() * then.pull.x());
  return then;
}

TEST(FootFriction, IsNotExceededWhateverRatesAllow) {
  AskingRobot asking;
  AlgebraDraw draw(11);
  AlgebraTally grown;
  int open = 0;
  for (int i = 0; i < Draws(6000); ++i) {
    const Given at_m{.zmp = draw.Sparse(0.02) * Vector2d(draw.Direction().head<2>()),
                     .pull = draw.Sparse(300) * Vector2d(draw.Direction().head<2>()),
                     .turn = draw.Sparse(30) * (draw.Uniform(0, 1) < 0.5 ? -1 : 1),
                     .push = 400};
    const RobotDynamics now = asking.That(at_m);
    const Pose2 sole{0, 0, draw.Uniform(-2, 2)};
    const SupportPolygon polygon =
        draw.Uniform(0, 1) < 0.5
            ? SupportPolygon(sole, {0.2, 0.12})
            : SupportPolygon(sole, sole * Pose2{0.1, 0.2, draw.Uniform(-1, 1)}, {0.2, 0.12});
    const auto friction = FootFriction::Of(now, polygon);
    ASSERT_TRUE(friction);
    const double h = 0.01;
    const ContactRate rate{.half_width = h, .moment = draw.Ball(1500), .force = draw.Ball(20000)};
    const double grows = friction->Drift(rate);
    if (!std::isfinite(grows)) continue;
    ++open;
    for (const double tau : {-h, -0.5 * h, 0.5 * h, h}) {
      const RobotDynamics then =
          asking.That(After(at_m, tau * draw.In(rate.moment), tau * draw.In(rate.force)));
      const auto needed = FootFriction::Of(then, polygon);
      ASSERT_TRUE(needed);
      grown.Compare(needed->needed() - friction->needed(), grows, 10.0);
    }
  }
  EXPECT_GT(open, Draws(6000) / 2);
  EXPECT_LT(grown.excess, 1.0);
  EXPECT_GT(grown.nearest, 0.99);
}

// The yaw moment grows while the points of the pressure go apart and the pull falls, so that most
// is needed at the midpoint. The edge from which the ZMP goes away is steep to the line through
// these points: they go apart three times as fast as the ZMP moves.
TEST(FootFriction, ByRatesIsNotBelowWhatTheMidpointNeeds) {
  AskingRobot asking;
  const Given at_m{.zmp = {0, 0}, .pull = {100, 0}, .turn = 3, .push = 400};
  // The ZMP is 3.2 cm from the left end of the soles' hull, and far from its lower one.
  const Pose2 one{-0.022, -0.086, 0}, other{one.x + 0.1, one.y + 0.3, 0};
  const SupportPolygon hull(one, other, {0.02, 0.1});
  const RobotDynamics dynamics = asking.That(at_m);
  const auto friction = FootFriction::Of(dynamics, hull);
  ASSERT_TRUE(friction);
  constexpr double h = 0.01;
  const ContactRate rate{
      .half_width = h, .moment = {{0, -400, 295}, 0}, .force = {{-2000, 0, 0}, 0}};
  EXPECT_GE(friction->Drift(rate), 0.0);
  for (const double tau : {-h, h}) {
    const RobotDynamics then =
        asking.That(After(at_m, tau * rate.moment.center, tau * rate.force.center));
    const auto needed = FootFriction::Of(then, hull);
    ASSERT_TRUE(needed);
    EXPECT_LT(needed->needed(), friction->needed() - 0.01);
  }
}

// The robot at rest, with a drift of one body that could do what is said of it.
struct AtRest {
  IntervalMotion motion;
  RobotDynamics dynamics;
  RobotDrift drift;

  AtRest(const RobotModel& robot, const WalkJet& still, double h)
      : motion(Bounded(robot, still, h)),
        dynamics(robot, still, motion.posture, kEarth),
        drift(robot, motion, {}, dynamics, kEarth) {}

  static IntervalMotion Bounded(const RobotModel& robot, const WalkJet& still, double h) {
    IntervalMotion motion;
    MotionBounds(robot).Bound(still, WalkState::Zero(), h, &motion);
    EXPECT_TRUE(motion.bounded);
    return motion;
  }
};

// HRP-2 at rest on both feet, where no mass has a drift.
struct Hrp2AtRest {
  static constexpr double h = 0.01;
  RobotModel robot = LoadRobot(kHrp2);
  AtRest rest{robot, Standing(robot), h};

  Hrp2AtRest() {
    rest.drift.waist_mass = {};
    for (auto& leg : rest.drift.link_masses) leg.fill({});
  }
};

TEST(FootFriction, IsNotExceededWhateverNormsAllow) {
  AskingRobot asking;
  AlgebraDraw draw(12);
  AlgebraTally grown;
  asking.That({.push = 400});  // with a mass
  AtRest rest(asking.robot(), asking.still(), 0.01);
  for (int i = 0; i < Draws(6000); ++i) {
    const Given at_m{.zmp = draw.Sparse(0.02) * Vector2d(draw.Direction().head<2>()),
                     .pull = draw.Sparse(300) * Vector2d(draw.Direction().head<2>()),
                     .turn = draw.Sparse(30) * (draw.Uniform(0, 1) < 0.5 ? -1 : 1),
                     .push = 400};
    const RobotDynamics now = asking.That(at_m);
    const SupportPolygon polygon(Pose2{0, 0, draw.Uniform(-2, 2)}, {0.2, 0.12});
    const auto friction = FootFriction::Of(now, polygon);
    ASSERT_TRUE(friction);
    // Force and yaw moment change by as much as one body's drift lets them.
    MassDrift& body = rest.drift.waist_mass;
    body = {.mass = 1.0};
    body.p2 = draw.Sparse(150);
    body.moment = draw.Sparse(10);
    body.com.head<2>() = at_m.zmp - now.O().head<2>();
    ZmpDrift zmp{.half_width = 0.01, .rate = draw.Ball(1500), .rest = draw.Sparse(5)};
    zmp.least_push = at_m.push - rest.drift.ForceDrift();
    const double grows = friction->Drift(rest.drift, zmp);
    if (!std::isfinite(grows)) continue;
    const Vector3d force = draw.In({{0, 0, 0}, rest.drift.ForceDrift()});
    const Vector3d moment = 0.01 * draw.In(zmp.rate) + draw.In({{0, 0, 0}, zmp.rest});
    Given then =
        After(at_m, moment, draw.Uniform(0, 1) < 0.3 ? -force.norm() * Vector3d::UnitZ() : force);
    // The yaw moment about where the ZMP was changes by what the bodies let it.
    const double sign = draw.Uniform(0, 1) < 0.5 ? -1 : 1;
    then.turn += sign * body.moment - moment.z();
    const RobotDynamics dynamics = asking.That(then);
    const auto needed = FootFriction::Of(dynamics, polygon);
    ASSERT_TRUE(needed);
    grown.Compare(needed->needed() - friction->needed(), grows, 10.0);
  }
  EXPECT_LT(grown.excess, 1.0);
  EXPECT_GT(grown.nearest, 0.95);
}

// A link that moves as far, and is pushed as much, as its drift lets it.
TEST(RobotDrift, HoldsWhatALinkCanAsk) {
  constexpr double h = Hrp2AtRest::h;
  Hrp2AtRest hrp2;
  AtRest& rest = hrp2.rest;
  const Vector3d pole(rest.dynamics.Zmp()->x(), rest.dynamics.Zmp()->y(), 0);
  AlgebraDraw draw(13);
  AlgebraTally horizontal, yaw, force;
  for (int i = 0; i < Draws(20000); ++i) {
    MassDrift& link =
        rest.drift.link_masses[static_cast<size_t>(i % 2)][static_cast<size_t>(i % 6)];
    link = {.mass = draw.Sparse(10)};
    link.com = draw.Uniform(0, 1) < 0.5 ? Vector3d(pole - rest.dynamics.O()) : draw.Sparse3(1);
    link.velocity = draw.Sparse3(3);
    link.acceleration = draw.Sparse3(30);
    link.p2 = draw.Sparse(60);
    link.moment = draw.Sparse(20);
    const double tau = draw.Uniform(0, 1) < 0.5 ? -h : h;
    const Vector3d a = draw.In({link.acceleration, link.p2});
    const Vector3d moved =
        tau * link.velocity + draw.In({{0, 0, 0}, 0.5 * h * h * link.MostAcceleration()});
    link.p = moved.norm();
    const auto moment = [&](const Vector3d& com, const Vector3d& acceleration) -> Vector3d {
      const Vector3d arm = rest.dynamics.O() + com - pole;
      return link.mass * arm.cross(acceleration + kEarth * Vector3d::UnitZ());
    };
    const Vector3d change = moment(link.com + moved, a) - moment(link.com, link.acceleration) +
                            draw.In({{0, 0, 0}, link.moment});
    const ZmpDrift zmp =
        ZmpDrift::Over(hrp2.robot, rest.motion, {}, rest.drift, rest.dynamics, kEarth);
    horizontal.Compare(change.head<2>().norm(), zmp.Most() * zmp.least_push, 100.0);
    yaw.Compare(std::abs(change.z()), rest.drift.YawMomentDrift(pole - rest.dynamics.O()), 100.0);
    force.Compare(link.mass * (a - link.acceleration).norm(), rest.drift.ForceDrift(), 100.0);
    EXPECT_NEAR(zmp.least_push, rest.dynamics.contact()[5] - link.mass * link.p2, 1e-9);
    link = {};
  }
  for (const AlgebraTally& part : {horizontal, yaw, force}) {
    EXPECT_LT(part.excess, 1.0);
    EXPECT_GT(part.nearest, 0.95);
  }
}

// Both feet stand, the waist moves and is pushed, the ZMP goes and the hip's axes turn, each as
// much as its drift lets it: few of that at a time.
TEST(TorqueDrift, HoldsWhateverSharesAndAxesDo) {
  constexpr double h = Hrp2AtRest::h;
  Hrp2AtRest hrp2;
  AtRest& rest = hrp2.rest;
  const RobotDynamics& dynamics = rest.dynamics;
  const Vector2d zmp = *dynamics.Zmp();
  AlgebraDraw draw(14);
  AlgebraTally torque;
  for (int i = 0; i < Draws(6000); ++i) {
    const Pose2 left{zmp.x() + draw.Uniform(-0.5, 0.5), zmp.y() + draw.Uniform(0.1, 0.5), 0},
        right{zmp.x() + draw.Uniform(-0.5, 0.5), zmp.y() - draw.Uniform(0.1, 0.5), 0};
    const auto loads = [&](const Vector2d& at) {
      return FootLoads::BothFeet(left, right, {0.1, 0.1}, at);
    };
    MassDrift& waist = rest.drift.waist_mass;
    waist = {.mass = draw.Sparse(50), .com = draw.Sparse3(1), .velocity = draw.Sparse3(3)};
    waist.p2 = draw.Sparse(60);
    waist.moment = draw.Sparse(20);
    const double tau = draw.Uniform(0, 1) < 0.5 ? -h : h, moved = draw.Sparse(0.1);
    const Vector3d push = draw.In({{0, 0, 0}, waist.p2});
    const Vector3d way =
        tau * waist.velocity + draw.In({{0, 0, 0}, 0.5 * h * h * waist.MostAcceleration()});
    waist.p = way.norm();
    // How the floor's wrench about O changes with it.
    const Vector3d weight = waist.mass * kEarth * Vector3d::UnitZ();
    const Vector3d force = waist.mass * push;
    const Vector3d moment =
        way.cross(weight + force) + waist.com.cross(force) + draw.In({{0, 0, 0}, waist.moment});
    const Vector6d contact = dynamics.contact() + Spatial(moment, force);
    const double turned = draw.Sparse(0.3);
    for (LegDrift& leg : rest.drift.legs) {
      for (RigidDrift& link : leg.links) link.turned = turned;
    }
    rest.drift.waist.turned = turned;
    const FootLoads here = loads(zmp),
                    there = loads(zmp + moved * Vector2d(draw.Direction().head<2>()));
    const TorqueDrift bound(rest.motion, rest.drift, dynamics, here, moved, kEarth);
    const Side side = draw.Uniform(0, 1) < 0.5 ? Side::kLeft : Side::kRight;
    const Vector6d of_side = bound.Of(side);
    Vector6d hung = Vector6d::Zero();
    for (size_t j = 6; j-- > 0;) {
      hung += dynamics.leg(side)[j].force;
      if (j > 2) continue;  // their axes pass through points that move when links turn
      const Vector3d axis = dynamics.leg(side)[j].screw.head<3>();
      const Vector3d point =
          rest.motion.posture.X_WB *
              rest.motion.posture.frames[static_cast<size_t>(Index(side))].point_B[j] -
          dynamics.O();
      const auto about_point = [&](const FootLoads& of, const Vector6d& wrench) -> Vector3d {
        const Vector6d left_over = hung - of.On(side, wrench);
        return left_over.head<3>() - point.cross(left_over.tail<3>());
      };
      const double before = axis.dot(about_point(here, dynamics.contact()));
      const double after = (draw.Turn(turned) * axis).dot(about_point(there, contact));
      torque.Compare(std::abs(after - before), of_side[static_cast<Eigen::Index>(j)], 1000.0);
    }
  }
  EXPECT_LT(torque.excess, 1.0);
  EXPECT_GT(torque.nearest, 0.95);
}

// A foot that has no load at m takes some while what presses changes, while the axis turns, while
// the push grows: products of two changes, of which each is alone here.
TEST(TorqueDrift, HoldsWhatAFootTakesThatHadNone) {
  constexpr double h = Hrp2AtRest::h;
  constexpr size_t kLeg = 1;
  Hrp2AtRest hrp2;
  AtRest& rest = hrp2.rest;
  const RobotDynamics& dynamics = rest.dynamics;
  const Vector2d zmp = *dynamics.Zmp();
  Vector6d hung = Vector6d::Zero();
  for (const RobotDynamics::Body& link : dynamics.leg(Side::kRight)) hung += link.force;
  const auto point = [&](size_t joint) -> Vector3d {
    return rest.motion.posture.X_WB * rest.motion.posture.frames[kLeg].point_B[joint] -
           dynamics.O();
  };
  // The torque of a joint of the hip, bound and truth, when the ZMP goes from the left sole's edge
  // through a share of the gap between soles, the waist goes `way` and is pushed by `push`.
  const auto compare = [&](size_t joint, double width, double gap, double share,
                           const Vector3d& way, const Vector3d& push, const Vector3d& turn) {
    const Vector2d size(0.1, width);
    const Pose2 left{zmp.x(), zmp.y() + 0.5 * width, 0}, right{zmp.x(), left.y - width - gap, 0};
    const double moved = share * gap;
    const FootLoads here = FootLoads::BothFeet(left, right, size, zmp),
                    there = FootLoads::BothFeet(left, right, size, zmp - Vector2d(0, moved));
    EXPECT_NEAR(here.share(Side::kRight), 0.0, 1e-9);
    EXPECT_NEAR(there.share(Side::kRight), share, 1e-9);
    rest.drift.waist_mass = {.mass = 50.0, .com = point(joint), .velocity = way / h};
    MassDrift& waist = rest.drift.waist_mass;
    waist.p = way.norm(), waist.p2 = push.norm();
    for (RigidDrift& link : rest.drift.legs[kLeg].links) link.turned = turn.norm();
    rest.drift.waist.turned = turn.norm();
    const double bound = TorqueDrift(rest.motion, rest.drift, dynamics, here, moved, kEarth)
                             .Of(Side::kRight)[static_cast<Eigen::Index>(joint)];
    const Vector3d force = waist.mass * push;
    const Vector6d contact =
        dynamics.contact() +
        Spatial(way.cross(waist.mass * kEarth * Vector3d::UnitZ() + force) + waist.com.cross(force),
                force);
    const auto about_axis = [&](const Vector3d& axis, const FootLoads& of, const Vector6d& wrench) {
      const Vector6d left_over = hung - of.On(Side::kRight, wrench);
      return axis.dot(left_over.head<3>() - point(joint).cross(left_over.tail<3>()));
    };
    const Vector3d axis = dynamics.leg(Side::kRight)[joint].screw.head<3>();
    const Vector3d turned =
        turn.norm() > 0 ? Vector3d(Eigen::AngleAxisd(turn.norm(), turn.normalized()) * axis) : axis;
    return std::pair(
        std::abs(about_axis(turned, there, contact) - about_axis(axis, here, dynamics.contact())),
        bound);
  };
  const auto nearest = [&](size_t joint, double width, double gap, double share,
                           const Vector3d& way, const Vector3d& push, const Vector3d& turn) {
    double nearest = 0.0;
    for (const double sign : {-1.0, 1.0}) {
      const auto [truth, bound] =
          compare(joint, width, gap, share, sign * way, sign * push, sign * turn);
      EXPECT_LE(truth, bound + 1e-9);
      nearest = std::max(nearest, truth / bound);
    }
    return nearest;
  };
  const Vector3d none(0, 0, 0);
  // Soles so narrow that their couple is nearly nothing.
  EXPECT_GT(nearest(1, 1e-4, 1e-4, 1.0, {0, 0.3, 0}, none, none), 0.95);
  EXPECT_GT(nearest(0, 1e-4, 1e-4, 1.0, none, none, {0, 0.1, 0}), 0.9);
  EXPECT_GT(nearest(1, 0.1, 0.1, 0.5, none, {0, 0, 1000}, none), 0.3);
}

}  // namespace
}  // namespace halfstep
