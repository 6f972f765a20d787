#include "opt/adapters/solver_registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <thread>
#include <vector>

#include "opt/adapters/box_transform.h"
#include "opt/solvers/option_text.h"
#include "opt/solvers/row_penalties.h"
#include "tests/problems/constructed_problems.h"
#include "tests/problems/hock_schittkowski.h"

namespace halfstep::testing {
namespace {

using ::testing::HasSubstr;

TEST(MakeSolver, KnowsEveryNameAndListsThemForAnUnknownOne) {
  for (const std::string& name : opt::SolverNames()) {
    const auto solver = opt::MakeSolver(name);
    EXPECT_EQ(solver->name(), name);
    EXPECT_EQ(solver->available(), solver->WhyUnavailable().empty());
  }
  try {
    (void)opt::MakeSolver("simplex");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("`simplex` (valid: ipopt, nlopt/ccsaq"));
  }
}

TEST(MakeSolver, AnAbsentSolverRefusesWithItsReason) {
  const ProblemCard card = Hs1();
  for (const std::string& name : opt::SolverNames()) {
    const auto solver = opt::MakeSolver(name);
    if (solver->available()) continue;
    const opt::Solution solution = solver->Solve(card.problem, card.problem.initial(), {});
    EXPECT_EQ(solution.ending, opt::Ending::kInvalidInput);
    EXPECT_EQ(solution.message, solver->WhyUnavailable());
  }
}

TEST(Solution, SaysThatNothingRan) {
  const opt::Solution solution;
  EXPECT_EQ(solution.ending, opt::Ending::kNotRun);
  EXPECT_EQ(solution.BriefReport(), "no solver: not_run. Solve was not called.");
  EXPECT_FALSE(solution.feasible);
}

TEST(Solution, ReportsOnOneLineAndOnAPage) {
  opt::Solution solution;
  solution.solver = "ipopt";
  solution.ending = opt::Ending::kFailed;
  solution.message = "Why.";
  solution.x = Vector({1});
  solution.cost = 2.0;
  solution.max_violation = 0.5;
  solution.worst_row = "disk";
  solution.used_options = {{"tol", "1e-6"}};
  EXPECT_THAT(solution.BriefReport(), HasSubstr("ipopt: failed, cost 2, violated by 0.5 in disk"));
  EXPECT_EQ(solution.BriefReport().find('\n'), std::string::npos);
  EXPECT_THAT(solution.FullReport(), HasSubstr("used       tol = 1e-6"));
}

TEST(Solver, SolvesInSeveralThreadsAtOnce) {
  const ProblemCard card = Hs65();
  for (const std::string& name : opt::SolverNames()) {
    const auto solver = opt::MakeSolver(name);
    if (!solver->available() || !solver->WhyUnsupported(card.problem).empty()) continue;
    if (name == "nlopt/isres") continue;  // slow, and nothing of its own to race
    std::vector<double> costs(4);
    std::vector<std::thread> threads;
    for (double& cost : costs) {
      threads.emplace_back(
          [&] { cost = solver->Solve(card.problem, card.problem.initial(), {}).cost; });
    }
    for (std::thread& thread : threads) thread.join();
    for (const double cost : costs) EXPECT_EQ(cost, costs.front()) << name;
  }
}

// Where it ended, what the solver knew of curvature brings it back in fewer steps.
TEST(Sqp, GoesOnFromAWarmStart) {
  const ProblemCard card = Hs65();
  const auto solver = opt::MakeSolver("halfstep/sqp");
  const opt::Solution first = solver->Solve(card.problem, card.problem.initial(), {});
  ASSERT_NE(first.warm_start, nullptr);
  const Eigen::VectorXd near = first.x + Eigen::VectorXd::Constant(first.x.size(), 0.01);
  opt::SolverOptions warm;
  warm.warm_start = first.warm_start;
  const opt::Solution cold = solver->Solve(card.problem, near, {});
  const opt::Solution again = solver->Solve(card.problem, near, warm);
  EXPECT_NEAR(again.cost, card.optimum, 1e-4);
  EXPECT_LT(again.iterations, cold.iterations);
  const ProblemCard other = BandedQuadratic(7);  // of another size: begins anew
  const opt::Solution anew = solver->Solve(other.problem, other.problem.initial(), warm);
  EXPECT_NEAR(anew.cost, other.optimum, 1e-4);
}

TEST(Sqp, WithoutMemoryItSolvesLinearProgramsOnly) {
  opt::SolverOptions options;
  options.solver_options["memory"] = "0";
  const auto solver = opt::MakeSolver("halfstep/sqp");
  const ProblemCard curved = Hs65();
  const opt::Solution solution = solver->Solve(curved.problem, curved.problem.initial(), options);
  EXPECT_NE(solution.ending, opt::Ending::kInvalidInput) << solution.message;
  EXPECT_TRUE(solution.feasible);
}

// Trials that are refused are not differentiated, nor is a step that was taken last.
TEST(Sqp, DerivativesAreAskedForOnlyWhereAStepBegins) {
  const ProblemCard card = Hs65();
  opt::SolverOptions options;
  options.solver_options["memory"] = "0";
  options.max_iterations = 8;
  const opt::Solution limited =
      opt::MakeSolver("halfstep/sqp")->Solve(card.problem, card.problem.initial(), options);
  ASSERT_EQ(limited.ending, opt::Ending::kLimit) << limited.message;
  EXPECT_LE(limited.jacobian_evaluations, limited.iterations);
  EXPECT_GT(limited.constraint_evaluations, limited.iterations) << "no trial was refused";
}

TEST(Sqp, ABoundOnThePenaltyIsKeptAndViolatedRowsAreNoSuccess) {
  opt::SolverOptions options;
  options.solver_options["penalty"] = options.solver_options["most_penalty"] = "1e-6";
  const auto solver = opt::MakeSolver("halfstep/sqp");
  const ProblemCard card = Hs65();
  const opt::Solution cheap = solver->Solve(card.problem, card.problem.initial(), options);
  EXPECT_GT(cheap.final_violation, 1.0) << cheap.BriefReport();
  EXPECT_NE(cheap.ending, opt::Ending::kConverged);
  const opt::Solution dear = solver->Solve(card.problem, card.problem.initial(), {});
  EXPECT_LT(dear.final_violation, 1e-4) << dear.BriefReport();
  EXPECT_NEAR(dear.cost, card.optimum, 1e-4);
}

// x_i + x_{i+1} ≤ 1 in a chain, each x_i worth 1 but two, which are worth 60: multipliers of 1 and
// of
// 60. Only the two rows' penalties have to grow from 2.
TEST(Sqp, PenaltiesGrowWhereMultipliersAreLargeAndNowhereElse) {
  constexpr int kSize = 20;
  ProblemBuilder builder(Constant(kSize, 0.0), Constant(kSize, 0.0), Constant(kSize, 5.0));
  builder.Minimize([](const auto& x) {
    auto total = 0.0 * x[0];
    for (size_t j = 0; j < kSize; ++j) total = total - (j == 8 || j == 9 ? 60.0 : 1.0) * x[j];
    return total;
  });
  for (int i = 0; i + 1 < kSize; i += 2) {
    const size_t k = static_cast<size_t>(i);
    builder.Row("pair " + std::to_string(i), -kInfinity,
                [k](const auto& x) { return x[k] + x[k + 1]; }, 1.0, {i, i + 1});
  }
  const opt::Problem problem = builder.Build();
  const auto solver = opt::MakeSolver("halfstep/sqp");
  opt::SolverOptions options;
  options.solver_options = {{"memory", "0"}, {"penalty", "2"}};
  const opt::Solution found = solver->Solve(problem, problem.initial(), options);
  EXPECT_EQ(found.ending, opt::Ending::kConverged) << found.BriefReport();
  EXPECT_NEAR(found.cost, -69.0, 1e-4);
  EXPECT_LE(found.iterations, 30);
  options.solver_options["most_penalty"] = "2";  // a fixed one: what grows is needed
  const opt::Solution lost = solver->Solve(problem, problem.initial(), options);
  EXPECT_FALSE(lost.ending == opt::Ending::kConverged) << lost.BriefReport();
  EXPECT_GT(lost.final_violation, 1.0);
}

TEST(RowPenalties, AreRaisedByGroupAndRemembered) {
  ProblemBuilder builder(Constant(3, 0.0));
  builder.Minimize([](const auto& x) { return x[0]; });
  for (int i = 0; i < 2; ++i) {
    const size_t k = static_cast<size_t>(i);
    builder.Row("row " + std::to_string(i), 0.0, [k](const auto& x) { return x[k] + x[k + 1]; },
                kInfinity, {i, i + 1});
  }
  const opt::Problem problem = builder.Build();
  const opt::ScaledRows rows(problem, problem.Jacobian(problem.initial()));
  opt::RowPenalties penalties(rows, {}, 2.0, 30.0);
  const Eigen::VectorXd c = Vector({-1.0, 0.5});
  const std::vector<double> none(2, 0.0);
  EXPECT_EQ(penalties.Violations(c), (std::vector<double>{1.0, 0.0}));
  EXPECT_EQ(penalties.Owed(c), 2.0);
  const opt::RowPenalties before = penalties;
  EXPECT_TRUE(penalties.Raise(penalties.Violations(c), none));
  EXPECT_EQ(penalties.OfRows(), Vector({20.0, 2.0}));
  EXPECT_FALSE(penalties.TakeBack(before, {0.4, 9.0}, {0.5, 0.0})) << "it helped";
  EXPECT_TRUE(penalties.Raise({1.0, 0.0}, none));
  EXPECT_EQ(penalties.Of(0), 30.0) << "the most";
  EXPECT_FALSE(penalties.Raise({1.0, 0.0}, none));
  const opt::RowPenalties later(rows, penalties.Remembered(), 2.0, 30.0);
  EXPECT_EQ(later.OfRows(), penalties.OfRows());
  EXPECT_TRUE(penalties.TakeBack(before, {0.6, 0.0}, {0.5, 0.0}));
  EXPECT_EQ(penalties.OfRows(), before.OfRows());
}

TEST(BoxTransform, StaysInsideAndInverts) {
  const opt::BoxTransform box(Vector({-1, -kInfinity, 2, -kInfinity, 3}),
                              Vector({4, kInfinity, kInfinity, 5, 3}));
  const Eigen::VectorXd z = Vector({1.1, -7, 0.4, 2, 9});
  const Eigen::VectorXd x = box.ToBox(z);
  EXPECT_TRUE(box.ToBox(box.FromBox(x)).isApprox(x, 1e-12));
  EXPECT_EQ(x[4], 3.0);
  const double h = 1e-6;
  for (int j = 0; j < 5; ++j) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(5, j);
    const double numeric = (box.ToBox(z + step)[j] - box.ToBox(z - step)[j]) / (2 * h);
    EXPECT_NEAR(box.Slope(z)[j], numeric, 1e-8) << j;
  }
  EXPECT_EQ(box.ToBox(Vector({1e3, 0, 0, 0, 0})).cwiseMin(Vector({4, 0, 2, 5, 3}))[3], 5.0);
}

TEST(OptionText, TellsTheNearestOfMany) {
  std::vector<std::string> valid;
  for (char c = 'a'; c < 'z'; ++c) valid.push_back(std::string("option_") + c);
  valid.push_back("max_iter");
  EXPECT_THAT(opt::UnknownOption("ipopt", "max_itr", valid), HasSubstr("(nearest: max_iter, "));
  EXPECT_EQ(opt::UnknownOption("s", "x", {"a", "b"}), "s: unknown option `x` (valid: a, b).");
  EXPECT_EQ(opt::ParseNumber("1e-3"), 1e-3);
  EXPECT_FALSE(opt::ParseNumber("1e-3 "));
  EXPECT_FALSE(opt::ParseNumber(""));
  EXPECT_FALSE(opt::ParseInteger("1.5"));
  EXPECT_EQ(opt::ParseInteger("-7"), -7);
}

}  // namespace
}  // namespace halfstep::testing
