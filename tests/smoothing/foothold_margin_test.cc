// Soles that stand, and where their level ends.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/ground/level_ground.h"
#include "smoothing/margins/margin_evaluator.h"
#include "tests/smoothing/short_walks.h"

namespace halfstep {
namespace {

// A block from x on, which the soles keep off.
Scene BlockFrom(double x) {
  Eigen::Matrix2Xd polygon(2, 4);
  polygon << x, x + 1.0, x + 1.0, x, -1, -1, 1, 1;
  const LevelSurface block{.name = "block", .polygon = polygon, .height = 0.1, .bottom = 0.0};
  Scene scene;
  scene.ground = std::make_shared<const LevelGround>(std::vector{block}, true);
  return scene;
}

// Where the outline ends in front of a foot that has gone 0.2 m.
double Front(const RobotModel& robot) { return 0.2 + robot.sole_outline.row(0).maxCoeff(); }

TEST(FootholdMargin, OnlySolesInsideTheirLevelAreCertified) {
  const RobotModel robot = Hrp2();
  const HalfStepSequence sequence = TwoSteps(robot);
  const SuperposedWalk walk(sequence, Overlapped(sequence, 0.6));
  const auto certify = [&](double gap, double demanded, Certificate* certificate) {
    return Certify(robot, BlockFrom(Front(robot) + gap), Only(MarginFamily::kFoothold, demanded),
                   walk, certificate);
  };
  Certificate certificate;
  ASSERT_EQ(certify(0.02, 0.019, &certificate).verdict, Verdict::kFeasible);
  double least = kUnlimited;
  for (const CertificateRow& row : certificate) {
    if (row.family != MarginFamily::kFoothold) continue;
    EXPECT_EQ(row.count, 2);
    EXPECT_LE(row.bound, 1e-11);  // a sole that stands does not move
    least = std::min(least, row.margin.value);
  }
  EXPECT_NEAR(least, 0.02, 1e-9);
  for (const auto& [gap, demanded] :
       std::vector<std::pair<double, double>>{{-0.001, 0.0}, {0.02, 0.021}, {0.0049, 0.005}}) {
    const Feasibility answer = certify(gap, demanded, &certificate);
    EXPECT_EQ(answer.verdict, Verdict::kViolated) << gap;
    EXPECT_EQ(answer.witness.family, MarginFamily::kFoothold);
    const MarginEvaluator evaluator(robot, BlockFrom(Front(robot) + gap), {});
    EXPECT_EQ(evaluator.Subject(answer.witness).substr(5), " foot - block");
  }
}

TEST(FootholdMargin, IsAbsentWhereOneLevelIsEverywhere) {
  const RobotModel robot = Hrp2();
  const MarginEvaluator flat(robot, {}, {}), uneven(robot, BlockFrom(1.0), {});
  const auto has = [](const MarginEvaluator& evaluator) {
    return std::ranges::count(evaluator.families(), MarginFamily::kFoothold) == 1;
  };
  EXPECT_FALSE(has(flat));
  EXPECT_TRUE(has(uneven));
  const HalfStepSequence sequence = TwoSteps(robot);
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  MarginEvaluator::Scratch scratch = flat.MakeScratch();
  EXPECT_EQ(Nth(flat.At(walk, walk.Locate(0.5), &scratch), MarginFamily::kFoothold).value,
            kUnlimited);
  Certificate certificate;
  (void)Certify(robot, {}, Only(MarginFamily::kFoothold, 0.005), walk, &certificate);
  EXPECT_TRUE(std::ranges::none_of(certificate, [](const CertificateRow& row) {
    return row.family == MarginFamily::kFoothold;
  }));
}

TEST(FootholdMargin, CountsForSolesThatStandOnly) {
  const RobotModel robot = Hrp2();
  const HalfStepSequence sequence = TwoSteps(robot);
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  const MarginEvaluator evaluator(robot, BlockFrom(Front(robot) + 0.03), {});
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  for (double t = 0.0; t <= walk.duration(); t += 0.05) {
    const LocalTime at = walk.Locate(t);
    const Margin margin = Nth(evaluator.At(walk, at, &scratch), MarginFamily::kFoothold);
    double nearest = kUnlimited;
    for (const Side side : {Side::kLeft, Side::kRight}) {
      if (walk.InAir(at, side)) continue;
      nearest = std::min(nearest, 0.23 - walk.At(at).value[FootIndex(side)]);
    }
    EXPECT_NEAR(margin.value, nearest, 1e-9) << t;
  }
}

}  // namespace
}  // namespace halfstep
