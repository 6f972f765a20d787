// Walks among obstacles that move: every method on the shipped scene, derivatives that know of the
// time, and what a wrong speed in a scene does.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "smoothing/margins/slack_evaluator.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/methods.h"
#include "smoothing/methods/solver_method_options.h"
#include "smoothing/program/watched_instants.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/scenarios/load_experiment.h"
#include "tests/scenarios/row_slopes.h"
#include "tests/smoothing/smoothed.h"
#include "tests/smoothing/test_walks.h"

namespace halfstep {
namespace {

bool IsCertified(const Experiment& e, const Scene& scene, const HomotopyParameters& parameters) {
  const CertifiedFeasibility test(MarginEvaluator(e.robot, scene, e.config.smoothing.limits), {});
  MarginEvaluator::Scratch scratch = test.evaluator().MakeScratch();
  Certificate rows;
  return test.Certify(SuperposedWalk(e.sequence, parameters), &scratch, &rows).verdict ==
         Verdict::kFeasible;
}

class EveryMethod : public testing::TestWithParam<std::string> {};

TEST_P(EveryMethod, ReturnsACertifiedWalkAcrossABarThatMoves) {
  const Experiment e = LoadExperiment("crossing");
  const CertifiedFeasibility test(MarginEvaluator(e.robot, e.scene, e.config.smoothing.limits), {});
  SmoothingMonitor monitor({.effort = 0.5});
  MethodOptions options;
  OptimizerOptions& optimizer = options.Edit(OptimizerGroup()).options;
  optimizer.effort = 0.5;
  options.Edit(DichotomyGroup()).tolerance = optimizer.tolerance = 0.02;
  optimizer.program.parameters = {.heights = true, .durations = true};
  const SmoothingResult result =
      Methods::Standard().Find(GetParam()).Smooth(ProblemOf(e.sequence, test), options, monitor);
  EXPECT_TRUE(result.feasible) << result.message;
  EXPECT_EQ(result.evidence, Evidence::kCertified);
  EXPECT_TRUE(IsCertified(e, e.scene, result.parameters));
  EXPECT_LE(DurationOf(result.parameters), DurationOf(PlannedMotion(e.sequence)));
}

INSTANTIATE_TEST_SUITE_P(All, EveryMethod, testing::ValuesIn(Methods::Standard().Names()),
                         [](const testing::TestParamInfo<std::string>& method) {
                           std::string name = method.param;
                           std::replace(name.begin(), name.end(), '/', '_');
                           return name;
                         });

TEST(MovingScenes, TheTimesOfTheObstaclesMatter) {
  const Experiment e = LoadExperiment("crossing");
  const CertifiedFeasibility test(MarginEvaluator(e.robot, e.scene, e.config.smoothing.limits), {});
  const SmoothingResult result = Smoothed(Dichotomy, ProblemOf(e.sequence, test), {});
  ASSERT_TRUE(result.feasible);
  Scene late = e.scene, without_box = e.scene;
  for (ObstacleMotion::Waypoint& waypoint : late.obstacles[1].motion.waypoints) waypoint.t += 3.0;
  EXPECT_FALSE(IsCertified(e, late, result.parameters));
  // Who need not wait for the box is faster.
  without_box.obstacles.pop_back();
  const CertifiedFeasibility alone(MarginEvaluator(e.robot, without_box, e.config.smoothing.limits),
                                   {});
  const SmoothingResult faster = Smoothed(Dichotomy, ProblemOf(e.sequence, alone), {});
  EXPECT_LT(DurationOf(faster.parameters), DurationOf(result.parameters) - 0.5);
  EXPECT_FALSE(IsCertified(e, e.scene, faster.parameters));
}

// Whatever is remembered and however far windows reach, nothing changes where nothing moves.
TEST(MovingScenes, MotionWithoutDisplacementGivesTheSameBytes) {
  for (const char* name : {"bar_8cm", "fig5_box"}) {
    const Experiment e = LoadExperiment(name);
    Scene moving = e.scene;
    for (Obstacle& obstacle : moving.obstacles) {
      obstacle.motion.waypoints = {{1.0, obstacle.X_WO.translation()},
                                   {5.0, obstacle.X_WO.translation()}};
    }
    ASSERT_FALSE(moving.rests());
    std::vector<HomotopyParameters> found;
    for (const Scene& scene : {e.scene, moving}) {
      const CertifiedFeasibility test(MarginEvaluator(e.robot, scene, e.config.smoothing.limits),
                                      {});
      found.push_back(Smoothed(Dichotomy, ProblemOf(e.sequence, test), {}).parameters);
    }
    EXPECT_EQ(found[0], found[1]) << name;
  }
}

// Two balls beside the walk that pass it quickly.
Scene Passing() {
  Scene scene;
  for (const double side : {-1.0, 1.0}) {
    Obstacle ball{.name = side < 0 ? "right" : "left", .shape = Capsule{0.05, 0.3}};
    ball.X_WO.translation() = Eigen::Vector3d(-0.6, side * 0.5, 0.2);
    ball.motion.waypoints = {{4.0, {0.8, side * 0.4, 0.3}, 1.0}, {9.0, {-0.4, side * 0.5, 0.6}}};
    ball.motion.error = 0.01;
    ball.motion.speed = side < 0 ? 0.02 : 0.0;
    ball.motion.measured_at = 3.0;
    scene.obstacles.push_back(ball);
  }
  return scene;
}

TEST(MovingScenes, SlopesAlongEveryEarlierParameterAgreeWithDifferences) {
  const Experiment e = LoadExperiment("bar_8cm");
  const MarginEvaluator evaluator(e.robot, Passing(), e.config.smoothing.limits);
  SlackEvaluator slacks(evaluator, 40.0);
  WalkDraw draw(371);
  int compared = 0, timed = 0, kinks = 0, by_time_alone = 0, caught = 0;
  for (int i = 0; i < Draws(40); ++i) {
    const DrawnInstant drawn(e.sequence, 0.05, 0.85, &draw);
    if (NearKnot(drawn.walk, drawn.t, 1e-3)) continue;
    const LocalTime& at = drawn.at;
    InstantSlacks here;
    slacks.At(drawn.walk, at, {}, true, &here);
    ASSERT_EQ(here.times.size(), 2 * static_cast<size_t>(at.half_step));
    for (const HomotopyParameter& parameter : AllParameters(e.sequence)) {
      // Of every row; not a number where rows come or go.
      const auto slopes = [&](double h) {
        std::vector<double> slopes(here.rows.size(), std::nan(""));
        InstantSlacks sides[2];
        for (const int s : {0, 1}) {
          HomotopyParameters moved = drawn.parameters;
          parameter.in(moved) += s == 0 ? -h : h;
          slacks.At(SuperposedWalk(e.sequence, moved), at, {}, false, &sides[s]);
          if (sides[s].rows.size() != here.rows.size()) return slopes;
        }
        for (size_t row = 0; row < slopes.size(); ++row) {
          slopes[row] = (sides[1].rows[row].slack - sides[0].rows[row].slack) / (2 * h);
        }
        return slopes;
      };
      const std::vector<double> coarses = slopes(1e-5), fines = slopes(2e-6);
      const bool listed = std::find(here.parameters.begin(), here.parameters.end(), parameter) !=
                          here.parameters.end();
      for (size_t row = 0; row < here.rows.size(); ++row) {
        if (here.rows[row].family != MarginFamily::kClearance) continue;
        const double coarse = coarses[row], fine = fines[row];
        const double size = 1 + std::abs(fine);
        if (!(std::abs(coarse - fine) <= 1e-4 * size)) {
          ++kinks;
          continue;
        }
        EXPECT_NEAR(here.Slope(row, parameter), fine, 1e-3 * size)
            << Traits(parameter.family).name << " " << parameter.index << ", half-step "
            << at.half_step;
        ++compared;
        timed += parameter.family != ParameterFamily::kSupportPoint &&
                 !Traits(parameter.family).of_form;  // which move no time
        by_time_alone += !listed && std::abs(fine) > 1e-3;
        // The control: obstacles that are thought to stand still.
        InstantSlacks still = here;
        still.times.clear();
        caught += std::abs(still.Slope(row, parameter) - fine) > 1e-3 * size;
      }
    }
  }
  EXPECT_GT(compared, Draws(40) * 20);
  EXPECT_LT(kinks, compared / 10);
  EXPECT_GE(by_time_alone, timed / 20);
  EXPECT_GE(caught, timed / 10);
}

TEST(MovingScenes, RowsOfTheProgramAgreeWithDifferences) {
  const Experiment e = LoadExperiment("bar_8cm");
  const MarginEvaluator evaluator(e.robot, Passing(), e.config.smoothing.limits);
  const OverlapVariables variables(
      e.sequence, ParameterTable(e.sequence, {}, {.heights = true, .durations = true}), false);
  const WatchedInstants table(variables, evaluator, {.instants = 4, .cutoff = 20.0});
  WalkDraw draw(372);
  int compared = 0, kinks = 0, caught = 0;
  for (int i = 0; i < Draws(6); ++i) {
    const Eigen::VectorXd x = variables.ToVariables(draw.Parameters(e.sequence, 0.1, 0.9)),
                          lower = variables.lower();
    const RowSlopes slopes(table, x, &draw);
    const Eigen::VectorXd &coarse = slopes.coarse, &fine = slopes.fine;
    size_t entry = 0;
    for (int row = 0; row < table.rows(); ++row) {
      const int half_step = table.half_step_of(row);
      const std::vector<int> near = OverlapVariables(e.sequence, variables.table()).Band(half_step);
      double analytic = 0.0, near_only = 0.0;
      for (const int v : table.band(half_step)) {
        const double part = slopes.nonzeros[entry++] * slopes.direction[v];
        analytic += part;
        if (std::find(near.begin(), near.end(), v) != near.end()) near_only += part;
      }
      const double size = 1 + std::abs(fine[row]);
      if (!(std::abs(coarse[row] - fine[row]) <= 1e-3 * size)) {
        ++kinks;
        continue;
      }
      ++compared;
      EXPECT_NEAR(analytic, fine[row], 5e-3 * size)
          << Name(table.family_of(row)) << " in half-step " << half_step;
      // The control: the band of obstacles that rest.
      caught += std::abs(near_only - fine[row]) > 5e-3 * size;
    }
  }
  EXPECT_GT(compared, Draws(6) * 30);
  EXPECT_LT(kinks, compared / 10);
  EXPECT_GT(caught, Draws(6) - 1);
}

// The least clearance from the obstacles of `scene` at instants 10 ms apart.
double LeastClearance(const Experiment& e, const Scene& scene, const HomotopyParameters& walk_of) {
  const MarginEvaluator evaluator(e.robot, scene, e.config.smoothing.limits);
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  const SuperposedWalk walk(e.sequence, walk_of);
  double least = 1e9;
  for (double t = 0.0; t < walk.duration(); t += 0.01) {
    least = std::min(
        least, Of(evaluator.At(walk, walk.Locate(t), &scratch), MarginFamily::kClearance).value);
  }
  return least;
}

TEST(MovingScenes, AStatedSpeedKeepsTheWalkClearAndAnUnderstatedOneDoesNot) {
  constexpr double kStated = 0.01;  // [m/s]
  Experiment e = LoadExperiment("bar_8cm");
  e.scene = {};
  Obstacle ball{.name = "ball", .shape = Sphere{0.05}};
  ball.X_WO.translation() = Eigen::Vector3d(0.3, -0.8, 0.7);
  e.scene.obstacles.push_back(ball);
  e.config.smoothing.limits.clearance_cap = 2.0;
  const HomotopyParameters planned = PlannedMotion(e.sequence);
  // 2 cm more than it may come near during the planned motion.
  const double spare = LeastClearance(e, e.scene, planned) - kStated * DurationOf(planned) - 0.02;
  e.scene.obstacles[0].X_WO.translation().y() += spare;
  e.scene.obstacles[0].motion.speed = kStated;
  const CertifiedFeasibility test(MarginEvaluator(e.robot, e.scene, e.config.smoothing.limits), {});
  const SmoothingResult result = Smoothed(Dichotomy, ProblemOf(e.sequence, test), {});
  ASSERT_TRUE(result.feasible) << result.message;
  const double demanded = e.config.smoothing.limits.demanded_of(MarginFamily::kClearance);

  // What it really does: straight on at `speed`.
  const auto nearest = [&](double speed, const Eigen::Vector3d& direction) {
    Scene truth = e.scene;
    Obstacle& moving = truth.obstacles[0];
    moving.motion = {.waypoints = {{20.0, moving.X_WO.translation() + 20.0 * speed * direction}}};
    return LeastClearance(e, truth, result.parameters);
  };
  double nearest_of_all = 1e9;
  WalkDraw draw(373);
  for (int i = 0; i < Draws(12); ++i) {
    const double angle = i == 0 ? 0.5 * std::numbers::pi : draw.Uniform(0, 2 * std::numbers::pi);
    const double least = nearest(kStated, {std::cos(angle), std::sin(angle), 0.0});
    EXPECT_GE(least, demanded);
    nearest_of_all = std::min(nearest_of_all, least);
  }
  EXPECT_LT(nearest_of_all, 0.2);  // one of them did come near
  EXPECT_LT(nearest(10 * kStated, Eigen::Vector3d::UnitY()), 0.0);
}

}  // namespace
}  // namespace halfstep
