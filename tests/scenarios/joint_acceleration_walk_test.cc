// Walks of a robot whose joint accelerations are limited, among the shipped experiments.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/overlap_optimizer.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/scenarios/load_experiment.h"
#include "tests/smoothing/smoothed.h"
#include "tests/smoothing/test_walks.h"
#include "tests/wpg/joint_limits.h"
#include "wpg/motion/posture.h"

namespace halfstep {
namespace {

// The largest |q̈| of the legs' joints, by differences of joint speeds [rad/s²].
double LargestAcceleration(const RobotModel& robot, const SuperposedWalk& walk) {
  constexpr double kStep = 1e-4, kPeriod = 2e-3;  // [s]
  const auto speeds = [&](double t) {
    Posture posture = SolvePosture(robot, walk.At(t).value);
    EXPECT_TRUE(SolveJointSpeeds(robot, walk.At(t), &posture));
    return posture.speeds;
  };
  double largest = 0.0;
  for (double t = kStep; t < walk.duration() - kStep; t += kPeriod) {
    const auto before = speeds(t - kStep), after = speeds(t + kStep);
    for (size_t s = 0; s < 2; ++s) {
      const Vector6d rate = (after[s] - before[s]) / (2 * kStep);
      largest = std::max(largest, rate.cwiseAbs().maxCoeff());
    }
  }
  return largest;
}

OptimizerOptions JointProgram() {
  OptimizerOptions options;
  options.solver = "halfstep/sqp";
  options.program.parameters.heights = options.program.parameters.durations = true;
  options.effort = 10.0;
  options.rounds = 8;
  return options;
}

struct Smoothings {
  SuperposedWalk dichotomy, sqp;
};

Smoothings SmoothingsOf(const Experiment& e, const RobotModel& robot) {
  const MarginEvaluator evaluator(robot, e.scene, e.config.smoothing.limits);
  const CertifiedFeasibility test(evaluator, {});
  const WalkProblem problem = ProblemOf(e.sequence, test);
  const Smoothings walks{
      {e.sequence, Smoothed(Dichotomy, problem, {}).parameters},
      {e.sequence, Smoothed(OptimizeOverlaps, problem, JointProgram()).parameters}};
  const CertifiedFeasibility independent(evaluator, {});
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  for (const SuperposedWalk* walk : {&walks.dichotomy, &walks.sqp}) {
    EXPECT_EQ(independent.Check(*walk, {0.0, walk->duration()}, &scratch).verdict,
              Verdict::kFeasible);
  }
  return walks;
}

// Three steps on the empty floor.
Experiment ThreeSteps() {
  ExperimentConfig config = LoadExperiment("fig3_two_half_steps").config;
  config.half_step.via_height = 0.1;
  config.footsteps.clear();
  for (const auto& [foot, x, y] :
       {std::tuple{"right", 0.15, -0.105}, {"left", 0.3, 0.105}, {"right", 0.3, -0.105}}) {
    FootstepConfig step;
    step.foot = foot;
    step.X_WF = {x, y, 0.0};
    config.footsteps.push_back(step);
  }
  return Prepare(config);
}

TEST(JointAccelerationWalk, KeepsItsLimitsAndIsLongerForThem) {
  const Experiment e = ThreeSteps();
  const SuperposedWalk planned(e.sequence, PlannedMotion(e.sequence));
  const Smoothings free = SmoothingsOf(e, e.robot);
  const double raw = LargestAcceleration(e.robot, planned);
  const double limit = 1.05 * raw;
  EXPECT_GT(LargestAcceleration(e.robot, free.dichotomy), limit);
  EXPECT_GT(LargestAcceleration(e.robot, free.sqp), limit);
  const Smoothings limited = SmoothingsOf(e, WithAccelerationLimits(e.robot, limit));
  // Less the error of the differences.
  EXPECT_LT(LargestAcceleration(e.robot, limited.dichotomy), limit + 1e-4 * limit);
  EXPECT_LT(LargestAcceleration(e.robot, limited.sqp), limit + 1e-4 * limit);
  EXPECT_GT(limited.dichotomy.duration(), free.dichotomy.duration() + 0.01);
  EXPECT_GT(limited.sqp.duration(), free.sqp.duration() + 0.01);
  // They are shorter than the plan all the same, and use what they are allowed.
  EXPECT_LT(limited.dichotomy.duration(), planned.duration() - 0.01);
  EXPECT_LT(limited.sqp.duration(), limited.dichotomy.duration() - 0.01);
  EXPECT_GT(LargestAcceleration(e.robot, limited.sqp), 0.8 * limit);
  RecordProperty("dichotomy_ms", static_cast<int>(1e3 * free.dichotomy.duration()));
  RecordProperty("sqp_ms", static_cast<int>(1e3 * free.sqp.duration()));
  RecordProperty("limited_dichotomy_ms", static_cast<int>(1e3 * limited.dichotomy.duration()));
  RecordProperty("limited_sqp_ms", static_cast<int>(1e3 * limited.sqp.duration()));
  RecordProperty("limit_mrad_s2", static_cast<int>(1e3 * limit));
}

}  // namespace
}  // namespace halfstep
