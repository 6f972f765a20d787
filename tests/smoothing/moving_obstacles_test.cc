// What the parts of the smoothing make of obstacles that move, or may have moved.

#include <gtest/gtest.h>

#include <cmath>

#include "smoothing/methods/dichotomy.h"
#include "smoothing/program/overlap_variables.h"
#include "smoothing/proof/certified_feasibility.h"
#include "smoothing/proof/stretch_proofs.h"
#include "tests/smoothing/fake_feasibility.h"
#include "tests/smoothing/smoothed.h"
#include "tests/smoothing/test_walks.h"
#include "wpg/motion/lipm.h"

namespace halfstep {
namespace {

// A ball beside the walk.
Scene Ball(const ObstacleMotion& motion) {
  Scene scene;
  scene.obstacles.push_back({.name = "ball",
                             .shape = Sphere{0.05},
                             .X_WO = Eigen::Isometry3d(Eigen::Translation3d(0.2, -0.6, 0.3)),
                             .motion = motion});
  return scene;
}

// Of which only a bound of the speed is known, for half a second.
Scene BallOf(double speed) { return Ball({.speed = speed, .horizon = 0.5}); }

class MovingObstacles : public testing::Test {
 protected:
  const HalfStepSequence sequence_ = MakeSequence(StandingFeet(),
                                                  {{.side = Side::kRight,
                                                    .X_WF = Foothold::Level({0.2, -0.105, 0}),
                                                    .via_height = 0.1,
                                                    .duration = 2},
                                                   {.side = Side::kLeft,
                                                    .X_WF = Foothold::Level({0.4, 0.105, 0}),
                                                    .via_height = 0.1,
                                                    .duration = 2}},
                                                  0.24, {.shift = 0.05, .foot_delay = 0.1},
                                                  std::make_shared<Lipm>(Hrp2().com_height));
  const HomotopyParameters planned_ = PlannedMotion(sequence_);
};

TEST_F(MovingObstacles, ACertificateLeavesRoomForTheirMotionInEveryInterval) {
  const SuperposedWalk walk(sequence_, planned_);
  size_t rows_at_rest = 0;
  for (double speed : {0.0, 0.05}) {
    const CertifiedFeasibility test(MarginEvaluator(Hrp2(), BallOf(speed), {}), {});
    MarginEvaluator::Scratch scratch = test.evaluator().MakeScratch();
    Certificate rows;
    ASSERT_EQ(test.Certify(walk, &scratch, &rows).verdict, Verdict::kFeasible);
    for (const CertificateRow& row : rows) {
      if (row.family != MarginFamily::kClearance || row.margin.other < 0) continue;
      EXPECT_GE(row.bound, speed * 0.5 * (row.end - row.begin));
      EXPECT_GE(row.margin.value - row.bound, 0.0);
    }
    if (speed == 0.0) rows_at_rest = rows.size();
    EXPECT_GE(rows.size(), rows_at_rest);
  }
  // So fast that no interval is short enough.
  const ObstacleMotion leap{.waypoints = {{1.0, {0.2, -0.6, 0.3}}, {1.00001, {0.2, -1.6, 0.3}}}};
  const CertifiedFeasibility test(MarginEvaluator(Hrp2(), Ball(leap), {}), {.resolution = 0.01});
  MarginEvaluator::Scratch scratch = test.evaluator().MakeScratch();
  EXPECT_EQ(test.Check(walk, {0.0, walk.duration()}, &scratch).verdict, Verdict::kUndecided);
}

// Where obstacles rest, or are only less certain later, an overlap matters in its window alone.
TEST_F(MovingObstacles, AnOverlapIsCheckedToTheEndOfTheWalk) {
  const ObstacleMotion rests{}, grows{.speed = 0.01, .measured_at = 0.0};
  const ObstacleMotion measured_later{.speed = 0.01, .measured_at = 100.0, .horizon = 1.0};
  const ObstacleMotion moves{.waypoints = {{1.0, {0.2, -0.6, 0.3}}, {5.0, {0.2, -1.6, 0.3}}}};
  for (const ObstacleMotion& motion : {rests, grows, measured_later, moves}) {
    const bool local = motion.waypoints.empty() && motion.measured_at == 0.0;
    const MarginEvaluator evaluator(Hrp2(), Ball(motion), {});
    const FakeFeasibility test(evaluator,
                               [](const HomotopyParameters&) { return Verdict::kFeasible; });
    const SmoothingResult result = Smoothed(Dichotomy, ProblemOf(sequence_, test), {});
    EXPECT_TRUE(result.feasible);
    ASSERT_EQ(test.questions.size(), 4u);  // the start and three overlaps
    for (size_t k = 1; k < 4; ++k) {
      const SuperposedWalk walk(sequence_, test.questions[k].parameters);
      const int junction = static_cast<int>(k) - 1;
      EXPECT_EQ(test.questions[k].span.end, local ? walk.end_of(junction) : walk.duration());
    }
  }
}

TEST_F(MovingObstacles, AProofIsRememberedForOneTimeOnly) {
  HomotopyParameters later = planned_;  // the first half-step is longer: the others begin later
  later.durations[0] *= 1.1;
  for (double speed : {0.0, 0.1}) {
    const MarginEvaluator evaluator(Hrp2(), BallOf(speed), {});
    const FakeFeasibility test(evaluator,
                               [](const HomotopyParameters&) { return Verdict::kFeasible; });
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    StretchProofs proofs(test, sequence_.size());
    EXPECT_TRUE(proofs.Refusals(SuperposedWalk(sequence_, planned_), &scratch).empty());
    const size_t before = test.questions.size();
    EXPECT_TRUE(proofs.Refusals(SuperposedWalk(sequence_, later), &scratch).empty());
    EXPECT_EQ(test.questions.size() - before, speed > 0.0 ? 4u : 1u);
  }
}

TEST_F(MovingObstacles, AnInstantDependsOnAllThatCameBefore) {
  const HalfStepSequence sequence = WalkDraw(80).Sequence(6);  // 12 half-steps
  const ParameterTable table(sequence, {}, {.heights = true, .durations = true});
  const OverlapVariables resting(sequence, table), moving(sequence, table, false);
  EXPECT_EQ(moving.Band(0), resting.Band(0));
  EXPECT_EQ(moving.Band(8).size(), resting.Band(8).size() + 5 + 2 + 5);
}

}  // namespace
}  // namespace halfstep
