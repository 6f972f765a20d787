#include "opt/problem/derivative_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace halfstep {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd Function(const VectorXd& x) {
  return Eigen::Vector3d(std::sin(x[0]) * x[1], x[0] * x[0] * x[0] + std::exp(x[1]), 1e3 * x[0]);
}

MatrixXd Jacobian(const VectorXd& x) {
  MatrixXd jacobian(3, 2);
  jacobian << std::cos(x[0]) * x[1], std::sin(x[0]), 3 * x[0] * x[0], std::exp(x[1]), 1e3, 0;
  return jacobian;
}

const VectorXd kPoint = Eigen::Vector2d(0.7, -1.3);

TEST(CheckJacobian, PassesACorrectOneFarBelowTheErrorOfAWrongOne) {
  const DerivativeReport report = CheckJacobian(Function, kPoint, Jacobian(kPoint));
  EXPECT_LT(report.worst_error, 1e-11);
  EXPECT_TRUE(report.Passed(1e-11));
  EXPECT_FALSE(report.Passed(0.0));  // differences are never exact
}

TEST(CheckJacobian, FourthOrderDifferencesAreExactForPolynomialsOfDegreeFour) {
  const auto quartic = [](const VectorXd& x) { return VectorXd(x.array().pow(4)); };
  const VectorXd x = VectorXd::Constant(1, 0.5);
  const MatrixXd exact = MatrixXd::Constant(1, 1, 0.5);
  EXPECT_LT(CheckJacobian(quartic, x, exact, 0.1).worst_error, 1e-14);
  const auto quintic = [](const VectorXd& y) { return VectorXd(y.array().pow(5)); };
  // Error of the formula: h⁴·f⁗'/30 = 4h⁴.
  const MatrixXd slope = MatrixXd::Constant(1, 1, 5.0 / 16);
  EXPECT_NEAR(CheckJacobian(quintic, x, slope, 0.1).numeric - 5.0 / 16, -4e-4, 1e-12);
}

TEST(CheckJacobian, NamesTheEntryThatIsOnePercentOff) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 2; ++j) {
      MatrixXd wrong = Jacobian(kPoint);
      wrong(i, j) = wrong(i, j) == 0 ? 1e-3 : 1.01 * wrong(i, j);
      const DerivativeReport report = CheckJacobian(Function, kPoint, wrong);
      EXPECT_FALSE(report.Passed(1e-6));
      EXPECT_EQ(report.row, i);
      EXPECT_EQ(report.column, j);
      EXPECT_EQ(report.analytic, wrong(i, j));
      EXPECT_NEAR(report.numeric, Jacobian(kPoint)(i, j), 1e-8);
      EXPECT_NE(report.Describe().find("row " + std::to_string(i)), std::string::npos);
    }
  }
}

TEST(CheckJacobian, CatchesAWrongSignAndSwappedColumns) {
  MatrixXd wrong = Jacobian(kPoint);
  wrong(0, 1) = -wrong(0, 1);
  EXPECT_FALSE(CheckJacobian(Function, kPoint, wrong).Passed(1e-3));
  wrong = Jacobian(kPoint).rowwise().reverse();
  EXPECT_FALSE(CheckJacobian(Function, kPoint, wrong).Passed(1e-3));
}

TEST(CheckJacobian, WhatIsNotFiniteNeverPasses) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (double bad : {nan, std::numeric_limits<double>::infinity()}) {
    MatrixXd jacobian = Jacobian(kPoint);
    jacobian(1, 0) = bad;
    const DerivativeReport report = CheckJacobian(Function, kPoint, jacobian);
    EXPECT_FALSE(report.finite);
    EXPECT_FALSE(report.Passed(1e9));
    EXPECT_EQ(report.row, 1);
    EXPECT_EQ(report.column, 0);
  }
  const auto broken = [&](const VectorXd& x) { return VectorXd(Function(x) * nan); };
  EXPECT_FALSE(CheckJacobian(broken, kPoint, Jacobian(kPoint)).Passed(1e9));
}

TEST(CheckJacobian, RefusesSizesThatDoNotMatch) {
  EXPECT_THROW(CheckJacobian(Function, kPoint, MatrixXd::Zero(3, 3)), std::logic_error);
  EXPECT_THROW(CheckJacobian(Function, kPoint, MatrixXd::Zero(2, 2)), std::logic_error);
}

}  // namespace
}  // namespace halfstep
