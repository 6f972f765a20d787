// Soles and areas where none may stand.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/smoothing/short_walks.h"
#include "wpg/motion/lipm.h"

namespace halfstep {
namespace {

// An area beside the place where the right foot lands, `gap` [m] ahead of what it touches there.
Scene AheadOf(const RobotModel& robot, const Pose2& X_WF, double gap) {
  Scene scene;
  Eigen::Matrix2Xd area(2, 4);
  const double x = X_WF.x + robot.sole_outline.row(0).maxCoeff() + gap;
  area << x, x + 0.1, x + 0.1, x, -0.5, -0.5, 0.5, 0.5;
  scene.no_step.push_back(area);
  return scene;
}

TEST(NoStep, OnlyASoleThatStandsBesideAllAreasIsCertified) {
  const RobotModel robot = Hrp2();
  const HalfStepSequence sequence = TwoSteps(robot);
  const SuperposedWalk walk(sequence, Overlapped(sequence, 0.6));
  const Pose2 landing{0.2, -0.5 * robot.standing_width, 0};
  const auto certify = [&](double gap, double demanded, Certificate* certificate) {
    return Certify(robot, AheadOf(robot, landing, gap), Only(MarginFamily::kNoStep, demanded), walk,
                   certificate);
  };
  Certificate certificate;
  EXPECT_EQ(certify(1e-6, 0.0, &certificate).verdict, Verdict::kFeasible);
  double least = kUnlimited;
  for (const CertificateRow& row : certificate) {
    if (row.family != MarginFamily::kNoStep) continue;
    EXPECT_EQ(row.count, 2);
    EXPECT_LE(row.bound, 1e-11);  // a sole that stands does not move
    least = std::min(least, row.margin.value);
  }
  EXPECT_NEAR(least, 1e-6, 1e-12);
  EXPECT_NE(certify(0.0, 0.0, &certificate).verdict, Verdict::kFeasible);  // touching
  EXPECT_EQ(certify(0.02, 0.019, &certificate).verdict, Verdict::kFeasible);
  for (const auto& [gap, demanded] :
       std::vector<std::pair<double, double>>{{-0.001, 0.0}, {0.0, 0.0}, {0.02, 0.021}}) {
    const Feasibility answer = certify(gap, demanded, &certificate);
    EXPECT_EQ(answer.verdict, Verdict::kViolated) << gap;
    EXPECT_EQ(answer.witness.family, MarginFamily::kNoStep);
    const MarginEvaluator evaluator(robot, AheadOf(robot, landing, gap), {});
    EXPECT_EQ(evaluator.Subject(answer.witness).substr(5), " foot - no_step[0]")
        << evaluator.Describe(answer.witness);
  }
}

// What touches is the outline, not the smaller rectangle that the ZMP must stay in.
TEST(NoStep, TheOutlineCountsWhereTheSoleRectangleIsClear) {
  const RobotModel robot = Hrp2();
  const double ahead = robot.sole_outline.row(0).maxCoeff(), rectangle = 0.5 * robot.sole_size.x();
  ASSERT_GT(ahead, rectangle + 0.001);
  const HalfStepSequence sequence = TwoSteps(robot);
  const SuperposedWalk walk(sequence, Overlapped(sequence, 0.6));
  const Pose2 landing{0.2, -0.5 * robot.standing_width, 0};
  const Scene scene = AheadOf(robot, landing, 0.5 * (rectangle - ahead));
  Certificate certificate;
  const Feasibility answer =
      Certify(robot, scene, Only(MarginFamily::kNoStep, 0.0), walk, &certificate);
  EXPECT_EQ(answer.verdict, Verdict::kViolated);
  EXPECT_EQ(answer.witness.family, MarginFamily::kNoStep);
  RobotModel smaller = robot;
  smaller.sole_outline.resize(2, 4);
  smaller.sole_outline << rectangle, -rectangle, -rectangle, rectangle, 0.06, 0.06, -0.06, -0.06;
  EXPECT_EQ(Certify(smaller, scene, Only(MarginFamily::kNoStep, 0.0), walk, &certificate).verdict,
            Verdict::kFeasible);
}

// The moving foot may pass above an area, and scenes without areas have no limit.
TEST(NoStep, CountsForSolesThatStandOnly) {
  const RobotModel robot = Hrp2();
  const double y = 0.5 * robot.standing_width;
  const HalfStepSequence sequence =
      MakeSequence({Foothold::Level({0, y, 0}), Foothold::Level({-0.2, -y, 0})},
                   {{.side = Side::kRight, .X_WF = Foothold::Level({0.2, -y, 0}), .duration = 2.0}},
                   0.24, {}, std::make_shared<Lipm>(robot.com_height));
  const SuperposedWalk walk(sequence, Overlapped(sequence, 0.3));
  Scene scene;
  Eigen::Matrix2Xd area(2, 4);
  area << -0.04, 0.04, 0.04, -0.04, -0.3, -0.3, -0.15, -0.15;
  scene.no_step.push_back(area);
  const MarginEvaluator evaluator(robot, scene, {}), free(robot, {}, {});
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch(), other = free.MakeScratch();
  int above = 0;
  for (int k = 0; k <= 200; ++k) {
    const double t = walk.duration() * k / 200.0;
    const LocalTime at = walk.Locate(t);
    const Margin margin = Of(evaluator.At(walk, at, &scratch), MarginFamily::kNoStep);
    EXPECT_GT(margin.value, 0.0);
    EXPECT_TRUE(std::isfinite(margin.value));  // of the left sole, when the right one is in the air
    EXPECT_EQ(Of(free.At(walk, at, &other), MarginFamily::kNoStep).value, kUnlimited);
    const Pose2 right = FootPose(walk.At(at).value, Side::kRight);
    above += NoStepAreas(scene, robot.sole_outline).NearestTo(right).distance < 0.0;
  }
  EXPECT_GT(above, 5);
  Certificate certificate;
  EXPECT_EQ(Certify(robot, scene, Only(MarginFamily::kNoStep, 0.0), walk, &certificate).verdict,
            Verdict::kFeasible);
}

}  // namespace
}  // namespace halfstep
