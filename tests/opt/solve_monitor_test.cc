#include "opt/solvers/solve_monitor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/problems/hock_schittkowski.h"

namespace halfstep::opt {
namespace {

// On the ray through (1, 1, 1), where the ball ends at (4, 4, 4), so far outside that its row is
// violated by `violation`.
Eigen::VectorXd Outside(double violation) {
  return Eigen::VectorXd::Constant(3, std::sqrt((48.0 + violation) / 3.0));
}

Solution EndedAt(const Eigen::VectorXd& x, const SolverOptions& options) {
  const testing::ProblemCard card = testing::Hs65();
  SolveMonitor monitor(card.problem, options, SolveMonitor::Iterations::kImprovements);
  EXPECT_TRUE(monitor.Begin(x));
  return monitor.Finish(Ending::kConverged, "claimed", x);
}

// A claim of success counts as far as x is feasible to the tolerance asked for, and no farther.
TEST(SolveMonitor, FeasibleIsToTheToleranceAskedFor) {
  for (const double tolerance : {1e-6, 1e-3}) {
    SolverOptions options;
    options.feasibility_tolerance = tolerance;
    const Solution within = EndedAt(Outside(0.9 * tolerance), options);
    EXPECT_TRUE(within.feasible);
    const Solution beyond = EndedAt(Outside(1.1 * tolerance), options);
    EXPECT_FALSE(beyond.feasible);
    EXPECT_NE(beyond.ending, Ending::kConverged);
    EXPECT_NEAR(beyond.max_violation, 1.1 * tolerance, 1e-9);
  }
}

// Of two points the feasible one is better, whatever they cost.
TEST(SolveMonitor, KeepsTheCheapestFeasiblePoint) {
  const testing::ProblemCard card = testing::Hs65();
  const SolverOptions options;
  SolveMonitor monitor(card.problem, options, SolveMonitor::Iterations::kImprovements);
  const Eigen::VectorXd feasible = Outside(-1.0), cheaper = Outside(1e-4);
  ASSERT_TRUE(monitor.Begin(feasible));
  double cost = 0.0, of_feasible = 0.0;
  Eigen::VectorXd values;
  ASSERT_TRUE(monitor.Cost(cheaper, &cost) && monitor.Constraints(cheaper, &values));
  ASSERT_TRUE(monitor.Cost(feasible, &of_feasible));
  ASSERT_LT(cost, of_feasible);
  const Solution solution = monitor.Finish(Ending::kConverged, "claimed", cheaper);
  EXPECT_EQ(solution.x, feasible);
  EXPECT_TRUE(solution.feasible);
  EXPECT_NE(solution.ending, Ending::kConverged);
}

// That the best point seen is an optimum does not make a success of an end elsewhere.
TEST(SolveMonitor, ASuccessThatEndedInfeasibleIsNone) {
  const testing::ProblemCard card = testing::Hs65();
  const SolverOptions options;
  SolveMonitor monitor(card.problem, options, SolveMonitor::Iterations::kImprovements);
  const Eigen::Vector3d optimum(3.6504618, 3.6504617, 4.6204170);
  ASSERT_TRUE(monitor.Begin(optimum));
  const Solution solution = monitor.Finish(Ending::kConverged, "claimed", 1.001 * optimum);
  EXPECT_EQ(solution.x, optimum);
  EXPECT_LT(solution.stationarity, 1e-3);
  EXPECT_NE(solution.ending, Ending::kConverged);
}

}  // namespace
}  // namespace halfstep::opt
