// Over a tenth of a millisecond bounds have nothing to hide behind: of many draws the largest truth
// nearly reaches its bound, so a bound that is a twentieth too small is exceeded.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "smoothing/proof/certified_feasibility.h"
#include "smoothing/proof/interval_statements.h"
#include "tests/smoothing/certificate_draws.h"
#include "tests/smoothing/robot_truth.h"
#include "wpg/motion/contact_rate.h"
#include "wpg/motion/foot_friction.h"
#include "wpg/motion/foot_loads.h"
#include "wpg/motion/leg_torques.h"
#include "wpg/motion/torque_drift.h"
#include "wpg/motion/zmp_drift.h"

namespace halfstep {
namespace {

constexpr double kShort = 1e-4;  // [s]
const int kWalks = kFewDraws ? 40 : 200;
const double kTight = kFewDraws ? 0.8 : 0.95;
constexpr double kWeight = 9.81;  // [N/kg]

// An interval of a walk with its bounds, and the dynamics at its middle and both ends.
struct ShortInterval {
  const SuperposedWalk& walk;
  LocalTime middle{};
  IntervalMotion motion;
  WalkThirds thirds;
  RobotDynamics at_m;
  std::array<RobotDynamics, 2> ends;

  std::optional<Side> support() const {
    const int step = walk.StepInAir(middle);
    if (step < 0) return std::nullopt;
    return walk.half_step(2 * step).support;
  }
};

// Calls visit(interval) with intervals between knots of random walks where the motion is bounded.
void ForEachShortInterval(const RobotModel& robot, unsigned seed,
                          const std::function<void(const ShortInterval&)>& visit) {
  const MotionBounds bounds(robot);
  WalkDraw draw(seed);
  for (int i = 0; i < kWalks; ++i) {
    const HalfStepSequence sequence = DrawSequence(robot, 2, {}, &draw);
    const SuperposedWalk walk(sequence, draw.ExtremeParameters(sequence));
    for (int k = 0; k < 6; ++k) {
      const double begin = draw.Uniform(0.0, walk.duration() - kShort), end = begin + kShort;
      if (!KnotsInside(walk, {begin, end}).empty()) continue;
      IntervalMotion motion;
      BoundMotion(bounds, walk, begin, end, &motion);
      if (!motion.bounded) continue;
      const auto at = [&](double t) -> RobotDynamics {
        const WalkJet jet = walk.At(t);
        Posture posture = SolvePosture(robot, jet.value);
        EXPECT_TRUE(posture.reachable && SolveJointSpeeds(robot, jet, &posture));
        return {robot, jet, posture, kWeight};
      };
      const ShortInterval interval{walk,
                                   walk.Locate(0.5 * (begin + end)),
                                   motion,
                                   walk.ThirdRanges(begin, end),
                                   {robot, motion.jet, motion.posture, kWeight},
                                   {at(begin), at(end)}};
      if (interval.at_m.Zmp()) visit(interval);
    }
  }
}

// The largest truth / bound, and that no truth exceeds its bound by more than rounding.
struct Nearest {
  double share = 0.0, excess = -1.0;

  void Compare(double truth, double bound, double rounding) {
    excess = std::max(excess, truth - bound - rounding);
    if (truth > 100.0 * rounding) share = std::max(share, truth / bound);
  }
};

// The bounds of ZMP and friction that make themselves of an interval.
struct ContactDrifts {
  ZmpDrift zmp;
  double friction = 0.0;
};

// Compares ZMP and friction at both ends with the bounds that `bounds_of(interval, friction)` has.
template <typename BoundsOf>
void CompareEnds(const RobotModel& robot, const ShortInterval& of, const BoundsOf& bounds_of,
                 Nearest* zmp, Nearest* needed) {
  const SupportPolygon polygon =
      SupportAt(of.walk, of.middle, of.motion.jet.value, robot.sole_size);
  const auto friction = FootFriction::Of(of.at_m, polygon);
  const ContactDrifts bounds = bounds_of(friction);
  for (const RobotDynamics& end : of.ends) {
    ASSERT_TRUE(end.Zmp());
    const Eigen::Vector2d way = *end.Zmp() - *of.at_m.Zmp();
    zmp->Compare(way.norm(), bounds.zmp.Along(way.normalized()), 1e-10);
    const auto there = FootFriction::Of(end, polygon);
    if (!friction || !there) continue;
    needed->Compare(there->needed() - friction->needed(), bounds.friction, 1e-9);
  }
}

TEST(TightBounds, OfZmpAndFrictionByRatesAreNearlyReached) {
  unsigned seed = 840;
  for (const WholeRobot& whole : WholeRobots()) {
    const RobotModel& robot = whole.model;
    Nearest zmp, needed;
    ForEachShortInterval(robot, seed++, [&](const ShortInterval& of) {
      const RobotDrift drift(robot, of.motion, of.thirds, of.at_m, kWeight);
      const auto rate = ContactRate::Over(robot, of.motion, of.thirds, drift, of.at_m, kWeight);
      ASSERT_TRUE(rate);
      const auto bounds = [&](const std::optional<FootFriction>& friction) -> ContactDrifts {
        return {ZmpDrift::At(*rate, of.at_m.contact()[5]), friction ? friction->Drift(*rate) : 0.0};
      };
      CompareEnds(robot, of, bounds, &zmp, &needed);
    });
    EXPECT_LT(zmp.excess, 0.0) << robot.name;
    EXPECT_LT(needed.excess, 0.0) << robot.name;
    EXPECT_GT(zmp.share, kTight) << robot.name;
    EXPECT_GT(needed.share, kTight) << robot.name;
  }
}

// Norms are what is known of the legs' inertia, and signs are lost in them: with the robots' own
// masses the largest share is 0.79 … 0.91 of the ZMP, 0.48 … 0.66 of friction and 0.74 … 0.99 of
// torques. What is known by direction is the weights and the waist. So the waist has all mass here
// but a thousandth of the legs'; the terms of legs have tests of their own (SparseMotions).
TEST(TightBounds, ByNormsAreNearlyReachedWhereTheWaistHasTheMass) {
  unsigned seed = 850;
  for (WholeRobot& whole : WholeRobots()) {
    RobotModel& robot = whole.model;
    for (auto& leg : robot.masses.links) {
      for (BodyMass& link : leg) link.mass *= 1e-3, link.inertia *= 1e-3;
    }
    Nearest zmp, needed;
    std::array<Nearest, 2> torque;  // one foot stands, both stand
    ForEachShortInterval(robot, seed++, [&](const ShortInterval& of) {
      const RobotDrift drift(robot, of.motion, of.thirds, of.at_m, kWeight);
      const ZmpDrift by_norms =
          ZmpDrift::Over(robot, of.motion, of.thirds, drift, of.at_m, kWeight);
      const auto bounds = [&](const std::optional<FootFriction>& friction) -> ContactDrifts {
        return {by_norms, friction ? friction->Drift(drift, by_norms) : 0.0};
      };
      CompareEnds(robot, of, bounds, &zmp, &needed);
      const auto support = of.support();
      const auto loads = [&](const RobotDynamics& at) {
        const WalkState& x = of.motion.jet.value;
        return support ? FootLoads::OneFoot(*support)
                       : FootLoads::BothFeet(FootPose(x, Side::kLeft), FootPose(x, Side::kRight),
                                             robot.sole_size, *at.Zmp());
      };
      const FootLoads here = loads(of.at_m);
      const TorqueDrift torques(of.motion, drift, of.at_m, here, by_norms.Most(), kWeight);
      for (const RobotDynamics& end : of.ends) {
        for (const Side side : {Side::kLeft, Side::kRight}) {
          const Vector6d moved = LegTorques(end, side, loads(end).On(side, end.contact())) -
                                 LegTorques(of.at_m, side, here.On(side, of.at_m.contact()));
          const Vector6d bound = torques.Of(side);
          for (Eigen::Index j = 0; j < 6; ++j) {
            torque[support ? 0 : 1].Compare(std::abs(moved[j]), bound[j], 1e-7);
          }
        }
      }
    });
    for (const Nearest& nearest : {zmp, needed, torque[0], torque[1]}) {
      EXPECT_LT(nearest.excess, 0.0) << robot.name;
    }
    EXPECT_GT(zmp.share, kTight) << robot.name;
    EXPECT_GT(needed.share, kTight) << robot.name;
    EXPECT_GT(torque[0].share, kTight) << robot.name;
    EXPECT_GT(torque[1].share, kTight) << robot.name;
  }
}

}  // namespace
}  // namespace halfstep
