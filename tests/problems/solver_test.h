#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <string>

#include "opt/adapters/solver_registry.h"

namespace halfstep::testing {

/// A test for each solver that there is; skipped, with the reason, where it is not compiled in.
class SolverTest : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    solver_ = opt::MakeSolver(GetParam());
    if (!solver_->available()) GTEST_SKIP() << GetParam() << ": " << solver_->WhyUnavailable();
  }
  const opt::Solver& solver() const { return *solver_; }

 private:
  std::unique_ptr<opt::Solver> solver_;
};

inline std::string SolverTestName(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

/// What holds of the Solution of any solve that was not refused, however it ended.
inline void ExpectTrue(const opt::Problem& problem, const opt::SolverOptions& options,
                       const opt::Solution& solution) {
  ASSERT_EQ(solution.x.size(), problem.num_variables());
  EXPECT_NE(solution.ending, opt::Ending::kNotRun);
  EXPECT_FALSE(solution.message.empty());
  const opt::Violation violation = problem.MaxViolation(solution.x);
  EXPECT_EQ(solution.cost, problem.Cost(solution.x));
  EXPECT_EQ(solution.max_violation, violation.amount);
  EXPECT_EQ(solution.worst_row, violation.row);
  EXPECT_EQ(solution.feasible, violation.amount <= options.feasibility_tolerance);
  EXPECT_NE(solution.ending, opt::Ending::kNoImprovement) << "for callers to say";
  if (solution.ending == opt::Ending::kConverged) {
    EXPECT_TRUE(solution.feasible);
    EXPECT_LE(solution.stationarity, 1e-3);
  }
  EXPECT_LE(solution.cost_evaluations, options.max_evaluations + 1);
  ASSERT_FALSE(solution.history.empty());
  EXPECT_EQ(solution.history.front().iteration, 0);
  EXPECT_EQ(solution.requested_options, options.solver_options);
}

/// A solver that may evaluate 3000 times says of a problem that misses a row by `least` at least
/// that it is not feasible.
inline void ExpectInfeasible(const opt::Solver& solver, const opt::Problem& problem, double least) {
  if (!solver.WhyUnsupported(problem).empty()) GTEST_SKIP();
  opt::SolverOptions options;
  options.max_evaluations = 3000;
  const opt::Solution solution = solver.Solve(problem, problem.initial(), options);
  SCOPED_TRACE(solution.BriefReport());
  ExpectTrue(problem, options, solution);
  EXPECT_TRUE(solution.ending == opt::Ending::kLimit || solution.ending == opt::Ending::kFailed);
  EXPECT_FALSE(solution.feasible);
  EXPECT_GE(solution.max_violation, least);
  EXPECT_FALSE(solution.worst_row.empty());
}

}  // namespace halfstep::testing
