#include "smoothing/margins/slack_evaluator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "planner/ground/level_ground.h"
#include "tests/scenarios/load_experiment.h"
#include "tests/smoothing/test_walks.h"
#include "tests/wpg/joint_limits.h"
#include "wpg/motion/lipm.h"

namespace halfstep {
namespace {

class SlackRows : public testing::Test {
 protected:
  const Experiment e_ = LoadExperiment("bar_8cm");
  const MarginEvaluator evaluator_{WithAccelerationLimits(e_.robot, 30.0), e_.scene,
                                   e_.config.smoothing.limits};

  // Whether the family's rows have the slopes of differences, and are there where footsteps move.
  void AgreeWithDifferences(const Scene& scene, MarginFamily family);
};

TEST_F(SlackRows, TheLeastOfEachFamilyIsItsMargin) {
  constexpr double kCutoff = 4.0;
  SlackEvaluator slacks(evaluator_, kCutoff);
  MarginEvaluator::Scratch scratch = evaluator_.MakeScratch();
  WalkDraw draw(350);
  int compared = 0;
  for (int i = 0; i < Draws(100); ++i) {
    const SuperposedWalk walk(e_.sequence, draw.Parameters(e_.sequence, 0.0, 0.9));
    const LocalTime at = walk.Locate(draw.Uniform(0, walk.duration()));
    const MarginSet margins = evaluator_.At(walk, at, &scratch);
    if (!(margins[static_cast<size_t>(MarginFamily::kReach)].value > 0)) continue;
    InstantSlacks instant;
    slacks.At(walk, at, {}, false, &instant);
    for (MarginFamily family : AllMarginFamilies()) {
      double least = kCutoff;
      for (const SlackRow& row : instant.rows) {
        if (row.family == family) least = std::min(least, row.slack);
      }
      const double truth = evaluator_.limits().Slack(margins[static_cast<size_t>(family)]);
      EXPECT_NEAR(least, std::min(kCutoff, truth), 1e-7) << Name(family);
      compared += truth < kCutoff;
    }
  }
  EXPECT_GT(compared, Draws(100));
}

// Clearances have kinks where the nearest feature changes, as where soles that stand parallel turn:
// a row counts where differences with two steps, and to both sides, agree.
TEST_F(SlackRows, GradientsAgreeWithDifferences) {
  SlackEvaluator slacks(evaluator_, 6.0);
  WalkDraw draw(351);
  int compared = 0, kinks = 0, caught = 0;
  for (int i = 0; i < Draws(60); ++i) {
    const DrawnInstant drawn(e_.sequence, 0.05, 0.85, &draw);
    if (NearKnot(drawn.walk, drawn.t, 1e-3)) continue;
    const LocalTime& at = drawn.at;
    InstantSlacks here;
    slacks.At(drawn.walk, at, {}, true, &here);
    ASSERT_EQ(here.gradient.rows(), static_cast<Eigen::Index>(here.rows.size()));
    ASSERT_EQ(here.gradient.cols(), static_cast<Eigen::Index>(here.parameters.size()));
    for (size_t p = 0; p < here.parameters.size(); ++p) {
      const auto slopes = [&](double h, std::vector<double>* out, std::vector<double>* sided) {
        InstantSlacks sides[2];
        for (int s : {0, 1}) {
          HomotopyParameters moved = drawn.parameters;
          here.parameters[p].in(moved) += s == 0 ? -h : h;
          slacks.At(SuperposedWalk(e_.sequence, moved), at, {}, false, &sides[s]);
          if (sides[s].rows.size() != here.rows.size()) return false;
        }
        for (size_t r = 0; r < here.rows.size(); ++r) {
          if (sides[0].rows[r].family != here.rows[r].family) return false;
          out->push_back((sides[1].rows[r].slack - sides[0].rows[r].slack) / (2 * h));
          sided->push_back((sides[1].rows[r].slack - here.rows[r].slack) / h);
        }
        return true;
      };
      std::vector<double> coarse, fine, sided;
      if (!slopes(1e-5, &coarse, &sided) || !slopes(2e-6, &fine, &sided)) continue;
      sided.erase(sided.begin(), sided.begin() + std::ssize(here.rows));
      for (size_t r = 0; r < here.rows.size(); ++r) {
        const double size = 1 + std::abs(fine[r]);
        // The size of what is zero and grows both ways, as q̈ of a joint that does not turn.
        const bool tip = std::abs(fine[r]) < 1e-6 && std::abs(sided[r]) > 5e-4;
        if (std::abs(coarse[r] - fine[r]) > 1e-4 * size ||
            std::abs(sided[r] - fine[r]) > 2e-2 * size || tip) {
          ++kinks;
          continue;
        }
        const double analytic =
            here.gradient(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(p));
        EXPECT_NEAR(analytic, fine[r], 1e-3 * size)
            << Name(here.rows[r].family) << " along parameter " << p;
        ++compared;
        caught += std::abs(-analytic - fine[r]) > 1e-3 * size;  // the control: a wrong sign
      }
    }
  }
  EXPECT_GT(compared, Draws(60) * 10);
  EXPECT_LT(kinks, compared / 20);
  EXPECT_GT(caught, compared / 4);
}

// Soles that stand near an area where none may: footsteps move, so there are rows with slopes.
TEST_F(SlackRows, OfNoStepAreasAgreeWithDifferences) {
  Scene scene;
  scene.no_step.push_back((Eigen::Matrix2Xd(2, 3) << 0.2, 0.5, 0.45, 0.2, 0.22, 0.4).finished());
  AgreeWithDifferences(scene, MarginFamily::kNoStep);
}

// The same of a block, beside which the floor is level.
TEST_F(SlackRows, OfFootholdsAgreeWithDifferences) {
  const LevelSurface block{
      .name = "block",
      .polygon = (Eigen::Matrix2Xd(2, 3) << 0.2, 0.5, 0.45, 0.2, 0.22, 0.4).finished(),
      .height = 0.1,
      .bottom = 0.0};
  Scene scene;
  scene.ground = std::make_shared<const LevelGround>(std::vector{block}, true);
  AgreeWithDifferences(scene, MarginFamily::kFoothold);
}

void SlackRows::AgreeWithDifferences(const Scene& scene, MarginFamily family) {
  const MarginEvaluator evaluator(e_.robot, scene, e_.config.smoothing.limits);
  SlackEvaluator slacks(evaluator, 40.0, {}, /*footsteps_move=*/true), without(evaluator, 40.0);
  WalkDraw draw(353);
  const auto slack_of = [family](const InstantSlacks& instant) {
    double least = 1e9;
    for (const SlackRow& row : instant.rows) {
      if (row.family == family) least = std::min(least, row.slack);
    }
    return least;
  };
  int compared = 0, sloped = 0;
  for (int i = 0; i < Draws(60); ++i) {
    const HomotopyParameters parameters = draw.Parameters(e_.sequence, 0.05, 0.85);
    const SuperposedWalk walk(e_.sequence, parameters);
    const LocalTime at = walk.Locate(draw.Uniform(0, walk.duration()));
    InstantSlacks here, none;
    slacks.At(walk, at, {}, true, &here);
    without.At(walk, at, {}, true, &none);
    EXPECT_EQ(slack_of(none), 1e9);
    size_t row = 0;
    while (row < here.rows.size() && here.rows[row].family != family) ++row;
    if (row == here.rows.size()) continue;
    const bool two = row + 1 < here.rows.size() && here.rows[row + 1].family == family;
    if (two && here.rows[row + 1].slack < here.rows[row].slack) ++row;
    for (const HomotopyParameter& parameter : here.parameters) {
      const auto with = [&](double change) {
        HomotopyParameters moved = parameters;
        parameter.in(moved) += change;
        InstantSlacks there;
        slacks.At(SuperposedWalk(e_.sequence, moved), at, {}, false, &there);
        return slack_of(there);
      };
      const double slope = (with(1e-5) - with(-1e-5)) / 2e-5;
      EXPECT_NEAR(here.Slope(row, parameter), slope, 1e-3 * (1 + std::abs(slope)));
      ++compared;
      sloped += std::abs(slope) > 1.0;
    }
  }
  EXPECT_GT(compared, Draws(60));
  EXPECT_GT(sloped, Draws(60) / 3);
}

// Feet that turn fast both ways, and joints that come near their upper limits: of a straight walk
// neither is seen.
TEST_F(SlackRows, OfTurningFeetAndUpperLimitsAgreeWithDifferences) {
  RobotModel robot = e_.robot;
  for (Leg& leg : robot.legs) {
    for (size_t j = 0; j < 6; ++j) {
      leg.joints[j].lower = -3.0;
      leg.joints[j].upper = leg.standing_q[static_cast<Eigen::Index>(j)] + 0.5;
    }
  }
  const MarginEvaluator evaluator(robot, {}, {});
  SlackEvaluator slacks(evaluator, 30.0);
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  WalkDraw draw(352);
  int left = 0, right = 0;
  for (int i = 0; i < Draws(150); ++i) {
    const HalfStepSequence sequence = MakeSequence(StandingFeet(), draw.Footsteps(2), 0.24, {},
                                                   std::make_shared<Lipm>(robot.com_height));
    const HomotopyParameters parameters = draw.Parameters(sequence, 0.05, 0.6);
    const SuperposedWalk walk(sequence, parameters);
    const double t = draw.Uniform(0, walk.duration());
    if (NearKnot(walk, t, 1e-3)) continue;
    const LocalTime at = walk.Locate(t);
    InstantSlacks here;
    slacks.At(walk, at, {}, true, &here);
    const MarginSet margins = evaluator.At(walk, at, &scratch);
    if (!(margins[static_cast<size_t>(MarginFamily::kReach)].value > 0)) continue;
    double joint = 30.0;
    for (size_t r = 0; r < here.rows.size(); ++r) {
      if (here.rows[r].family == MarginFamily::kJoint) joint = std::min(joint, here.rows[r].slack);
      if (here.rows[r].family != MarginFamily::kFootYawRate) continue;
      const int step = walk.StepInAir(at);
      const int yaw = FootIndex(walk.half_step(2 * step).swing()) + 3;
      const double rate = walk.At(at).first[yaw];
      if (std::abs(rate) < 1e-2) continue;
      for (size_t p = 0; p < here.parameters.size(); ++p) {
        const auto rate_with = [&](double change) {
          HomotopyParameters moved = parameters;
          here.parameters[p].in(moved) += change;
          return std::abs(SuperposedWalk(sequence, moved).At(at).first[yaw]);
        };
        const double slope = -(rate_with(1e-6) - rate_with(-1e-6)) / 2e-6;
        EXPECT_NEAR(here.gradient(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(p)),
                    slope / Scale(MarginFamily::kFootYawRate), 1e-3 * (1 + std::abs(slope)));
        if (std::abs(slope) > 1e-2) ++(rate > 0 ? left : right);
      }
    }
    const double truth =
        evaluator.limits().Slack(margins[static_cast<size_t>(MarginFamily::kJoint)]);
    EXPECT_NEAR(joint, std::min(30.0, truth), 1e-7);
  }
  EXPECT_GT(left, kFewDraws ? 0 : 10);
  EXPECT_GT(right, kFewDraws ? 0 : 10);
}

// Where a leg does not reach there is a row that says so, whatever the others are.
TEST_F(SlackRows, OutOfReachIsARow) {
  const double y = 0.5 * e_.robot.standing_width;
  const HalfStepSequence sequence =
      MakeSequence({Foothold::Level({0, y, 0}), Foothold::Level({0, -y, 0})},
                   {{.side = Side::kLeft, .X_WF = Foothold::Level({1.2, y, 0})}}, 0.24, {},
                   std::make_shared<Lipm>(e_.robot.com_height));
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  SlackEvaluator slacks(evaluator_, 1.0);
  InstantSlacks instant;
  slacks.At(walk, walk.Locate(walk.duration()), {}, false, &instant);
  EXPECT_TRUE(std::any_of(instant.rows.begin(), instant.rows.end(), [](const SlackRow& row) {
    return row.family == MarginFamily::kReach && row.slack < 0.0;
  }));
}

}  // namespace
}  // namespace halfstep
