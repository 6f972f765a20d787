#include "smoothing/walk/parameter_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/uniform_scan.h"
#include "smoothing/program/overlap_variables.h"
#include "tests/smoothing/fake_feasibility.h"
#include "tests/smoothing/smoothed.h"
#include "tests/smoothing/test_walks.h"

namespace halfstep {
namespace {

using Family = ParameterFamily;
using testing::HasSubstr;

class ParameterTableTest : public testing::Test {
 protected:
  const HalfStepSequence sequence_ = WalkDraw(80).Sequence(3);  // 5 junctions
  const HomotopyParameters planned_ = PlannedMotion(sequence_);
};

TEST_F(ParameterTableTest, HoldsEveryParameterOnceAndStartsAsPlanned) {
  const ParameterTable table(sequence_);
  ASSERT_EQ(table.rows().size(),
            5u + 3u + 6u + 3u + 3u + 3u * 6u + 3u + 2u * 6u + 3u * 3u + 2u * 6u);
  EXPECT_EQ(table.Start(), planned_);
  for (size_t row = 0; row < table.rows().size(); ++row) {
    const HomotopyParameter& parameter = table.rows()[row].parameter;
    EXPECT_EQ(table.IndexOf(parameter), static_cast<int>(row));
    EXPECT_EQ(table.rows()[row].start, parameter.in(planned_));
    EXPECT_EQ(table.free(parameter), parameter.family == Family::kOverlap);
    EXPECT_LE(table.rows()[row].lower, table.rows()[row].start);
    EXPECT_GE(table.rows()[row].upper, table.rows()[row].start);
  }
}

TEST_F(ParameterTableTest, FamiliesAreChosenByThemselvesOrWithThoseThatShareTheirKey) {
  for (const Family family : AllParameterFamilies()) {
    const ParameterFamilyTraits& traits = Traits(family);
    ParameterChoice choice;
    EXPECT_EQ(choice.moves(family), traits.always) << traits.name;
    bool* const flag = choice.flag(family);
    ASSERT_EQ(flag == nullptr, traits.always) << traits.name;
    if (flag == nullptr) continue;
    *flag = true;
    for (const Family other : AllParameterFamilies()) {
      const auto of_heights = [](Family f) {
        return f == Family::kHeightScale || Traits(f).of_heights;
      };
      const bool both = (traits.move != nullptr && Traits(other).move != nullptr) ||
                        (of_heights(family) && of_heights(other));
      EXPECT_EQ(choice.moves(other), other == family || both || Traits(other).always)
          << traits.name << " and " << Traits(other).name;
    }
    EXPECT_TRUE(traits.key.empty() || choice.moves(traits.key)) << traits.name;
    EXPECT_EQ(WithoutForms(choice) == choice, !traits.of_form || traits.of_heights) << traits.name;
    for (const ParameterBoundKey& bound : traits.bounds()) {
      EXPECT_EQ(choice.bound(bound.key), bound.initial);
      EXPECT_LE(bound.min, bound.initial) << bound.key;
      EXPECT_GE(bound.max, bound.initial) << bound.key;
    }
  }
  EXPECT_THROW(ParameterChoice{}.bound("least_patience"), std::logic_error);
  EXPECT_THROW((void)ParameterChoice{}.moves("patience"), std::logic_error);
}

TEST_F(ParameterTableTest, WhatACallerFixesKeepsItsValueAndIsNoVariable) {
  const double overlap = 0.5 * NaturalOverlapBound(planned_, 1);
  const ParameterTable table(sequence_,
                             {{{Family::kOverlap, 1}, overlap},
                              {{Family::kDuration, 4}},
                              {{Family::kHeightScale, 2}, 0.4},
                              {{Family::kSupportPoint, 0}, 0.01}},
                             {.heights = true, .durations = true, .support_points = true});
  const OverlapVariables variables(sequence_, table);
  EXPECT_EQ(variables.size(), 5 + 3 + 6 + 3 - 4);
  EXPECT_EQ(variables.IndexOf({Family::kOverlap, 1}), -1);
  WalkDraw draw(81);
  for (int i = 0; i < 100; ++i) {
    Eigen::VectorXd x = variables.lower();
    for (int v = 0; v < variables.size(); ++v) {
      x[v] = draw.Uniform(variables.lower()[v], variables.upper()[v]);
    }
    const HomotopyParameters parameters = variables.ToParameters(x);
    EXPECT_EQ(parameters.overlaps[1], overlap);
    EXPECT_EQ(parameters.durations[4], planned_.durations[4]);
    EXPECT_EQ(parameters.height_scales[2], 0.4);
    EXPECT_EQ(parameters.support_points[0], 0.01);
    EXPECT_NO_THROW(CheckParameters(sequence_, parameters));  // also the fixed overlap still fits
  }
}

TEST_F(ParameterTableTest, TheRangeOfSupportPointsHoldsThePlannedOne) {
  ParameterChoice choice{.support_points = true};
  choice.bound("least_support_point_m") = 0.01;
  choice.bound("most_support_point_m") = 0.03;
  for (const auto& [planned, lower, upper] :
       {std::array{-0.04, -0.04, 0.03}, {0.02, 0.01, 0.03}, {0.07, 0.01, 0.07}}) {
    HalfStepSequence sequence = sequence_;
    for (PlacedHalfStep& placed : sequence.half_steps) {
      placed.half_step.shape.support_point = planned;
    }
    const ParameterTable table(sequence, {}, choice);
    const ParameterRow& row = table.row({Family::kSupportPoint, 1});
    EXPECT_FALSE(row.fixed);
    EXPECT_EQ(row.start, planned);
    EXPECT_EQ(row.lower, lower);
    EXPECT_EQ(row.upper, upper);
  }
}

TEST_F(ParameterTableTest, RefusesWhatCannotBeFixed) {
  const auto complaint = [&](const std::vector<FixedParameter>& fixed) {
    return ComplaintAbout(sequence_, fixed);
  };
  EXPECT_EQ(complaint({{{Family::kOverlap, 4}}}), "");
  EXPECT_EQ(complaint({{{Family::kOverlap, 5}}}), "overlap 6: there are 5 (valid: 1 … 5)");
  EXPECT_THAT(complaint({{{Family::kOverlap, -1}}}), HasSubstr("there are 5"));
  EXPECT_THAT(complaint({{{Family::kDuration, 1}}, {{Family::kDuration, 1}, 1.0}}),
              HasSubstr("duration 2: is fixed twice"));
  EXPECT_THAT(complaint({{{Family::kDuration, 1}, 0.0}}), HasSubstr("too small (valid: above 0)"));
  EXPECT_THAT(complaint({{{Family::kOverlap, 0}, 100.0}}), HasSubstr("above its natural bound"));
  EXPECT_THAT(complaint({{{Family::kHeightScale, 0}, -0.1}}), HasSubstr("valid: from 0"));
  EXPECT_THROW(ParameterTable(sequence_, {{{Family::kOverlap, 5}}}), std::logic_error);
  const MarginEvaluator evaluator(Hrp2(), {}, {});
  const FakeFeasibility test(evaluator,
                             [](const HomotopyParameters&) { return Verdict::kFeasible; });
  EXPECT_THROW(ProblemOf(sequence_, test, {{{Family::kOverlap, 5}}}), std::logic_error);
}

// Every method that has no solver; those with one move OverlapVariables, as above.
TEST_F(ParameterTableTest, NoMethodMovesWhatIsFixed) {
  const MarginEvaluator evaluator(Hrp2(), {}, {});
  const FakeFeasibility test(evaluator, [](const HomotopyParameters& p) {
    return *std::max_element(p.overlaps.begin(), p.overlaps.end()) <= 0.25 ? Verdict::kFeasible
                                                                           : Verdict::kViolated;
  });
  const WalkProblem problem = ProblemOf(sequence_, test,
                                        {{{Family::kOverlap, 2}, 0.1},
                                         {{Family::kDuration, 0}},
                                         {{Family::kHeightScale, 1}, 0.5},
                                         {{Family::kSupportPoint, 2}, 0.03}});
  for (const SmoothingResult& result :
       {Smoothed(Dichotomy, problem, {}),
        Smoothed(UniformScan, problem, {.coarse = 0.1, .fine = 0.05})}) {
    EXPECT_TRUE(result.feasible) << result.message;
    EXPECT_LT(result.cost, DurationOf(problem.Start()));
    EXPECT_EQ(result.parameters.overlaps[2], 0.1);
    EXPECT_EQ(result.parameters.durations[0], planned_.durations[0]);
    EXPECT_EQ(result.parameters.height_scales[1], 0.5);
    EXPECT_EQ(result.parameters.support_points[1], planned_.support_points[1]);
    EXPECT_EQ(result.parameters.support_points[2], 0.03);
    EXPECT_TRUE(result.junctions[2].fixed);
    EXPECT_FALSE(result.junctions[1].fixed);
  }
}

}  // namespace
}  // namespace halfstep
