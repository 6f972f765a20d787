#include "wpg/motion/motion_bounds.h"
#include "smoothing/proof/interval_statements.h"
#include "wpg/motion/lipm.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "tests/smoothing/certificate_draws.h"
#include "tests/smoothing/motion_truth.h"

namespace halfstep {
namespace {

// Bounds at work on random intervals of random walks of one robot. Under sanitizers all intervals
// are bounded as well, but fewer are compared with the truth.
struct BoundTally {
  long intervals = 0;
  long bounded = 0;
  long compared = 0;
  std::array<double, kNumBounded> excess;  // largest truth − bound
};

BoundTally CompareRandomIntervals(const RobotModel& robot, int intervals, unsigned seed) {
  constexpr int kIntervalsPerWalk = 20;
  const std::vector<Eigen::Matrix3Xd> points = OuterPoints(robot);
  const MotionBounds bounds(robot);
  WalkDraw draw(seed);
  BoundTally tally;
  tally.excess.fill(-1.0);
  IntervalMotion motion;
  for (int i = 0; i < intervals; i += kIntervalsPerWalk) {
    const HalfStepSequence sequence = DrawSequence(robot, 2, {}, &draw);
    const SuperposedWalk walk(sequence, draw.ExtremeParameters(sequence));
    for (int k = 0; k < kIntervalsPerWalk; ++k) {
      ++tally.intervals;
      const double length = 1e-4 * std::pow(2000.0, draw.Uniform(0, 1));
      const double begin = draw.Uniform(0.0, walk.duration() - length);
      BoundMotion(bounds, walk, begin, begin + length, &motion);
      if (!motion.bounded) continue;
      ++tally.bounded;
      if (k >= Draws(kIntervalsPerWalk)) continue;
      for (const double part : {0.0, draw.Uniform(0, 1), 1.0}) {
        const bool reached = CompareWithTruth(robot, points, walk, motion, begin + part * length,
                                              [&](Bounded kind, int, double truth, double bound) {
                                                ++tally.compared;
                                                double& worst =
                                                    tally.excess[static_cast<size_t>(kind)];
                                                worst = std::max(worst, truth - bound);
                                              });
        EXPECT_TRUE(reached) << robot.name << " at " << begin + part * length << " s";
      }
    }
  }
  return tally;
}

TEST(MotionBounds, AreNeverExceededOnRandomIntervals) {
  unsigned seed = 1;
  for (const RobotModel& robot : RobotsOfAllKinds()) {
    const BoundTally tally = CompareRandomIntervals(robot, 2000, seed++);
    // A tenth of the intervals are longer than 90 ms, and some walks nearly stretch a leg.
    EXPECT_GT(tally.bounded, 0.85 * static_cast<double>(tally.intervals)) << robot.name;
    for (size_t kind = 0; kind < kNumBounded; ++kind) {
      // Places: what the certificate adds for rounding. Second derivatives are near 10² and larger.
      const double rounding = kind <= static_cast<size_t>(Bounded::kJointAngle) ? 1e-12 : 1e-10;
      EXPECT_LT(tally.excess[kind], rounding) << robot.name << ": " << kBoundedNames[kind];
    }
  }
}

TEST(MotionBounds, OfOffsetLegsAreNeverExceededOnRandomIntervals) {
  unsigned seed = 11;
  for (const RobotModel& robot : RobotsWithOffsets()) {
    const BoundTally tally = CompareRandomIntervals(robot, 600, seed++);
    // Longer intervals than about 20 ms have no bound.
    EXPECT_GT(tally.bounded, 0.5 * static_cast<double>(tally.intervals)) << robot.name;
    for (size_t kind = 0; kind < kNumBounded; ++kind) {
      const double rounding = kind <= static_cast<size_t>(Bounded::kJointAngle) ? 1e-12 : 1e-10;
      EXPECT_LT(tally.excess[kind], rounding) << robot.name << ": " << kBoundedNames[kind];
    }
  }
}

std::vector<RobotModel> All(std::vector<RobotModel> robots, const std::vector<RobotModel>& more) {
  robots.insert(robots.end(), more.begin(), more.end());
  return robots;
}

// A motion with constant second derivatives, faster than any walk in all directions; some of its
// quantities rest.
WalkJet DrawMotion(const RobotModel& robot, WalkDraw* draw) {
  WalkJet jet;
  jet.value[kLeftY] = 0.5 * robot.standing_width;
  jet.value[kRightY] = -0.5 * robot.standing_width;
  // A small robot's legs reach less far.
  const double size = std::min(1.0, LegScale(robot));
  const double fast = draw->Uniform(0, 1), pushed = draw->Uniform(0, 1);
  for (int q = 0; q < kNumQuantities; ++q) {
    const bool yaw = q == kWaistYaw || q == kLeftYaw || q == kRightYaw;
    const bool height = q == kLeftZ || q == kRightZ;
    const double unit = yaw ? 1.0 : size;
    jet.value[q] +=
        height ? size * draw->Uniform(0.0, 0.2) : (yaw ? 3.0 : size) * draw->Uniform(-0.2, 0.2);
    if (draw->Uniform(0, 1) < 0.5) jet.first[q] = unit * fast * draw->Uniform(-2, 2);
    if (draw->Uniform(0, 1) < 0.5) jet.second[q] = unit * pushed * draw->Uniform(-20, 20);
  }
  return jet;
}

TEST(MotionBounds, AreNeverExceededByMotionsThatAreNoWalks) {
  unsigned seed = 21;
  for (const RobotModel& robot : All(RobotsOfAllKinds(), RobotsWithOffsets())) {
    const std::vector<Eigen::Matrix3Xd> points = OuterPoints(robot);
    const MotionBounds bounds(robot);
    WalkDraw draw(seed++);
    IntervalMotion motion;
    std::array<double, kNumBounded> excess, nearest;
    excess.fill(-1.0);
    nearest.fill(0.0);
    int bounded = 0;
    for (int i = 0; i < Draws(4000); ++i) {
      const WalkJet mid = DrawMotion(robot, &draw);
      const double h = 1e-5 * std::pow(5000.0, draw.Uniform(0, 1));
      bounds.Bound(mid, mid.second.cwiseAbs(), h, &motion);
      if (!motion.bounded) continue;
      ++bounded;
      for (const double t : {-h, draw.Uniform(-h, h), h}) {
        WalkJet jet = mid;
        jet.value += t * mid.first + 0.5 * t * t * mid.second;
        jet.first += t * mid.second;
        const bool reached = CompareWithTruth(robot, points, jet, motion,
                                              [&](Bounded kind, int, double truth, double bound) {
                                                const size_t k = static_cast<size_t>(kind);
                                                excess[k] = std::max(excess[k], truth - bound);
                                                if (truth > 1e-6)
                                                  nearest[k] = std::max(nearest[k], truth / bound);
                                              });
        EXPECT_TRUE(reached) << robot.name;
      }
    }
    EXPECT_GT(bounded, Draws(4000) / 4) << robot.name;
    for (size_t kind = 0; kind < kNumBounded; ++kind) {
      EXPECT_LT(excess[kind], 1e-9) << robot.name << ": " << kBoundedNames[kind];
      // So near that a term forgotten would show.
      EXPECT_GT(nearest[kind], 0.9) << robot.name << ": " << kBoundedNames[kind];
    }
  }
}

// Bound over true supremum of all bodies and joints that move, on random intervals.
struct Tightness {
  long intervals = 0;
  long bounded = 0;
  std::vector<double> bodies, joints;
};

Tightness CompareSups(double length) {
  const RobotModel robot = Hrp2();
  const std::vector<Eigen::Matrix3Xd> points = OuterPoints(robot);
  const MotionBounds bounds(robot);
  WalkDraw draw(5);
  IntervalMotion motion;
  Tightness tightness;
  for (int i = 0; i < Draws(200); ++i) {
    const HalfStepSequence sequence = DrawSequence(robot, 2, {.stride = 0.7}, &draw);
    const SuperposedWalk walk(sequence, draw.Parameters(sequence, 0.0, 0.6));
    const double begin = draw.Uniform(0.0, walk.duration() - length);
    BoundMotion(bounds, walk, begin, begin + length, &motion);
    if (!motion.posture.reachable) continue;
    ++tightness.intervals;
    if (!motion.bounded) continue;
    ++tightness.bounded;
    std::vector<double> body_sups(robot.bodies.size(), 0.0), joint_sups(12, 0.0), joint_bounds(12);
    for (int k = 0; k <= 8; ++k) {
      CompareWithTruth(robot, points, walk, motion, begin + length * k / 8,
                       [&](Bounded kind, int index, double there, double bound) {
                         const size_t j = static_cast<size_t>(index);
                         if (kind == Bounded::kDisplacement) {
                           body_sups[j] = std::max(body_sups[j], there);
                         } else if (kind == Bounded::kJointAngle) {
                           joint_sups[j] = std::max(joint_sups[j], there);
                           joint_bounds[j] = bound;
                         }
                       });
    }
    for (size_t b = 0; b < body_sups.size(); ++b) {
      if (body_sups[b] > 1e-5) tightness.bodies.push_back(motion.displacement[b] / body_sups[b]);
    }
    for (size_t j = 0; j < 12; ++j) {
      if (joint_sups[j] > 1e-5) tightness.joints.push_back(joint_bounds[j] / joint_sups[j]);
    }
  }
  return tightness;
}

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<long>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

TEST(MotionBounds, AreTightOnShortIntervals) {
  const Tightness tightness = CompareSups(0.02);
  ASSERT_GT(tightness.intervals, Draws(100));
  EXPECT_GE(tightness.bounded, 0.99 * static_cast<double>(tightness.intervals));
  EXPECT_LT(Median(tightness.bodies), 1.2);
  EXPECT_LT(Median(tightness.joints), 1.4);
}

TEST(MotionBounds, ExistOnLongIntervals) {
  const Tightness tightness = CompareSups(0.05);
  ASSERT_GT(tightness.intervals, Draws(100));
  EXPECT_GE(tightness.bounded, 0.95 * static_cast<double>(tightness.intervals));
  EXPECT_LT(Median(tightness.bodies), 1.5);
  EXPECT_LT(Median(tightness.joints), 2.0);
}

TEST(MotionBounds, SpanKnotsAndBothEndsOfTheWalk) {
  const RobotModel robot = Hrp2();
  const std::vector<Eigen::Matrix3Xd> points = OuterPoints(robot);
  const MotionBounds bounds(robot);
  WalkDraw draw(6);
  IntervalMotion motion;
  for (int i = 0; i < Draws(20); ++i) {
    const HalfStepSequence sequence = DrawSequence(robot, 2, {.stride = 0.7}, &draw);
    const SuperposedWalk walk(sequence, draw.ExtremeParameters(sequence));
    for (double knot : Knots(walk)) {
      // Around a knot, from it, up to it, and of no length.
      for (const auto& [before, after] :
           std::array<std::pair<double, double>, 4>{{{5e-3, 5e-3}, {0, 1e-2}, {1e-2, 0}, {0, 0}}}) {
        const double begin = std::max(0.0, knot - before);
        const double end = std::max(begin, std::min(walk.duration(), knot + after));
        BoundMotion(bounds, walk, begin, end, &motion);
        if (!motion.bounded) continue;
        for (double t : {begin, 0.5 * (begin + end), end}) {
          CompareWithTruth(robot, points, walk, motion, t,
                           [&](Bounded kind, int index, double truth, double bound) {
                             EXPECT_LT(truth, bound + 1e-10)
                                 << kBoundedNames[static_cast<size_t>(kind)] << " " << index
                                 << " in [" << begin << ", " << end << "]";
                           });
        }
      }
    }
  }
}

TEST(MotionBounds, AreNoneWhereALegIsStretched) {
  const RobotModel robot = Hrp2();
  const double width = robot.standing_width;
  const std::array<Foothold, 2> start = {Foothold::Level({0, 0.5 * width, 0}),
                                         Foothold::Level({0, -0.5 * width, 0})};
  const HalfStepSequence sequence =
      MakeSequence(start, {{.side = Side::kLeft, .X_WF = Foothold::Level({0.9, 0.5 * width, 0})}},
                   0.24, {}, std::make_shared<Lipm>(robot.com_height));
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  const MotionBounds bounds(robot);
  IntervalMotion motion;
  BoundMotion(bounds, walk, walk.duration() - 0.01, walk.duration(), &motion);
  EXPECT_FALSE(motion.bounded);
  BoundMotion(bounds, walk, 0.0, 0.01, &motion);
  EXPECT_TRUE(motion.bounded);
}

// Of every body: sup of its points' accelerations in an interval, in W and seen from the waist. The
// displacement is h·(speed at m + h/2·acceleration), so that short intervals tell both.
struct Accelerations {
  std::vector<double> W, B;
};

std::optional<Accelerations> AccelerationsOf(const MotionBounds& bounds, const WalkJet& mid,
                                             const WalkState& second, double h,
                                             IntervalMotion* motion) {
  constexpr double kShort = 1e-7;
  IntervalMotion once, twice;
  bounds.Bound(mid, second, kShort, &once);
  bounds.Bound(mid, second, 2.0 * kShort, &twice);
  bounds.Bound(mid, second, h, motion);
  if (!once.bounded || !twice.bounded || !motion->bounded) return std::nullopt;
  const auto accelerations = [&](const std::vector<double>& a, const std::vector<double>& b,
                                 const std::vector<double>& displacements) {
    std::vector<double> result;
    for (size_t i = 0; i < a.size(); ++i) {
      const double speed = 2.0 * a[i] / kShort - 0.5 * b[i] / kShort;
      result.push_back(2.0 * (displacements[i] / h - speed) / h);
    }
    return result;
  };
  return Accelerations{
      accelerations(once.displacement, twice.displacement, motion->displacement),
      accelerations(once.displacement_B, twice.displacement_B, motion->displacement_B)};
}

// What is bounded over an interval is bounded at each of its instants by no more than that: no rate
// is taken at the midpoint where its sup is meant. Of such a slip the truth says nothing, for the
// term is one of third order, and sums of norms hide it.
TEST(MotionBounds, OfAnIntervalAreNotBelowThoseOfItsInstants) {
  unsigned seed = 61;
  int compared = 0;
  for (const RobotModel& robot : All(RobotsOfAllKinds(), RobotsWithOffsets())) {
    const MotionBounds bounds(robot);
    WalkDraw draw(seed++);
    for (int i = 0; i < Draws(900); ++i) {
      WalkJet mid = DrawMotion(robot, &draw);
      // Also where less grows: without accelerations, and without turns.
      if (i % 3 > 0) mid.second.setZero();
      if (i % 3 > 1) {
        for (int yaw : {kWaistYaw, kLeftYaw, kRightYaw}) mid.first[yaw] = 0.0;
      }
      const WalkState second = mid.second.cwiseAbs();
      const double h = 1e-3 * std::pow(60.0, draw.Uniform(0, 1));
      const double t = (draw.Uniform(0, 1) < 0.5 ? -1.0 : 1.0) * (h - 2e-5);
      WalkJet at = mid;
      at.value += t * mid.first + 0.5 * t * t * mid.second;
      at.first += t * mid.second;
      IntervalMotion whole, instant;
      const auto of_whole = AccelerationsOf(bounds, mid, second, h, &whole);
      const auto of_instant = AccelerationsOf(bounds, at, second, 1e-5, &instant);
      if (!of_whole || !of_instant) continue;
      ++compared;
      for (size_t b = 0; b < robot.bodies.size(); ++b) {
        EXPECT_LE(of_instant->W[b], of_whole->W[b] * (1 + 1e-6) + 1e-6) << robot.bodies[b].name;
        EXPECT_LE(of_instant->B[b], of_whole->B[b] * (1 + 1e-6) + 1e-6) << robot.bodies[b].name;
      }
      for (size_t s = 0; s < 2; ++s) {
        const JointBounds &all = whole.joints[s], &one = instant.joints[s];
        for (int j = 0; j < 6; ++j) {
          const size_t link = static_cast<size_t>(j);
          EXPECT_LE(one.speed[j], all.speed[j] * (1 + 1e-6)) << j;
          EXPECT_LE(one.acceleration[j], all.acceleration[j] * (1 + 1e-6)) << j;
          EXPECT_LE(one.turns[link].speed, all.turns[link].speed * (1 + 1e-6)) << j;
          EXPECT_LE(one.turns[link].acceleration, all.turns[link].acceleration * (1 + 1e-6)) << j;
        }
      }
    }
  }
  EXPECT_GT(compared, Draws(400));
}

}  // namespace
}  // namespace halfstep
