// Bounds of what a robot's links do, of what the floor gives and of torques, on motions in which
// few quantities move and few bodies have mass: a term that elsewhere hides behind others is here
// all that counts.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "tests/smoothing/certificate_draws.h"
#include "tests/smoothing/excess_tally.h"
#include "tests/smoothing/hand_made_motion.h"
#include "tests/smoothing/robot_truth.h"
#include "wpg/motion/contact_rate.h"
#include "wpg/motion/foot_friction.h"
#include "wpg/motion/foot_loads.h"
#include "wpg/motion/leg_drift.h"
#include "wpg/motion/leg_motion.h"
#include "wpg/motion/leg_torques.h"
#include "wpg/motion/torque_drift.h"
#include "wpg/motion/zmp_drift.h"

namespace halfstep {
namespace {

constexpr double kPull = HandMadeInterval::kGravity;

// Place, velocity and acceleration of the point of a body that is `from_O` at the instant.
struct PointOfBody {
  Eigen::Vector3d p, p1, p2;

  PointOfBody(const RobotDynamics& dynamics, const RobotDynamics::Body& body,
              const Eigen::Vector3d& at) {
    const Eigen::Vector3d turn = body.velocity.head<3>(), from_O = at - dynamics.O();
    p = at;
    p1 = body.velocity.tail<3>() + turn.cross(from_O);
    p2 = body.acceleration.tail<3>() - kPull * Eigen::Vector3d::UnitZ() +
         body.acceleration.head<3>().cross(from_O) + turn.cross(p1);
  }
};

void CompareLegs(const RobotModel& robot, const HandMadeMotion& motion,
                 const HandMadeInterval& made, double t, ExcessTally* tally) {
  const Posture posture = made.PostureAt(t);
  const RobotDynamics& now = *made.at_m;
  const RobotDynamics then(robot, motion.At(t), posture, kPull);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const size_t s = static_cast<size_t>(Index(side));
    const DynamicsRounding off = DynamicsRounding::At(robot, made.interval, now, kPull);
    const LegDrift drift =
        LegDrift::Over(side, made.interval, DriftOfWaist(robot, made.interval, motion.Thirds()),
                       DriftOfSole(made.interval, motion.Thirds(), side), now, off);
    const auto leg =
        LegMotion::Over(side, made.interval, MotionOfWaist(robot, made.interval, motion.Thirds()),
                        MotionOfSole(made.interval, motion.Thirds(), side), drift, now, off, kPull);
    const double joints = now.accelerations(side).norm() + then.accelerations(side).norm();
    for (size_t j = 0; j < 6; ++j) {
      const Eigen::Index i = static_cast<Eigen::Index>(j);
      const RobotDynamics::Body &before = now.leg(side)[j], &after = then.leg(side)[j];
      const Eigen::Isometry3d X =
          posture.X_WLink[s][j] * made.interval.posture.X_WLink[s][j].inverse();
      const PointOfBody here(now, before, drift.points[j]), there(then, after, X * drift.points[j]);
      const Eigen::Vector3d turned = (after.velocity - before.velocity).head<3>(),
                            turned1 = (after.acceleration - before.acceleration).head<3>();
      const double speed = after.velocity.norm() + before.velocity.norm();
      const RigidDrift& link = drift.links[j];
      tally->Compare("drift of place", (there.p - here.p).norm(), link.p, 1.0);
      tally->Compare("drift of acceleration", (there.p2 - here.p2).norm(), link.p2, joints);
      tally->Compare("drift of turn", turned.norm(), link.turn, speed);
      tally->Compare("drift of turn1", turned1.norm(), link.turn1, joints);
      tally->Compare("drift of the pose", Eigen::AngleAxisd(X.linear()).angle(), link.turned, 1e3);
      tally->Compare("drift of joint speed",
                     std::abs(posture.speeds[s][i] - made.interval.posture.speeds[s][i]),
                     drift.joints[j].speed_drift, speed);
      tally->Compare("drift of joint acceleration",
                     std::abs(then.accelerations(side)[i] - now.accelerations(side)[i]),
                     drift.joints[j].acceleration_drift, joints);
      if (!leg) continue;
      const RigidMotion& moves = leg->links[j];
      tally->Compare("place", there.p, moves.p, 1.0);
      tally->Compare("velocity", there.p1, moves.p1, speed);
      tally->Compare("acceleration", there.p2, moves.p2, joints);
      tally->Compare("rate of acceleration", there.p2 - here.p2, moves.p3, joints, t);
      tally->Compare("turn", after.velocity.head<3>(), moves.turn, speed);
      tally->Compare("turn1", after.acceleration.head<3>(), moves.turn1, joints);
      tally->Compare("rate of turn1", turned1, moves.turn2, joints, t);
    }
  }
}

// The floor under a motion: where the feet stand does not follow from it.
struct DrawnFloor {
  SupportPolygon polygon;
  std::array<FootLoads, 3> loads;  // left, right, both

  // About the ZMP: a sole, or two.
  static DrawnFloor Draw(const Eigen::Vector2d& zmp, double size, WalkDraw* draw) {
    const auto sole = [&](double along, double aside) {
      return Pose2{zmp.x() + size * draw->Uniform(-along, along),
                   zmp.y() + size * (aside + draw->Uniform(-0.05, 0.05)), draw->Uniform(-2, 2)};
    };
    const Eigen::Vector2d of_sole(0.25 * size, 0.15 * size);
    const Pose2 left = sole(0.1, 0.2), right = sole(0.1, -0.2);
    const bool one = draw->Uniform(0, 1) < 0.5;
    return {one ? SupportPolygon(sole(0.05, 0.0), of_sole) : SupportPolygon(left, right, of_sole),
            {FootLoads::OneFoot(Side::kLeft), FootLoads::OneFoot(Side::kRight),
             FootLoads::BothFeet(left, right, of_sole, zmp)},
            left,
            right,
            of_sole};
  }
  FootLoads Loads(size_t which, const Eigen::Vector2d& zmp) const {
    return which < 2 ? loads[which] : FootLoads::BothFeet(left, right, sole_size, zmp);
  }

  Pose2 left, right;
  Eigen::Vector2d sole_size;
};

void CompareContact(const RobotModel& robot, const HandMadeMotion& motion,
                    const HandMadeInterval& made, double t, double size, WalkDraw* draw,
                    ExcessTally* tally) {
  const RobotDynamics& now = *made.at_m;
  const auto zmp = now.Zmp();
  if (!zmp || !(now.contact()[5] > 1e-3)) return;
  const RobotDynamics then = made.At(t);
  const RobotDrift drift(robot, made.interval, motion.Thirds(), now, kPull);
  const ZmpDrift by_norms =
      ZmpDrift::Over(robot, made.interval, motion.Thirds(), drift, now, kPull);
  const auto rate = ContactRate::Over(robot, made.interval, motion.Thirds(), drift, now, kPull);
  const Eigen::Vector3d p(zmp->x(), zmp->y(), 0.0);
  const auto about_p = [&](const RobotDynamics& dynamics) -> Eigen::Vector3d {
    const Vector6d& wrench = dynamics.contact();
    return wrench.head<3>() - (p - dynamics.O()).cross(wrench.tail<3>());
  };
  const double wrench = now.contact().norm() + then.contact().norm() + robot.masses.waist.mass;
  if (rate) {
    tally->Compare("rate of the moment", about_p(then) - about_p(now), rate->moment, wrench, t);
    tally->Compare("rate of the force", (then.contact() - now.contact()).tail<3>(), rate->force,
                   wrench, t);
  }
  const double angle = draw->Uniform(0, 6.3);
  const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
  const DrawnFloor floor = DrawnFloor::Draw(*zmp, size, draw);
  const auto friction = FootFriction::Of(now, floor.polygon);
  const auto by_way = [&](std::string_view zmp_part, std::string_view friction_part,
                          const ZmpDrift& of_zmp, double grows) {
    if (!(of_zmp.least_push > 0.0)) return;
    ASSERT_TRUE(then.Zmp());
    const double relative = wrench / then.contact()[5] + wrench / now.contact()[5];
    tally->Compare(zmp_part, std::abs(along.dot(*then.Zmp() - *zmp)), of_zmp.Along(along),
                   relative);
    tally->Compare(zmp_part, (*then.Zmp() - *zmp).norm(), of_zmp.Most(), relative);
    if (!friction || !std::isfinite(grows)) return;
    const auto needed = FootFriction::Of(then, floor.polygon);
    ASSERT_TRUE(needed);
    tally->Compare(friction_part, needed->needed() - friction->needed(), grows,
                   100.0 * relative / size + needed->needed() * relative);
  };
  by_way("ZMP by norms", "friction by norms", by_norms,
         friction ? friction->Drift(drift, by_norms) : 0.0);
  if (rate) {
    by_way("ZMP by rates", "friction by rates", ZmpDrift::At(*rate, now.contact()[5]),
           friction ? friction->Drift(*rate) : 0.0);
  }
  if (!then.Zmp()) return;
  for (size_t which = 0; which < 3; ++which) {
    const FootLoads here = floor.Loads(which, *zmp), there = floor.Loads(which, *then.Zmp());
    const TorqueDrift of(made.interval, drift, now, here, which < 2 ? 0.0 : by_norms.Most(), kPull);
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const Vector6d bound = of.Of(side);
      const Vector6d moved = LegTorques(then, side, there.On(side, then.contact())) -
                             LegTorques(now, side, here.On(side, now.contact()));
      for (Eigen::Index j = 0; j < 6; ++j) {
        tally->Compare(which < 2 ? "torque, one foot" : "torque, both feet", std::abs(moved[j]),
                       bound[j], 10 * wrench);
      }
    }
  }
}

TEST(SparseMotions, KeepEveryBound) {
  unsigned seed = 820;
  for (WholeRobot& whole : WholeRobots()) {
    RobotModel& robot = whole.model;
    const double size = std::min(1.0, LegScale(robot));
    WalkDraw draw(seed++);
    ExcessTally tally;
    for (int i = 0; i < Draws(1000); ++i) {
      DrawSparseMasses(&robot, &draw);
      const HandMadeMotion motion = DrawSparseMotion(robot, size, &draw);
      const double h = 5e-5 * std::pow(300, draw.Uniform(0, 1));
      const HandMadeInterval made(robot, motion, h);
      if (!made.bounded()) continue;
      for (const double t : {-h, h}) {
        CompareLegs(robot, motion, made, t, &tally);
        CompareContact(robot, motion, made, t, size, &draw, &tally);
      }
    }
    EXPECT_EQ(tally.parts.size(), 22u);
    for (const auto& [what, part] : tally.parts) {
      EXPECT_GT(part.compared, Draws(1000) / 4) << robot.name << ": " << what;
      EXPECT_LT(part.excess, 1.0) << robot.name << ": " << what;
      if (kFewDraws) continue;  // few draws come near to nothing
      // A rate that changes evenly within its ball changes what it is of by half of the radius.
      EXPECT_GT(part.nearest, what.starts_with("rate") ? 0.15 : 0.9) << robot.name << ": " << what;
    }
  }
}

}  // namespace
}  // namespace halfstep
