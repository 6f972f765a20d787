#include "opt/solvers/barrier_terms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "opt/problem/derivative_check.h"

namespace halfstep::opt {
namespace {

using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMu = 0.05;

// Sides: 0 ≤ v0 ≤ 1, v1 ≥ −1, v2 ≤ 3; v3 is fixed.
BarrierTerms Terms(bool may_be_outside) {
  return {VectorXd{{0.0, -1.0, -kInfinity, 2.0}}, VectorXd{{1.0, kInfinity, 3.0, 2.0}},
          may_be_outside};
}

TEST(BarrierTerms, FixedValuesAndInfiniteBoundsHaveNoSide) { EXPECT_EQ(Terms(true).size(), 4u); }

TEST(BarrierTerms, GradientWithCentralMultipliersIsThatOfTheMerit) {
  const BarrierTerms terms = Terms(true);
  for (const VectorXd& here : {VectorXd{{0.2, 0.5, 1.0, 2.0}}, VectorXd{{0.7, -2.0, 4.0, 2.0}}}) {
    VectorXd gradient = VectorXd::Zero(here.size());
    terms.AddGradient(here, terms.CentralMultipliers(here, kMu), &gradient);
    const DerivativeReport report = CheckJacobian(
        [&](const VectorXd& there) {
          return VectorXd{{terms.AddedToMerit(5.0, here, there, kMu)}};
        },
        here, gradient.transpose());
    EXPECT_TRUE(report.Passed(1e-8)) << report.Describe();
  }
}

TEST(BarrierTerms, LeavingTheInsideIsNoMerit) {
  const VectorXd inside{{0.2, 0.5, 1.0, 2.0}}, outside{{0.2, -1.5, 1.0, 2.0}};
  const BarrierTerms terms = Terms(true);
  EXPECT_FALSE(terms.AnyOutside(inside));
  EXPECT_TRUE(terms.AnyOutside(outside));
  EXPECT_EQ(terms.AddedToMerit(0.0, inside, outside, kMu), kInfinity);
  EXPECT_LT(terms.AddedToMerit(0.0, outside, inside, kMu),
            terms.AddedToMerit(0.0, outside, outside, kMu));
  EXPECT_TRUE(std::isfinite(terms.AddedToMerit(0.0, outside, outside, kMu)));
}

TEST(BarrierTerms, LongestStepLeavesAHundredthOfTheTightestSlack) {
  const VectorXd here{{0.2, 0.5, 1.0, 2.0}}, change{{-1.0, -2.0, 40.0, 0.0}};
  const double alpha = Terms(false).StepLimit(here, change);
  const VectorXd there = here + alpha * change;
  EXPECT_NEAR(3.0 - there[2], 0.01 * 2.0, 1e-12);
  EXPECT_EQ(Terms(false).StepLimit(here, 1e-3 * change), 1.0);
}

TEST(BarrierTerms, NewtonStepsBringMultipliersToTheCentralOnes) {
  const VectorXd here{{0.2, 0.5, 1.0, 2.0}};
  BarrierTerms terms = Terms(false);
  EXPECT_GT(terms.ComplementarityError(here, kMu), 0.1);
  terms.AdvanceMultipliers(here, VectorXd::Zero(4), kMu, 0.5);
  EXPECT_GT(terms.ComplementarityError(here, kMu), 0.1);
  terms.AdvanceMultipliers(here, VectorXd::Zero(4), kMu, 1.0);
  EXPECT_NEAR(terms.ComplementarityError(here, kMu), 0.0, 1e-12);
  VectorXd curvature = VectorXd::Zero(4);
  terms.AddCurvature(here, &curvature);
  EXPECT_NEAR(curvature[0], kMu / (0.2 * 0.2) + kMu / (0.8 * 0.8), 1e-12);
  EXPECT_EQ(curvature[3], 0.0);
}

TEST(BarrierTerms, MultipliersAreKeptWithinAMillionTimesTheCentralOnes) {
  const VectorXd here{{0.2, 0.5, 1.0, 2.0}};
  BarrierTerms terms = Terms(false);
  terms.ClampMultipliers(here, 1e-9);
  const VectorXd central = terms.CentralMultipliers(here, 1e-9);
  for (Eigen::Index i = 0; i < central.size(); ++i) {
    EXPECT_DOUBLE_EQ(terms.multipliers()[i], 1e6 * central[i]);
  }
}

}  // namespace
}  // namespace halfstep::opt
