#include "opt/problem/stationarity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/problems/constructed_problems.h"
#include "tests/problems/hock_schittkowski.h"

namespace halfstep::testing {
namespace {

opt::Stationarity At(const opt::Problem& problem, const Eigen::VectorXd& x) {
  return opt::EstimateMultipliers(problem, x, problem.Gradient(x), problem.Constraints(x),
                                  problem.Jacobian(x));
}

TEST(Stationarity, RecoversTheMultipliersOfAConstructedProblem) {
  const int n = 50;
  const ProblemCard card = BandedLinear(n);
  Eigen::VectorXd best(n);
  for (int i = 0; i < n; ++i) best[i] = 0.5 + 0.3 * std::sin(1.7 * i);
  const opt::Stationarity there = At(card.problem, best);
  EXPECT_LT(there.residual, 1e-6);
  for (int i = 0; i + 1 < n; ++i) {
    EXPECT_NEAR(there.multipliers[i], 1.0 + 0.5 * std::cos(0.9 * i), 1e-3) << i;
  }
  EXPECT_TRUE(there.bound_multipliers.isZero());
  EXPECT_GT(At(card.problem, 0.9 * best).residual, 0.5);
}

TEST(Stationarity, SignsFollowTheActiveSide) {
  // Largest box: x₀ and x₁ at their upper bounds, the girth at its lower one.
  const ProblemCard card = Hs36();
  const opt::Stationarity there = At(card.problem, Vector({20, 11, 15}));
  EXPECT_LT(there.residual, 1e-9);
  EXPECT_NEAR(there.multipliers[0], -110.0, 1e-6);  // ∂f/∂x₂ = −220 = λ·2
  EXPECT_NEAR(there.bound_multipliers[0], 55.0, 1e-6);
  EXPECT_NEAR(there.bound_multipliers[1], 80.0, 1e-6);
  EXPECT_EQ(there.bound_multipliers[2], 0.0);
}

// A statement near its limit that no variable moves: what differences of roundings are left of its
// derivatives explain nothing.
TEST(Stationarity, ARowWithoutSlopeGetsNoMultiplier) {
  const ProblemCard card = Hs36();
  const Eigen::VectorXd x = Vector({20, 11, 15});
  std::vector<double> jacobian = card.problem.Jacobian(x);
  for (double& derivative : jacobian) derivative *= 1e-13;
  const opt::Stationarity there = opt::EstimateMultipliers(
      card.problem, x, card.problem.Gradient(x), card.problem.Constraints(x), jacobian);
  EXPECT_EQ(there.multipliers[0], 0.0);
  EXPECT_GT(there.residual, 0.1);
}

TEST(Stationarity, AWrongSignIsNoMultiplier) {
  // Minimizing x on x ≥ 0 is stationary at 0; maximizing is not.
  for (const double sign : {1.0, -1.0}) {
    const opt::Problem problem = ProblemBuilder(Vector({0}), Vector({0}), Vector({kInfinity}))
                                     .Minimize([sign](const auto& x) { return sign * x[0]; })
                                     .Build();
    EXPECT_EQ(At(problem, Vector({0})).residual, sign > 0 ? 0.0 : 1.0);
  }
}

}  // namespace
}  // namespace halfstep::testing
