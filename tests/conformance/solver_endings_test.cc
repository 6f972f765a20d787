#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "opt/adapters/solver_registry.h"
#include "opt/problem/problem_derivatives.h"
#include "tests/problems/constructed_problems.h"
#include "tests/problems/hock_schittkowski.h"
#include "tests/problems/solver_test.h"

// How every solver ends where things go wrong: with a true status and a sentence.

namespace halfstep::testing {
namespace {

using opt::Ending;
using ::testing::AnyOf;
using ::testing::HasSubstr;

/// HS65 with finite bounds, whose cost calls `hook` with the number of the evaluation, from 1.
struct Hooked {
  explicit Hooked(std::function<void(int)> hook)
      : problem(ProblemBuilder(Vector({-5, 5, 0}), Vector({-4.5, -4.5, -5}), Vector({4.5, 4.5, 5}))
                    .Minimize([this, hook](const auto& x) {
                      hook(++evaluations);
                      return (x[0] - x[1]) * (x[0] - x[1]) + (x[2] - 5.0) * (x[2] - 5.0) +
                             (x[0] + x[1] - 10.0) * (x[0] + x[1] - 10.0) / 9.0;
                    })
                    .Build()) {}
  Hooked(const Hooked&) = delete;

  int evaluations = 0;
  opt::Problem problem;
};

class SolverEndings : public SolverTest {};

TEST_P(SolverEndings, InfeasibleProblemIsNeverSolved) {
  ExpectInfeasible(solver(), InfeasibleProblem(), 0.5);  // the sets are 1 apart
}

TEST_P(SolverEndings, UnboundedProblemEndsAtALimit) {
  const opt::Problem problem = UnboundedProblem();
  if (!solver().WhyUnsupported(problem).empty()) GTEST_SKIP();
  opt::SolverOptions options;
  options.max_evaluations = 3000;
  options.max_iterations = 200;
  const opt::Solution solution = solver().Solve(problem, problem.initial(), options);
  SCOPED_TRACE(solution.BriefReport());
  ExpectTrue(problem, options, solution);
  EXPECT_THAT(solution.ending, AnyOf(Ending::kLimit, Ending::kFailed));
  EXPECT_LE(solution.cost, -2.0);  // no worse than the start
}

TEST_P(SolverEndings, NanAtTheStartIsInvalidInput) {
  const opt::Problem problem = NanAtStart();
  const opt::Solution solution = solver().Solve(problem, problem.initial(), {});
  EXPECT_EQ(solution.ending, Ending::kInvalidInput) << solution.BriefReport();
  EXPECT_THAT(solution.message, HasSubstr("cost is not finite"));

  const opt::Solution of_nan = solver().Solve(problem, Constant(2, std::nan("")), {});
  EXPECT_EQ(of_nan.ending, Ending::kInvalidInput);
  EXPECT_THAT(of_nan.message, HasSubstr("x[0]"));
}

TEST_P(SolverEndings, CostThatIsNanEverywhereElseDoesNotSpin) {
  const opt::Problem problem =
      ProblemBuilder(Constant(2, 0.5), Constant(2, -1.0), Constant(2, 1.0))
          .Minimize([](const auto& x) {
            using std::sqrt;
            return x[0] + sqrt(-1e-12 - (x[0] - 0.5) * (x[0] - 0.5) + 2e-12);
          })
          .Build();
  opt::SolverOptions options;
  options.max_evaluations = 500;
  const opt::Solution solution = solver().Solve(problem, problem.initial(), options);
  SCOPED_TRACE(solution.BriefReport());
  ExpectTrue(problem, options, solution);
  EXPECT_NE(solution.ending, Ending::kConverged);
  EXPECT_NEAR(solution.x[0], 0.5, 1e-5);
}

TEST_P(SolverEndings, ExceptionInACallbackIsKept) {
  for (const int when : {1, 2, 4}) {
    Hooked hooked([when](int evaluation) {
      if (evaluation >= when) throw std::runtime_error("the leg fell off");
    });
    const opt::Solution solution = solver().Solve(hooked.problem, hooked.problem.initial(), {});
    EXPECT_EQ(solution.ending, Ending::kFailed) << solution.BriefReport();
    EXPECT_THAT(solution.message, HasSubstr("the leg fell off"));
    ASSERT_TRUE(solution.exception);
    EXPECT_THROW(std::rethrow_exception(solution.exception), std::runtime_error);
    EXPECT_EQ(hooked.evaluations, when) << "evaluated again after the exception";
  }
}

TEST_P(SolverEndings, ThrownIntegersAreKeptAsWell) {
  Hooked hooked([](int evaluation) {
    if (evaluation == 3) throw 7;
  });
  const opt::Solution solution = solver().Solve(hooked.problem, hooked.problem.initial(), {});
  EXPECT_EQ(solution.ending, Ending::kFailed);
  EXPECT_THROW(std::rethrow_exception(solution.exception), int);
}

TEST_P(SolverEndings, DeadlineIsKeptWithinOneEvaluation) {
  Hooked hooked([](int) { std::this_thread::sleep_for(std::chrono::milliseconds(2)); });
  opt::SolverOptions options;
  options.deadline = 1e-3;
  const opt::Solution solution = solver().Solve(hooked.problem, hooked.problem.initial(), options);
  EXPECT_EQ(solution.ending, Ending::kDeadline) << solution.BriefReport();
  EXPECT_EQ(hooked.evaluations, 1);
  ExpectTrue(hooked.problem, options, solution);
}

TEST_P(SolverEndings, StopTokenIsHeardBeforeTheNextEvaluation) {
  for (const int when : {1, 3, 6}) {
    std::stop_source source;
    Hooked hooked([&source, when](int evaluation) {
      if (evaluation == when) source.request_stop();
    });
    opt::SolverOptions options;
    options.stop = source.get_token();
    const opt::Solution solution =
        solver().Solve(hooked.problem, hooked.problem.initial(), options);
    EXPECT_EQ(solution.ending, Ending::kInterrupted) << solution.BriefReport();
    EXPECT_EQ(hooked.evaluations, when);
  }
}

TEST_P(SolverEndings, OnIterateStopsAtIterationThree) {
  const ProblemCard card = Hs65();
  const ProblemCard unconstrained{
      "bounds only", "",
      ProblemBuilder(Vector({-1.2, 1}), Constant(2, -3.0), Constant(2, 3.0))
          .Minimize([](const auto& x) {
            return 100.0 * (x[1] - x[0] * x[0]) * (x[1] - x[0] * x[0]) +
                   (1.0 - x[0]) * (1.0 - x[0]);
          })
          .Build(),
      0.0};
  for (const ProblemCard* each : {&card, &unconstrained}) {
    if (!solver().WhyUnsupported(each->problem).empty()) continue;
    std::vector<int> seen;
    opt::SolverOptions options;
    options.on_iterate = [&](const opt::Iterate& iterate) {
      EXPECT_EQ(iterate.cost, each->problem.Cost(iterate.x));
      EXPECT_EQ(iterate.violation, each->problem.MaxViolation(iterate.x).amount);
      seen.push_back(iterate.iteration);
      return iterate.iteration < 3;
    };
    const opt::Solution solution = solver().Solve(each->problem, each->problem.initial(), options);
    SCOPED_TRACE(solution.BriefReport());
    EXPECT_EQ(solution.ending, Ending::kInterrupted);
    EXPECT_THAT(seen, ::testing::ElementsAre(0, 1, 2, 3));
    EXPECT_EQ(solution.iterations, 3);
    EXPECT_EQ(solution.history.size(), 4u);
    ExpectTrue(each->problem, options, solution);
  }
}

TEST_P(SolverEndings, ExceptionInOnIterateIsKept) {
  opt::SolverOptions options;
  options.on_iterate = [](const opt::Iterate& iterate) -> bool {
    if (iterate.iteration == 1) throw std::runtime_error("observer");
    return true;
  };
  Hooked hooked([](int) {});
  const opt::Solution solution = solver().Solve(hooked.problem, hooked.problem.initial(), options);
  EXPECT_EQ(solution.ending, Ending::kFailed) << solution.BriefReport();
  EXPECT_TRUE(solution.exception);
}

std::string KnownOption(const std::string& solver) {
  if (solver == "ipopt" || solver == "halfstep/barrier") return "mu_init";
  if (solver == "halfstep/sqp") return "radius";
  return solver == "ceres/auglag" ? "max_lbfgs_rank" : "xtol_abs";
}

TEST_P(SolverEndings, WrongOptionsAreInvalidInput) {
  Hooked hooked([](int) {});
  opt::SolverOptions options;
  options.solver_options = {{"no_such_option", "1"}};
  opt::Solution solution = solver().Solve(hooked.problem, hooked.problem.initial(), options);
  EXPECT_EQ(solution.ending, Ending::kInvalidInput);
  EXPECT_THAT(solution.message, HasSubstr("no_such_option"));
  EXPECT_THAT(solution.message, AnyOf(HasSubstr("valid: "), HasSubstr("nearest: ")));
  EXPECT_EQ(hooked.evaluations, 1) << "nothing is optimized";

  const std::string known = KnownOption(GetParam());
  options.solver_options = {{known, "much"}};
  solution = solver().Solve(hooked.problem, hooked.problem.initial(), options);
  EXPECT_EQ(solution.ending, Ending::kInvalidInput);
  EXPECT_THAT(solution.message, HasSubstr(known + " = much"));

  options.solver_options = {};
  options.feasibility_tolerance = 0.0;
  solution = solver().Solve(hooked.problem, hooked.problem.initial(), options);
  EXPECT_EQ(solution.ending, Ending::kInvalidInput);
  EXPECT_THAT(solution.message, HasSubstr("feasibility_tolerance"));
}

/// HS65's ball with a gradient of the wrong sign in x₁.
class WrongBall : public opt::ConstraintBlock {
 public:
  std::string name() const override { return "ball"; }
  std::string unit() const override { return "m²"; }
  int rows() const override { return 1; }
  const opt::SparsityPattern& pattern() const override { return pattern_; }
  Eigen::VectorXd lower() const override { return Vector({-kInfinity}); }
  Eigen::VectorXd upper() const override { return Vector({48}); }
  void Evaluate(const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> values) const override {
    values[0] = x.squaredNorm();
  }
  void Jacobian(const Eigen::VectorXd& x, std::span<double> nonzeros) const override {
    nonzeros[0] = 2.0 * x[0];
    nonzeros[1] = -2.0 * x[1];
    nonzeros[2] = 2.0 * x[2];
  }

 private:
  opt::SparsityPattern pattern_{{0, 0, 0}, {0, 1, 2}};
};

TEST_P(SolverEndings, WrongGradientIsForTheCheckerButTheSolutionStaysTrue) {
  Hooked hooked([](int) {});
  hooked.problem.AddConstraint(std::make_unique<WrongBall>());
  if (!solver().WhyUnsupported(hooked.problem).empty()) GTEST_SKIP();
  const opt::ProblemDerivativeReport check =
      opt::CheckDerivatives(hooked.problem, Vector({1, 2, 3}));
  EXPECT_FALSE(check.Passed(1e-3));
  EXPECT_THAT(check.message, HasSubstr("ball[0] with respect to x[1]"));

  opt::SolverOptions options;
  options.max_evaluations = 2000;
  const opt::Solution solution = solver().Solve(hooked.problem, hooked.problem.initial(), options);
  SCOPED_TRACE(solution.BriefReport());
  ExpectTrue(hooked.problem, options, solution);
}

TEST_P(SolverEndings, AcceptedOptionsAreReported) {
  Hooked hooked([](int) {});
  const std::string known = KnownOption(GetParam());
  opt::SolverOptions options;
  options.max_evaluations = 100;
  options.solver_options = {{known, "5"}};
  const opt::Solution solution = solver().Solve(hooked.problem, hooked.problem.initial(), options);
  EXPECT_EQ(solution.requested_options, options.solver_options);
  ASSERT_TRUE(solution.used_options.contains(known));
  EXPECT_EQ(std::stod(solution.used_options.at(known)), 5.0);
}

TEST_P(SolverEndings, EvaluationLimitIsKept) {
  Hooked hooked([](int) {});
  opt::SolverOptions options;
  options.max_evaluations = 3;
  const opt::Solution solution = solver().Solve(hooked.problem, hooked.problem.initial(), options);
  EXPECT_EQ(solution.ending, Ending::kLimit) << solution.BriefReport();
  EXPECT_LE(solution.cost_evaluations, 4);
  EXPECT_THROW((void)solver().Solve(hooked.problem, Constant(2, 0.0), options), std::logic_error);
}

TEST_P(SolverEndings, CountedAlgebraRepeatsItselfAndEndsASolve) {
  const ProblemCard card = Hs35();
  if (!solver().WhyUnsupported(card.problem).empty()) GTEST_SKIP();
  opt::SolverOptions options;
  options.max_evaluations = 2000;
  const auto solve = [&] { return solver().Solve(card.problem, card.problem.initial(), options); };
  const opt::Solution free = solve();
  EXPECT_EQ(solve().linear_algebra, free.linear_algebra);
  // What never asks for a Jacobian counts nothing.
  EXPECT_EQ(free.linear_algebra > 0, free.jacobian_evaluations > 0);

  long told = 0;
  int refusals = 0;
  options.may_go_on = [&](long linear_algebra) {
    EXPECT_GE(linear_algebra, told);
    told = linear_algebra;
    if (told == 0 && free.linear_algebra > 0) return true;
    ++refusals;
    return false;
  };
  const opt::Solution limited = solve();
  SCOPED_TRACE(limited.BriefReport());
  EXPECT_GT(refusals, 0);
  EXPECT_EQ(limited.ending, Ending::kLimit);
  EXPECT_THAT(limited.message, HasSubstr("effort"));
  EXPECT_EQ(limited.linear_algebra, told) << "no work after the refusal";
  EXPECT_LE(limited.linear_algebra, free.linear_algebra);
  ExpectTrue(card.problem, options, limited);
}

TEST_P(SolverEndings, ADeadlineOfZeroIsMetBeforeTheSolver) {
  Hooked hooked([](int) {});
  opt::SolverOptions options;
  options.deadline = 0.0;
  const opt::Solution solution = solver().Solve(hooked.problem, hooked.problem.initial(), options);
  EXPECT_EQ(solution.ending, Ending::kDeadline) << solution.BriefReport();
  EXPECT_EQ(hooked.evaluations, 1) << "the start only";
}

TEST_P(SolverEndings, AStopBeforehandInterrupts) {
  std::stop_source source;
  source.request_stop();
  Hooked hooked([](int) {});
  opt::SolverOptions options;
  options.stop = source.get_token();
  const opt::Solution solution = solver().Solve(hooked.problem, hooked.problem.initial(), options);
  EXPECT_EQ(solution.ending, Ending::kInterrupted) << solution.BriefReport();
  EXPECT_EQ(hooked.evaluations, 1) << "the start only";
}

TEST_P(SolverEndings, OneIterationIsALimit) {
  Hooked hooked([](int) {});
  opt::SolverOptions options;
  options.max_iterations = 1;
  options.max_evaluations = 6;  // NLopt tells no iterations
  const opt::Solution solution = solver().Solve(hooked.problem, hooked.problem.initial(), options);
  // NLopt's separable approximations are at the optimum within the evaluations allowed.
  if (solution.ending == Ending::kConverged) {
    EXPECT_LE(solution.stationarity, 1e-5) << solution.BriefReport();
    return;
  }
  EXPECT_EQ(solution.ending, Ending::kLimit) << solution.BriefReport();
}

TEST_P(SolverEndings, AnUnsupportedProblemIsInvalidInput) {
  int refused = 0;
  for (const ProblemCard& card : {Hs6(), Hs35()}) {  // an equality; an inequality
    const std::string why = solver().WhyUnsupported(card.problem);
    if (why.empty()) continue;
    ++refused;
    const opt::Solution solution = solver().Solve(card.problem, card.problem.initial(), {});
    EXPECT_EQ(solution.ending, Ending::kInvalidInput) << solution.BriefReport();
    EXPECT_EQ(solution.message, why);
    EXPECT_EQ(solution.cost_evaluations, 0);
  }
  if (GetParam() == "nlopt/bobyqa") {
    EXPECT_EQ(refused, 2);
  }
}

/// Variable 1 is fixed at 1, the start is elsewhere; the optimum is (2, 1, 0), of 2.
opt::Problem WithAFixedVariable(bool row) {
  ProblemBuilder builder(Vector({0.5, -0.84, 1}), Vector({-4, 1, -4}),
                         Vector({row ? 4.0 : 2.0, 1, 4}));
  builder.Minimize([](const auto& x) {
    return (x[0] - 3.0) * (x[0] - 3.0) + (x[1] - 2.0) * (x[1] - 2.0) + x[2] * x[2];
  });
  if (row)
    builder.Row(
        "sum", -kInfinity, [](const auto& x) { return x[0] + x[1]; }, 3.0);
  return builder.Build();
}

TEST_P(SolverEndings, ConvergedHoldsWithAFixedVariable) {
  for (const bool row : {false, true}) {
    const opt::Problem problem = WithAFixedVariable(row);
    if (!solver().WhyUnsupported(problem).empty()) continue;
    opt::SolverOptions options;
    options.max_evaluations = 5000;
    const opt::Solution solution = solver().Solve(problem, problem.initial(), options);
    SCOPED_TRACE(solution.BriefReport());
    ExpectTrue(problem, options, solution);
    if (solution.ending != Ending::kConverged) continue;
    EXPECT_NEAR(solution.x[1], 1.0, options.feasibility_tolerance);
    EXPECT_NEAR(solution.cost, 2.0, 1e-3);
    EXPECT_LE(solution.final_violation, options.feasibility_tolerance);
    EXPECT_NEAR(solution.final_cost, 2.0, 1e-2);
  }
}

INSTANTIATE_TEST_SUITE_P(Solvers, SolverEndings, ::testing::ValuesIn(opt::SolverNames()),
                         SolverTestName);

}  // namespace
}  // namespace halfstep::testing
