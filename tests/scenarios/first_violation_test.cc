#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "planner/collision/separation.h"
#include "smoothing/margins/margin_evaluator.h"
#include "tests/scenarios/load_experiment.h"
#include "tests/smoothing/test_walks.h"
#include "wpg/motion/lipm.h"

namespace halfstep {
namespace {

// On the scenes of stepping over a bar, at overlaps that violate one margin or another, or none.
TEST(FirstViolation, IsFoundExactlyWhenAMarginIsBelowWhatIsDemanded) {
  WalkDraw draw(63);
  std::array<int, kNumMarginFamilies> seen{};
  int clear = 0;
  for (const char* name : {"bar_5cm", "bar_8cm", "bar_10cm"}) {
    const Experiment e = LoadExperiment(name);
    MarginLimits limits = e.config.smoothing.limits;
    // So that these families are met too.
    limits.demanded_of(MarginFamily::kZmp) = 0.045;
    limits.foot_speed = 0.75;
    limits.joint_speed_scale = 0.6;
    const MarginEvaluator evaluator(e.robot, e.scene, limits);
    MarginEvaluator::Scratch slow = evaluator.MakeScratch(), fast = evaluator.MakeScratch();
    for (int i = 0; i < 60; ++i) {
      const SuperposedWalk walk(e.sequence, draw.Uniform(0, 1) < 0.3
                                                ? draw.ExtremeParameters(e.sequence)
                                                : draw.Parameters(e.sequence, 0, 0.9));
      double t = draw.Uniform(0, walk.duration());
      for (int n = 0; n < 20; ++n) {
        // In turn far away and a little later, as a sweep does: both use what is remembered.
        t = n % 2 == 0 ? draw.Uniform(0, walk.duration()) : t + 0.01;
        const LocalTime at = walk.Locate(t);
        const MarginSet margins = evaluator.At(walk, at, &slow);
        const auto violation = evaluator.FirstViolation(walk, at, &fast);
        const Margin& worst = *std::min_element(
            margins.begin(), margins.end(),
            [&](const Margin& a, const Margin& b) { return limits.Slack(a) < limits.Slack(b); });
        if (std::abs(limits.Slack(worst)) < 1e-7) continue;
        ASSERT_EQ(violation.has_value(), limits.Slack(worst) < 0)
            << name << ": " << evaluator.Describe(worst);
        if (!violation) {
          ++clear;
          continue;
        }
        ++seen[static_cast<size_t>(violation->family)];
        EXPECT_LT(violation->value, limits.demanded_of(violation->family));
        EXPECT_LT(margins[static_cast<size_t>(violation->family)].value,
                  limits.demanded_of(violation->family));
        EXPECT_GE(violation->value, margins[static_cast<size_t>(violation->family)].value - 1e-6);
        EXPECT_EQ(violation->t, walk.Absolute(at));
      }
    }
  }
  EXPECT_GT(clear, 500);
  for (MarginFamily family : {MarginFamily::kFloor, MarginFamily::kFootSpeed, MarginFamily::kZmp,
                              MarginFamily::kJointSpeed, MarginFamily::kClearance}) {
    EXPECT_GT(seen[static_cast<size_t>(family)], 0) << Name(family);
  }
}

// Every pair of bodies by itself, large ones and dots: below its distance, and not above.
TEST(FirstViolation, SeesEveryPairOfBodies) {
  RobotModel robot = Hrp2();
  const int dots = static_cast<int>(robot.bodies.size());
  for (int leg : {0, 1}) {
    robot.bodies.push_back({.name = "dot", .leg = leg, .link = 5, .shape = MakeSphere(0.005)});
  }
  // Two dots 12 mm apart on one foot.
  for (const double x : {0.0, 0.012}) {
    robot.bodies.push_back({.name = "near dot", .leg = 0, .link = 5, .shape = MakeSphere(0.005)});
    robot.bodies.back().shape.vertices.col(0).x() += x;
    BoundBySphere(&robot.bodies.back().shape);
  }
  robot.self_pairs.push_back({dots + 2, dots + 3});
  robot.self_pairs.push_back({dots, dots + 1});
  robot.self_pairs.push_back({dots + 1, 0});
  const std::vector<std::array<int, 2>> pairs = robot.self_pairs;
  WalkDraw draw(72);
  for (int i = 0; i < Draws(10); ++i) {
    const HalfStepSequence sequence = MakeSequence(StandingFeet(), draw.Footsteps(2), 0.24, {},
                                                   std::make_shared<Lipm>(robot.com_height));
    const SuperposedWalk walk(sequence, draw.Parameters(sequence, 0.0, 0.5));
    const Posture posture = SolvePosture(robot, walk.At(draw.Uniform(0, walk.duration())).value);
    if (!posture.reachable) continue;
    for (const auto& [a, b] : pairs) {
      RobotModel one = robot;
      one.self_pairs = {{a, b}};
      const RobotBody &first = robot.bodies[static_cast<size_t>(a)],
                      &second = robot.bodies[static_cast<size_t>(b)];
      const double distance = Separate(CollisionShape(first.shape), posture.OfBody(first),
                                       CollisionShape(second.shape), posture.OfBody(second))
                                  .distance;
      if (distance <= 0.0) continue;
      const BodyClearances clearances(one, {});
      BodyClearances::Scratch scratch = clearances.MakeScratch();
      EXPECT_TRUE(clearances.FirstPairBelow(posture, distance + 1e-6, &scratch))
          << first.name << " - " << second.name;
      EXPECT_FALSE(clearances.FirstPairBelow(posture, distance - 1e-6, &scratch))
          << first.name << " - " << second.name;
    }
  }
}

}  // namespace
}  // namespace halfstep
