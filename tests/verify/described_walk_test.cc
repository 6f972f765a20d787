// The walk that half_steps.csv describes, as verify derives it, and what it checks of it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "experiments/tables/parameter_tables.h"
#include "experiments/verify/check_overlaps.h"
#include "tests/verify/rows_of.h"

namespace halfstep::verify {
namespace {

using testing::HasSubstr;

// What overlaps.csv would say of a walk.
std::vector<OverlapRow> OverlapsOf(const HomotopyParameters& at) {
  std::vector<OverlapRow> rows;
  for (size_t i = 0; i < at.overlaps.size(); ++i) {
    rows.push_back({i % 2 == 0 ? "up_down" : "down_up", at.overlaps[i], at.durations[i],
                    at.durations[i + 1], at.height_scales[i / 2], at.height_scales[(i + 1) / 2]});
  }
  return rows;
}

// Durations, heights, support points, forms and overlaps are drawn; `fullness` of the natural
// bounds at most.
HomotopyParameters Drawn(const HalfStepSequence& sequence, double fullness, std::mt19937* random) {
  std::uniform_real_distribution<double> unit(0, 1);
  HomotopyParameters at = PlannedMotion(sequence);
  for (double& duration : at.durations) duration *= 0.8 + 0.4 * unit(*random);
  for (double& scale : at.height_scales) scale = 0.5 + unit(*random);
  for (double& offset : at.support_points) offset = 0.05 * unit(*random);
  for (double& via : at.of(ParameterFamily::kViaLateral)) via += 0.02 * unit(*random);
  for (double& ramp : at.of(ParameterFamily::kFootRamp)) ramp = 0.5 - 0.2 * unit(*random);
  for (double& delay : at.of(ParameterFamily::kFootDelay)) delay = 0.05 + 0.1 * unit(*random);
  for (double& share : at.of(ParameterFamily::kLiftShare)) share = 1 - 0.3 * unit(*random);
  for (double& ahead : at.of(ParameterFamily::kViaAlong)) ahead = 0.05 * unit(*random);
  for (double& shift : at.zmp_shifts) shift = 0.03 + 0.1 * unit(*random);
  for (double& ramp : at.of(ParameterFamily::kZmpBumpRamp)) ramp = 0.2 + 0.8 * unit(*random);
  for (double& x : at.footstep_xs) x = 0.02 * unit(*random);
  for (double& y : at.footstep_ys) y = 0.01 * unit(*random);
  for (double& yaw : at.footstep_yaws) yaw = 0.1 * unit(*random);
  for (size_t i = 0; i < at.overlaps.size(); ++i) {
    at.overlaps[i] = fullness * unit(*random) * NaturalOverlapBound(at, static_cast<int>(i));
  }
  return at;
}

// verify has its own list of the columns of forms.
TEST(VerifyFormColumns, AreThoseOfTheFamilies) {
  size_t k = 0;
  const auto& columns = kFormColumns;
  for (const ParameterFamily family : FamiliesOfHalfSteps(HalfStepsExtent::kForms)) {
    const ParameterFamilyTraits& traits = Traits(family);
    if (!traits.of_form) continue;
    ASSERT_LT(k, columns.size()) << traits.name;
    const FormColumn& one = columns[k++];
    EXPECT_EQ(one.name, traits.name);
    EXPECT_EQ(one.key, traits.key);
    EXPECT_EQ(one.column, traits.column);
    EXPECT_EQ(one.of_step(), traits.of == ParameterOf::kStep);
    EXPECT_EQ(one.least, traits.least);
    EXPECT_EQ(one.most, traits.most);
  }
  EXPECT_EQ(k, columns.size());
  size_t rise = 0;
  for (const ParameterFamily family : FamiliesOfHalfSteps(HalfStepsExtent::kHeights)) {
    const ParameterFamilyTraits& traits = Traits(family);
    if (!traits.of_heights) continue;
    ASSERT_LT(rise, kRiseColumns.size()) << traits.name;
    const FormColumn& one = kRiseColumns[rise++];
    EXPECT_EQ(one.name, traits.name);
    EXPECT_EQ(one.column, traits.column);
    EXPECT_EQ(one.of_step(), traits.of == ParameterOf::kStep);
    EXPECT_EQ(one.least, traits.least);
    EXPECT_EQ(one.most, traits.most);
  }
  EXPECT_EQ(rise, kRiseColumns.size());
}

TEST(DescribedWalk, IsTheWalkThatTheRowsWereMadeOf) {
  std::mt19937 random(3);
  const HalfStepSequence& sequence = Fig4().sequence;
  for (int k = 0; k < 8; ++k) {
    const SuperposedWalk walk(sequence, Drawn(sequence, 0.9, &random));
    const DescribedWalk described(Fig4().robot, PlanOf(sequence), RowsOf(walk));
    ASSERT_NEAR(described.end(), walk.duration(), 1e-12);
    std::uniform_real_distribution<double> time(0, walk.duration());
    for (int i = 0; i < 200; ++i) {
      const double t = time(random);
      const LocalTime at = walk.Locate(t);
      const WalkInstant one = described.At(t);
      const WalkJet other = walk.At(t);
      EXPECT_LT((one.value - other.value).cwiseAbs().maxCoeff(), 1e-10);
      EXPECT_LT((one.first - other.first).cwiseAbs().maxCoeff(), 1e-9);
      EXPECT_LT((one.second - other.second).cwiseAbs().maxCoeff(), 1e-8);
      EXPECT_EQ(described.HalfStepAt(t), at.half_step + 1);
      const Support support = described.SupportAt(t);
      EXPECT_EQ(support == Support::kRight, walk.InAir(at, Side::kLeft));
      EXPECT_EQ(support == Support::kLeft, walk.InAir(at, Side::kRight));
      for (const int side : {0, 1}) {
        const bool moves = one.first.segment<2>(side == 0 ? kLeftX : kRightX).norm() > 1e-9;
        EXPECT_TRUE(!moves || described.MovesHorizontally(t, side)) << t;
        const int step = walk.StepInAir(at);
        const bool swings = step >= 0 && Index(walk.half_step(2 * step).swing()) == side;
        EXPECT_EQ(described.MovesHorizontally(t, side), swings && walk.MovesHorizontally(step, at));
      }
    }
  }
}

TEST(DescribedWalk, JointSpeedsAreThoseOfItsRows) {
  const SuperposedWalk walk(Fig5().sequence, PlannedMotion(Fig5().sequence));
  const DescribedWalk described(Fig5().robot, PlanOf(Fig5().sequence), RowsOf(walk));
  for (const double t : {0.3, 0.9, 1.7, 2.2, 3.1}) {
    const PlayedRow a = described.Row(t - 1e-4), b = described.Row(t + 1e-4);
    for (const size_t side : {0u, 1u}) {
      const Vector6d speeds = (b.q[side] - a.q[side]) / (b.t - a.t);
      EXPECT_LT((described.JointSpeeds(t)[side] - speeds).norm(), 1e-5);
    }
  }
}

TEST(DescribedWalk, JointAnglesOfALegThatDoesNotReachAreNoNumbers) {
  RobotModel robot = Fig5().robot;
  const SuperposedWalk walk(Fig5().sequence, PlannedMotion(Fig5().sequence));
  EXPECT_TRUE(DescribedWalk(robot, PlanOf(Fig5().sequence), RowsOf(walk)).Row(1).AllFinite());
  robot.waist_height += 0.5;
  const PlayedRow row = DescribedWalk(robot, PlanOf(Fig5().sequence), RowsOf(walk)).Row(1);
  for (const Vector6d& q : row.q) EXPECT_TRUE(q.array().isNaN().all());
}

// Against second differences of the acceleration; not above them by more than what the norms give
// away.
TEST(DescribedWalk, BoundOfTheCoMsFourthDerivativeHoldsAndIsNear) {
  const SuperposedWalk walk(Fig5().sequence, PlannedMotion(Fig5().sequence));
  const DescribedWalk described(Fig5().robot, PlanOf(Fig5().sequence), RowsOf(walk));
  const double h = 1e-3;
  double most = 0, bound = 0;
  for (double t = 2 * h; t < described.end() - 2 * h; t += h) {
    const auto acceleration = [&](double at) -> Eigen::Vector2d {
      return described.At(at).second.segment<2>(kComX);
    };
    const double fourth =
        (acceleration(t + h) - 2 * acceleration(t) + acceleration(t - h)).norm() / (h * h);
    const double here = described.ComFourthBound(t - h, t + h);
    EXPECT_LE(fourth, here + 1e-6) << t;
    most = std::max(most, fourth);
    bound = std::max(bound, here);
  }
  EXPECT_LT(bound, 5 * most);
}

// Overlaps as long as the homotopy allows are accepted, longer ones by a microsecond are not.
TEST(CheckOverlaps, AcceptsNothingBeyondTheNaturalBounds) {
  std::mt19937 random(5);
  const HalfStepSequence& sequence = Fig4().sequence;
  const HomotopyParameters start = Drawn(sequence, 0, &random);
  for (size_t i = 0; i < start.overlaps.size(); ++i) {
    HomotopyParameters at = start;
    at.overlaps[i] = NaturalOverlapBound(at, static_cast<int>(i));
    std::vector<HalfStepRow> half_steps = RowsOf(SuperposedWalk(sequence, at));
    std::vector<OverlapRow> overlaps = OverlapsOf(at);
    Findings right, wrong;
    EXPECT_TRUE(CheckOverlaps(half_steps, overlaps, PlanOf(sequence), &right));
    EXPECT_THAT(right.reasons(), testing::IsEmpty());
    overlaps[i].overlap += 1e-6;
    for (size_t k = i + 1; k < half_steps.size(); ++k) half_steps[k].start -= 1e-6;
    EXPECT_FALSE(CheckOverlaps(half_steps, overlaps, PlanOf(sequence), &wrong));
    EXPECT_THAT(wrong.reasons(), testing::ElementsAre(HasSubstr("natural bound")));
  }
}

// One parameter of each family, fixed at its value and as planned, and what a walk says that moved
// it.
TEST(CheckFixed, NamesEveryParameterThatMoved) {
  std::mt19937 random(6);
  const HalfStepSequence& sequence = Fig4().sequence;
  HomotopyParameters at = Drawn(sequence, 0, &random);
  at.overlaps[1] = 0.01;
  const std::vector<HalfStepRow> half_steps = RowsOf(SuperposedWalk(sequence, at));
  const std::vector<OverlapRow> overlaps = OverlapsOf(at);
  const auto reasons = [&](const std::vector<FixedConfig>& fixed) {
    Findings findings;
    CheckFixed(half_steps, overlaps, PlanOf(sequence), fixed, &findings);
    return findings.reasons();
  };
  EXPECT_THAT(reasons({{"overlap", 2, at.overlaps[1]},
                       {"duration", 3, at.durations[2]},
                       {"height_scale", 2, at.height_scales[1]},
                       {"support_point", 2, at.support_points[1]},
                       {"via_lateral", 1, at.of(ParameterFamily::kViaLateral)[0]},
                       {"foot_ramp", 2, at.of(ParameterFamily::kFootRamp)[1]},
                       {"foot_delay", 3, at.of(ParameterFamily::kFootDelay)[2]},
                       {"lift_share", 4, at.of(ParameterFamily::kLiftShare)[3]},
                       {"via_along", 2, at.of(ParameterFamily::kViaAlong)[1]},
                       {"zmp_shift", 3, at.zmp_shifts[2]},
                       {"zmp_bump_ramp", 1, at.of(ParameterFamily::kZmpBumpRamp)[0]},
                       {"footstep_x", 1, at.footstep_xs[0]},
                       {"footstep_y", 2, at.footstep_ys[1]},
                       {"footstep_yaw", 1, at.footstep_yaws[0]}}),
              testing::IsEmpty());
  EXPECT_THAT(reasons({{"overlap", 2, at.overlaps[1] + 1e-6}}),
              testing::ElementsAre(HasSubstr("overlap 2 is")));
  EXPECT_THAT(reasons({{"duration", 3, at.durations[2] + 1e-6}}),
              testing::ElementsAre(HasSubstr("duration 3 is")));
  EXPECT_THAT(reasons({{"height_scale", 2, at.height_scales[1] + 1e-6}}),
              testing::ElementsAre(HasSubstr("height_scale 2 is")));
  EXPECT_THAT(reasons({{"support_point", 2, at.support_points[1] + 1e-6}}),
              testing::ElementsAre(HasSubstr("support_point 2 is")));
  EXPECT_THAT(reasons({{"via_lateral", 1, {}},
                       {"lift_share", 4, {}},
                       {"via_along", 2, {}},
                       {"zmp_shift", 3, {}},
                       {"zmp_bump_ramp", 1, {}},
                       {"footstep_y", 1, {}}}),
              testing::ElementsAre(HasSubstr("via_lateral 1 is"), HasSubstr("lift_share 4 is"),
                                   HasSubstr("via_along 2 is"), HasSubstr("zmp_shift 3 is"),
                                   HasSubstr("zmp_bump_ramp 1 is"), HasSubstr("footstep_y 1 is")));
  const std::string planned = Formatted("fixed at %.9g", sequence.half_steps[2].half_step.duration);
  EXPECT_THAT(reasons({{"overlap", 2, {}},
                       {"duration", 3, {}},
                       {"height_scale", 2, {}},
                       {"support_point", 2, {}}}),
              testing::ElementsAre(HasSubstr("fixed at 0"), HasSubstr(planned),
                                   HasSubstr("fixed at 1"), HasSubstr("fixed at 0")));
  EXPECT_THAT(reasons({{"via_point", 1, {}}, {"overlap", 400, {}}}),
              testing::ElementsAre(HasSubstr("via_point 1 is not known"),
                                   HasSubstr("overlap 400 is not known")));
}

}  // namespace
}  // namespace halfstep::verify
