#include "opt/solvers/elastic_subproblem.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace halfstep::opt {
namespace {

using Eigen::VectorXd;

// Rows over neighbouring variables, some of which no step within the bounds can keep.
ElasticSubproblem Drawn(const LimitedMemoryHessian& hessian, int n, std::mt19937* draw,
                        Eigen::SparseMatrix<double>* A) {
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::vector<Eigen::Triplet<double>> entries;
  const int m = 3 * (n - 2);
  for (int row = 0; row < m; ++row) {
    for (int v = row / 3; v < row / 3 + 3; ++v) entries.emplace_back(row, v, number(*draw));
  }
  A->resize(m, n);
  A->setFromTriplets(entries.begin(), entries.end());
  const auto vector = [&](int size) {
    VectorXd drawn(size);
    for (double& x : drawn) x = number(*draw);
    return drawn;
  };
  const VectorXd low = vector(n), high = vector(n);
  return {.hessian = hessian,
          .g = vector(n),
          .A = *A,
          .c = vector(m),
          .lower = -0.1 - low.array().abs(),
          .upper = 0.1 + high.array().abs(),
          .penalty = VectorXd::Constant(m, 2.0)};
}

double Cost(const ElasticSubproblem& p, const VectorXd& d) {
  return p.g.dot(d) + 0.5 * d.dot(p.hessian.Times(d)) +
         p.penalty.dot((-p.c - p.A * d).cwiseMax(0.0));
}

// Without curvature and with some.
std::vector<LimitedMemoryHessian> Hessians(int n) {
  LimitedMemoryHessian flat(0), curved(4);
  for (int k = 0; k < 3; ++k) {
    const VectorXd s = VectorXd::Unit(n, k) + VectorXd::Unit(n, k + 1);
    curved.Update(s, (1.0 + k) * s);
  }
  return {flat, curved};
}

// The dual function of the rows' duals bounds every step's cost from below: for B = 0 it is
// −cᵀz + Σ_j min over the bounds of (g − Aᵀz)_j d_j, and for B ≥ 0 the tangent at d serves.
double LowerBound(const ElasticSubproblem& p, const ElasticStep& step) {
  const VectorXd Bd = p.hessian.Times(step.d);
  const VectorXd slope = p.g + Bd - p.A.transpose() * step.duals;
  return -p.c.dot(step.duals) - 0.5 * step.d.dot(Bd) +
         slope.cwiseProduct(p.lower).cwiseMin(slope.cwiseProduct(p.upper)).sum();
}

TEST(ElasticSubproblem, TheExactStepAndItsDualsProveEachOther) {
  const int n = 30;
  Eigen::SparseMatrix<double> A;
  std::mt19937 draw(11);
  for (const LimitedMemoryHessian& hessian : Hessians(n)) {
    for (int k = 0; k < 20; ++k) {
      const ElasticSubproblem p = Drawn(hessian, n, &draw, &A);
      const ElasticStep step = Solve(p);
      EXPECT_TRUE((step.d.array() >= p.lower.array()).all());
      EXPECT_TRUE((step.d.array() <= p.upper.array()).all());
      EXPECT_GE(step.duals.minCoeff(), 0.0);
      EXPECT_TRUE((step.duals.array() <= p.penalty.array()).all());
      EXPECT_LE(Cost(p, step.d) - LowerBound(p, step), 1e-6);
      EXPECT_GE(Cost(p, step.d) - LowerBound(p, step), -1e-12);
      EXPECT_GT(step.linear_algebra, 0);
    }
  }
}

// A looser step costs what it may more, as the bound says that it returns, and takes less work.
TEST(ElasticSubproblem, ALooseStepIsWithinItsGap) {
  const int n = 30;
  Eigen::SparseMatrix<double> A;
  std::mt19937 draw(12);
  for (const LimitedMemoryHessian& hessian : Hessians(n)) {
    for (int k = 0; k < 20; ++k) {
      ElasticSubproblem p = Drawn(hessian, n, &draw, &A);
      const ElasticStep exact = Solve(p);
      const double least = Cost(p, exact.d), none = Cost(p, VectorXd::Zero(n));
      long work = exact.linear_algebra;
      for (const double gap : {1e-4, 1e-2, 1e-1}) {
        p.gap = gap;
        const ElasticStep loose = Solve(p);
        EXPECT_LE(Cost(p, loose.d) - least, loose.gap + 1e-12);
        EXPECT_LE(loose.gap, gap * (none - Cost(p, loose.d)) + 1e-12);
        EXPECT_LE(loose.linear_algebra, work);
        work = loose.linear_algebra;
      }
      EXPECT_LT(work, exact.linear_algebra);
    }
  }
}

// Without rows: to the bound that the slope points to.
TEST(ElasticSubproblem, WithoutRowsTheStepGoesToABound) {
  const LimitedMemoryHessian flat(0);
  const Eigen::SparseMatrix<double> none(0, 2);
  const Eigen::Vector2d g(1.0, -2.0);
  const ElasticStep step = Solve({.hessian = flat,
                                  .g = g,
                                  .A = none,
                                  .c = VectorXd(0),
                                  .lower = Eigen::Vector2d(-1.0, -1.0),
                                  .upper = Eigen::Vector2d(3.0, 2.0),
                                  .penalty = VectorXd(0)});
  EXPECT_LT((step.d - Eigen::Vector2d(-1.0, 2.0)).cwiseAbs().maxCoeff(), 1e-7);
}

}  // namespace
}  // namespace halfstep::opt
