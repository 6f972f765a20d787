#include "smoothing/program/overlap_variables.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "opt/problem/derivative_check.h"
#include "tests/smoothing/test_walks.h"

namespace halfstep {
namespace {

using Family = HomotopyParameter::Family;

// A random point of the variables' box.
Eigen::VectorXd Draw(const OverlapVariables& variables, WalkDraw* draw) {
  const HomotopyParameters planned = PlannedMotion(variables.sequence());
  Eigen::VectorXd x(variables.size());
  for (int v = 0; v < variables.size(); ++v) {
    const HomotopyParameter& p = variables.at(v);
    x[v] = draw->Uniform(0.02, 0.98);
    if (p.family == Family::kDuration) {
      x[v] = draw->Uniform(0.5, 1.5) * planned.durations[static_cast<size_t>(p.index)];
    } else if (Traits(p.family).of_form) {
      x[v] = variables.lower()[v] + x[v] * (variables.upper()[v] - variables.lower()[v]);
    }
  }
  return x;
}

TEST(OverlapVariables, ThereAndBackIsTheSameAndAlwaysInBounds) {
  WalkDraw draw(300);
  for (int i = 0; i < Draws(100); ++i) {
    const HalfStepSequence sequence = draw.Sequence(3);
    for (bool heights : {false, true}) {
      for (bool durations : {false, true}) {
        const OverlapVariables variables(
            sequence, ParameterTable(sequence, {}, {.heights = heights, .durations = durations}));
        EXPECT_EQ(variables.size(), 5 + (heights ? 3 : 0) + (durations ? 6 : 0));
        Eigen::VectorXd x = Draw(variables, &draw);
        const HomotopyParameters parameters = variables.ToParameters(x);
        EXPECT_NO_THROW(CheckParameters(sequence, parameters));
        EXPECT_LT((variables.ToVariables(parameters) - x).cwiseAbs().maxCoeff(), 1e-12);
        EXPECT_EQ(parameters.durations == PlannedMotion(sequence).durations, !durations);
        EXPECT_EQ(parameters.height_scales == PlannedMotion(sequence).height_scales, !heights);
        // s = 1 is the natural bound, less at most a millisecond.
        x.head(5).setOnes();
        const HomotopyParameters most = variables.ToParameters(x);
        for (int j = 0; j < 5; ++j) {
          const double room = NaturalOverlapBound(most, j) - most.overlaps[static_cast<size_t>(j)];
          EXPECT_GE(room, 0.0);
          EXPECT_LE(room, 1e-3 + 1e-12);
        }
      }
    }
  }
}

TEST(OverlapVariables, IndexOfInvertsAt) {
  const HalfStepSequence sequence = WalkDraw(301).Sequence(3);
  const OverlapVariables supports(sequence, ParameterTable(sequence, {}, {.support_points = true}));
  EXPECT_EQ(supports.size(), 5 + 3);
  EXPECT_EQ(supports.IndexOf({Family::kSupportPoint, 1}), 6);
  for (bool heights : {false, true}) {
    for (bool durations : {false, true}) {
      const OverlapVariables variables(
          sequence, ParameterTable(sequence, {}, {.heights = heights, .durations = durations}));
      for (int v = 0; v < variables.size(); ++v) EXPECT_EQ(variables.IndexOf(variables.at(v)), v);
      EXPECT_EQ(variables.IndexOf({Family::kHeightScale, 1}) < 0, !heights);
      EXPECT_EQ(variables.IndexOf({Family::kDuration, 1}) < 0, !durations);
    }
  }
}

TEST(OverlapVariables, PullIsTheChainRule) {
  WalkDraw draw(302);
  for (int i = 0; i < Draws(50); ++i) {
    const HalfStepSequence sequence = draw.Sequence(3);
    const OverlapVariables variables(sequence, ParameterTable(sequence, {}, EveryFamily()));
    const Eigen::VectorXd x = Draw(variables, &draw);
    const std::vector<HomotopyParameter> all = AllParameters(sequence);
    const auto function = [&](const Eigen::VectorXd& y) {
      HomotopyParameters parameters = variables.ToParameters(y);
      Eigen::VectorXd values(static_cast<Eigen::Index>(all.size()));
      for (size_t p = 0; p < all.size(); ++p) {
        values[static_cast<Eigen::Index>(p)] = all[p].in(parameters);
      }
      return values;
    };
    Eigen::MatrixXd jacobian =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(all.size()), x.size());
    const HomotopyParameters at = variables.ToParameters(x);
    for (size_t p = 0; p < all.size(); ++p) {
      variables.Pull(all[p], 1.0, x, at, [&](int v, double value) {
        jacobian(static_cast<Eigen::Index>(p), v) += value;
      });
    }
    // The corner of the bound is as sharp as 1 ms.
    const DerivativeReport report = CheckJacobian(function, x, jacobian, 1e-6);
    EXPECT_TRUE(report.Passed(1e-6)) << report.Describe();
    jacobian(0, variables.IndexOf({Family::kDuration, 0})) +=
        0.01;  // a wrong one is seen: of Δ_0 along T_0
    EXPECT_FALSE(CheckJacobian(function, x, jacobian, 1e-6).Passed(1e-6));
  }
}

TEST(OverlapVariables, TheBandHoldsEverythingThatAnInstantDependsOn) {
  WalkDraw draw(303);
  size_t seen = 0;
  for (int i = 0; i < Draws(200); ++i) {
    const HalfStepSequence sequence = draw.Sequence(5);
    const OverlapVariables variables(sequence, ParameterTable(sequence, {}, EveryFamily()));
    const SuperposedWalk walk(sequence, draw.ExtremeParameters(sequence));
    const LocalTime at = walk.Locate(draw.Uniform(0, walk.duration()));
    const std::vector<int> band = variables.Band(at.half_step);
    EXPECT_LT(band.size(), 100u);
    std::vector<WalkSensitivity> sensitivities;
    walk.Sensitivities(at, &sensitivities);
    for (const WalkSensitivity& s : sensitivities) {
      const auto stays = Traits(s.parameter.family).stays;
      if (stays != nullptr && stays(sequence, s.parameter.index)) continue;
      EXPECT_NE(std::find(band.begin(), band.end(), variables.IndexOf(s.parameter)), band.end());
      ++seen;
    }
  }
  EXPECT_GT(seen, static_cast<size_t>(Draws(200)));
}

}  // namespace
}  // namespace halfstep
