#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>

#include "opt/adapters/solver_registry.h"
#include "tests/problems/auto_blocks.h"
#include "tests/problems/solver_test.h"

// Boxes without room: variables whose bounds coincide or nearly do, and problems that have no
// feasible point because of them.

namespace halfstep::testing {
namespace {

using opt::Ending;
using ::testing::AnyOf;

constexpr int kVariables = 12;

/// ½‖x − 2‖² for x in [0, 5], every third variable within `width` of 1; with `rows`
/// x_i + x_{i+1} ≤ 3.2, active for the two free ones of each three, hence 1.6 each.
opt::Problem Narrow(double width, bool rows, double* farthest) {
  Eigen::VectorXd lower = Constant(kVariables, 0.0), upper = Constant(kVariables, 5.0);
  for (int i = 0; i < kVariables; i += 3) {
    lower[i] = 1.0;
    upper[i] = 1.0 + width;
  }
  ProblemBuilder builder(Constant(kVariables, 0.7), lower, upper);
  builder.Minimize([farthest](const auto& x) {
    auto total = 0.0 * x[0];
    for (size_t j = 0; j < kVariables; ++j) total = total + 0.5 * (x[j] - 2.0) * (x[j] - 2.0);
    if constexpr (std::is_same_v<std::decay_t<decltype(x[0])>, double>) {
      for (size_t j = 0; j < kVariables; j += 3) {
        *farthest = std::max(*farthest, std::abs(x[j] - 1.0));
      }
    }
    return total;
  });
  for (int i = 0; rows && i + 1 < kVariables; ++i) {
    const size_t k = static_cast<size_t>(i);
    builder.Row("pair " + std::to_string(i), -kInfinity,
                [k](const auto& x) { return x[k] + x[k + 1]; }, 3.2, {i, i + 1});
  }
  return builder.Build();
}

class SolverBoxes : public SolverTest {
 protected:
  /// As measured: isres is global and makes no promise, auglag_bobyqa uses up its evaluations.
  bool MayMiss() const {
    return GetParam() == "nlopt/isres" || GetParam() == "nlopt/auglag_bobyqa";
  }
};

TEST_P(SolverBoxes, WhatIsFixedStaysAndTheOthersFindTheOptimum) {
  for (const double width : {0.0, 1e-13, 1e-6}) {
    for (const bool rows : {false, true}) {
      double farthest = 0.0;
      const opt::Problem problem = Narrow(width, rows, &farthest);
      if (!solver().WhyUnsupported(problem).empty()) continue;
      opt::SolverOptions options;
      options.max_evaluations = MayMiss() ? 2000 : 20000;
      options.max_iterations = 1000;
      const opt::Solution solution = solver().Solve(problem, problem.initial(), options);
      SCOPED_TRACE(::testing::Message()
                   << "width " << width << ", rows " << rows << ": " << solution.BriefReport());
      ExpectTrue(problem, options, solution);
      EXPECT_LE(farthest, width + 1e-8) << "evaluated off its bounds";
      for (int i = 0; i < kVariables; i += 3) EXPECT_NEAR(solution.x[i], 1.0, width + 1e-9);
      if (MayMiss()) continue;
      const double optimum = 4 * 0.5 + (rows ? 8 * 0.5 * 0.16 : 0.0);
      EXPECT_TRUE(solution.feasible);
      EXPECT_NEAR(solution.cost, optimum, 1e-4);
      EXPECT_THAT(solution.ending, AnyOf(Ending::kConverged, Ending::kLimit));
    }
  }
}

TEST_P(SolverBoxes, WithoutFreedomThereIsNothingToSolve) {
  for (const double most : {3.0, 1.0}) {  // of a sum that is 2
    for (const bool row : {false, true}) {
      ProblemBuilder builder(Vector({0, 7}), Vector({1, 1}), Vector({1, 1}));
      builder.Minimize([](const auto& x) { return x[0] * x[0] + x[1]; });
      if (row)
        builder.Row(
            "sum", -kInfinity, [](const auto& x) { return x[0] + x[1]; }, most);
      const opt::Problem problem = builder.Build();
      if (!solver().WhyUnsupported(problem).empty()) continue;
      const opt::Solution solution = solver().Solve(problem, problem.initial(), {});
      SCOPED_TRACE(solution.BriefReport());
      ExpectTrue(problem, {}, solution);
      EXPECT_EQ(solution.x, Vector({1, 1}));
      EXPECT_EQ(solution.ending, !row || most > 2.0 ? Ending::kConverged : Ending::kFailed);
      EXPECT_LE(solution.cost_evaluations, 1);
    }
  }
}

TEST_P(SolverBoxes, AFixedVariableCanMakeAProblemInfeasible) {
  ProblemBuilder builder(Vector({0, 1, 0}), Vector({0, 1, -1}), Vector({1, 1, 1}));
  builder.Minimize([](const auto& x) { return x[0] + x[1] + x[2] * x[2]; })
      .NonNegative("sum", [](const auto& x) { return x[0] + x[1] - 2.5; });
  ExpectInfeasible(solver(), builder.Build(), 0.5 - 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Solvers, SolverBoxes, ::testing::ValuesIn(opt::SolverNames()),
                         SolverTestName);

}  // namespace
}  // namespace halfstep::testing
