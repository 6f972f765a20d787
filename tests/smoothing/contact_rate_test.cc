// Bounds by rates of what a robot's links do over an interval, and of what the floor gives: never
// exceeded on random intervals, and near what is true on short ones.

#include "wpg/motion/contact_rate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "smoothing/proof/certified_feasibility.h"
#include "smoothing/proof/interval_statements.h"
#include "tests/smoothing/certificate_draws.h"
#include "tests/smoothing/robot_truth.h"
#include "wpg/motion/foot_friction.h"
#include "wpg/motion/leg_motion.h"
#include "wpg/motion/zmp_drift.h"

namespace halfstep {
namespace {

constexpr double kGravity = 9.81;
constexpr double kNone = std::numeric_limits<double>::infinity();

// A random interval of a random walk of a robot, and the robot's dynamics at its midpoint.
struct DrawnInterval {
  SuperposedWalk walk;
  double begin, length;
  IntervalMotion motion;
  RobotDynamics at_m;
  WalkThirds thirds;

  double middle() const { return begin + 0.5 * length; }

  // The dynamics at `part` of the interval.
  RobotDynamics At(const RobotModel& robot, double part) const {
    const WalkJet jet = walk.At(begin + part * length);
    Posture posture = SolvePosture(robot, jet.value);
    EXPECT_TRUE(posture.reachable && SolveJointSpeeds(robot, jet, &posture));
    return {robot, jet, posture, kGravity};
  }
};

// Calls visit(interval) with `walks`·4 intervals between knots, of at least `shortest` and 0.03 s,
// where the motion is bounded.
void ForEachInterval(const RobotModel& robot, unsigned seed, int walks, double shortest,
                     const std::function<void(const DrawnInterval&, WalkDraw*)>& visit) {
  const MotionBounds bounds(robot);
  WalkDraw draw(seed);
  for (int i = 0; i < walks; ++i) {
    const HalfStepSequence sequence = DrawSequence(robot, 2, {}, &draw);
    const SuperposedWalk walk(sequence, draw.ExtremeParameters(sequence));
    for (int k = 0; k < 4; ++k) {
      const double length = shortest * std::pow(0.03 / shortest, draw.Uniform(0, 1));
      const double begin = draw.Uniform(0.0, walk.duration() - length);
      if (!KnotsInside(walk, {begin, begin + length}).empty()) continue;
      IntervalMotion motion;
      BoundMotion(bounds, walk, begin, begin + length, &motion);
      if (!motion.bounded) continue;
      visit(
          {walk, begin, length, motion, RobotDynamics(robot, motion.jet, motion.posture, kGravity),
           walk.ThirdRanges(begin, begin + length)},
          &draw);
    }
  }
}

std::optional<LegMotion> LegOver(const RobotModel& robot, const DrawnInterval& drawn, Side side,
                                 const WalkThirds& thirds) {
  const DynamicsRounding off = DynamicsRounding::At(robot, drawn.motion, drawn.at_m, kGravity);
  const LegDrift drift =
      LegDrift::Over(side, drawn.motion, DriftOfWaist(robot, drawn.motion, drawn.thirds),
                     DriftOfSole(drawn.motion, drawn.thirds, side), drawn.at_m, off);
  return LegMotion::Over(side, drawn.motion, MotionOfWaist(robot, drawn.motion, thirds),
                         MotionOfSole(drawn.motion, thirds, side), drift, drawn.at_m, off,
                         kGravity);
}

// Place, velocity and acceleration of the point of a body that is `from_O` at the instant.
struct PointMotion {
  Eigen::Vector3d p, p1, p2;

  static PointMotion Of(const RobotDynamics& dynamics, const RobotDynamics::Body& body,
                        const Eigen::Vector3d& from_O) {
    const Eigen::Vector3d turn = body.velocity.head<3>();
    PointMotion point{dynamics.O() + from_O, body.velocity.tail<3>() + turn.cross(from_O), {}};
    point.p2 = body.acceleration.tail<3>() - kGravity * Eigen::Vector3d::UnitZ() +
               body.acceleration.head<3>().cross(from_O) + turn.cross(point.p1);
    return point;
  }
};

// How far truths are outside of their balls, and the nearest to the edge of one.
struct Outside {
  double excess = -kNone, nearest = 0.0;

  // `time`: the ball is one of rates, and the truth the change in so long a time.
  void Compare(const Eigen::Vector3d& truth, const VectorBall& ball, double time = 1.0) {
    const double off = (truth - time * ball.center).norm(), radius = std::abs(time) * ball.radius;
    excess = std::max(excess, off - radius);
    if (off > 1e-6) nearest = std::max(nearest, off / radius);
  }
};

enum { kPlace, kVelocity, kAcceleration, kThird, kTurn, kTurn1, kTurn2, kParts };

// What the links of both legs do at the ends of an interval against their bounds.
void CompareLinks(const RobotModel& robot, const DrawnInterval& drawn, const WalkThirds& thirds,
                  std::array<Outside, kParts>* parts) {
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const auto leg = LegOver(robot, drawn, side, thirds);
    if (!leg) continue;
    for (const double part : {0.0, 1.0}) {
      const double tau = (part - 0.5) * drawn.length;
      const WalkJet jet = drawn.walk.At(drawn.begin + part * drawn.length);
      Posture posture = SolvePosture(robot, jet.value);
      ASSERT_TRUE(posture.reachable && SolveJointSpeeds(robot, jet, &posture));
      const RobotDynamics there(robot, jet, posture, kGravity);
      for (size_t j = 0; j < 6; ++j) {
        const RobotDynamics::Body &now = drawn.at_m.leg(side)[j], &then = there.leg(side)[j];
        const RigidMotion& link = leg->links[j];
        const size_t s = static_cast<size_t>(Index(side));
        const Eigen::Vector3d moved =
            posture.X_WLink[s][j] * drawn.motion.posture.X_WLink[s][j].inverse() * link.p.center;
        const auto before = PointMotion::Of(drawn.at_m, now, link.p.center - drawn.at_m.O());
        const auto after = PointMotion::Of(there, then, moved - there.O());
        (*parts)[kPlace].Compare(after.p, link.p);
        (*parts)[kVelocity].Compare(after.p1, link.p1);
        (*parts)[kAcceleration].Compare(after.p2, link.p2);
        (*parts)[kThird].Compare(after.p2 - before.p2, link.p3, tau);
        (*parts)[kTurn].Compare(then.velocity.head<3>(), link.turn);
        (*parts)[kTurn1].Compare(then.acceleration.head<3>(), link.turn1);
        (*parts)[kTurn2].Compare((then.acceleration - now.acceleration).head<3>(), link.turn2, tau);
      }
    }
  }
}

TEST(LegMotion, HoldsWhatLinksDo) {
  unsigned seed = 770;
  for (const WholeRobot& whole : WholeRobots()) {
    std::array<Outside, kParts> parts, broken;
    ForEachInterval(whole.model, seed++, Draws(150), 1e-4,
                    [&](const DrawnInterval& drawn, WalkDraw*) {
                      CompareLinks(whole.model, drawn, drawn.thirds, &parts);
                      WalkThirds wrong = drawn.thirds;
                      wrong.center *= 0.9;
                      CompareLinks(whole.model, drawn, wrong, &broken);
                    });
    for (size_t part = 0; part < kParts; ++part) {
      EXPECT_LT(parts[part].excess, 1e-8) << whole.model.name << ": part " << part;
      EXPECT_GT(parts[part].nearest, 0.3) << whole.model.name << ": part " << part;
    }
    // Third derivatives that are a tenth too small show.
    EXPECT_GT(broken[kThird].excess, 1e-4) << whole.model.name;
  }
}

TEST(ContactRate, HoldsWhatTheFloorGives) {
  unsigned seed = 780;
  for (const WholeRobot& whole : WholeRobots()) {
    const RobotModel& robot = whole.model;
    Outside moment, force;
    int bounded = 0;
    std::vector<double> tightness;  // bound of the ZMP's way over what it goes, on short intervals
    double excess = -kNone, friction_excess = -kNone, friction_nearest = 0.0;
    ForEachInterval(
        robot, seed++, Draws(200), 1e-4, [&](const DrawnInterval& drawn, WalkDraw* draw) {
          const auto zmp = drawn.at_m.Zmp();
          if (!zmp) return;
          const RobotDrift drift(robot, drawn.motion, drawn.thirds, drawn.at_m, kGravity);
          const auto rate =
              ContactRate::Over(robot, drawn.motion, drawn.thirds, drift, drawn.at_m, kGravity);
          if (!rate) return;
          ++bounded;
          const ZmpDrift of_zmp = ZmpDrift::At(*rate, drawn.at_m.contact()[5]);
          const SupportPolygon polygon = SupportAt(drawn.walk, drawn.walk.Locate(drawn.middle()),
                                                   drawn.motion.jet.value, robot.sole_size);
          const auto friction = FootFriction::Of(drawn.at_m, polygon);
          const double grows = friction ? friction->Drift(*rate) : kNone;
          const double angle = draw->Uniform(0, 6.3);
          const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
          const Eigen::Vector3d p(zmp->x(), zmp->y(), 0.0);
          const auto about_p = [&](const RobotDynamics& dynamics) -> Eigen::Vector3d {
            const Vector6d& wrench = dynamics.contact();
            return wrench.head<3>() - (p - dynamics.O()).cross(wrench.tail<3>());
          };
          double most = 0.0;
          for (const double part : {0.0, draw->Uniform(0, 1), 1.0}) {
            const RobotDynamics there = drawn.At(robot, part);
            const double tau = (part - 0.5) * drawn.length;
            moment.Compare(about_p(there) - about_p(drawn.at_m), rate->moment, tau);
            force.Compare((there.contact() - drawn.at_m.contact()).tail<3>(), rate->force, tau);
            if (!std::isfinite(of_zmp.Most())) continue;
            ASSERT_TRUE(there.Zmp()) << robot.name;
            most = std::max(most, std::abs(direction.dot(*there.Zmp() - *zmp)));
            if (!std::isfinite(grows)) continue;
            const auto needed = FootFriction::Of(there, polygon);
            ASSERT_TRUE(needed) << robot.name;
            const double grown = needed->needed() - friction->needed();
            friction_excess = std::max(friction_excess, grown - grows);
            if (grown > 1e-5) friction_nearest = std::max(friction_nearest, grown / grows);
          }
          excess = std::max(excess, most - of_zmp.Along(direction));
          if (drawn.length < 1e-3 && most > 1e-6) {
            tightness.push_back(of_zmp.Along(direction) / most);
          }
        });
    EXPECT_GT(bounded, Draws(200)) << robot.name;
    EXPECT_LT(moment.excess, 1e-7) << robot.name;
    EXPECT_LT(force.excess, 1e-7) << robot.name;
    EXPECT_LT(excess, 1e-9) << robot.name;
    EXPECT_LT(friction_excess, 1e-9) << robot.name;
    EXPECT_GT(moment.nearest, 0.2) << robot.name;
    EXPECT_GT(force.nearest, 0.2) << robot.name;
    EXPECT_GT(friction_nearest, 0.8) << robot.name;
    ASSERT_GT(tightness.size(), static_cast<size_t>(Draws(20))) << robot.name;
    std::ranges::nth_element(tightness, tightness.begin() + std::ssize(tightness) / 2);
    EXPECT_LT(tightness[tightness.size() / 2], 1.2) << robot.name;
  }
}

}  // namespace
}  // namespace halfstep
