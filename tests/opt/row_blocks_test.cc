#include "opt/solvers/row_blocks.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace halfstep::opt {
namespace {

using Eigen::ArrayXd;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

constexpr int kLinks = 60, kWidth = 3;

// Rows over neighbouring links of a chain whose variables are shuffled, some with a column left
// out; with `common`, a last variable is in every row.
SparseMatrix Chain(bool common, std::mt19937* draw) {
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const int n = kLinks * kWidth;
  std::vector<int> shuffled(static_cast<size_t>(n));
  std::iota(shuffled.begin(), shuffled.end(), 0);
  std::shuffle(shuffled.begin(), shuffled.end(), *draw);
  std::vector<Eigen::Triplet<double>> entries;
  int row = 0;
  for (int link = 0; link + 1 < kLinks; ++link) {
    for (int k = 0; k < 7; ++k, ++row) {
      for (int v = link * kWidth; v < (link + 2) * kWidth; ++v) {
        if (v % 7 == k) continue;
        entries.emplace_back(row, shuffled[static_cast<size_t>(v)], number(*draw));
      }
      if (common) entries.emplace_back(row, n, 1.0);
    }
  }
  SparseMatrix A(row + 1, common ? n + 1 : n);  // the last row is empty
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

// All rows but the fifth.
std::vector<int> MostOf(const SparseMatrix& A) {
  std::vector<int> rows(static_cast<size_t>(A.rows()));
  std::iota(rows.begin(), rows.end(), 0);
  rows.erase(rows.begin() + 4);
  return rows;
}

class RowBlocksTest : public ::testing::TestWithParam<bool> {};

TEST_P(RowBlocksTest, ProductsAreThoseOfTheMatrix) {
  std::mt19937 draw(3);
  const SparseMatrix A = Chain(GetParam(), &draw);
  const RowBlocks blocks(A, MostOf(A));
  const std::vector<int>& rows = blocks.order();
  const std::vector<int> most = MostOf(A);
  ASSERT_TRUE(std::is_permutation(rows.begin(), rows.end(), most.begin(), most.end()));
  const VectorXd d = VectorXd::Random(A.cols());
  ArrayXd Ad;
  blocks.Times(d, &Ad);
  const VectorXd expected = A * d;
  EXPECT_LT((Ad.matrix() - expected(rows)).cwiseAbs().maxCoeff(), 1e-14);

  VectorXd z = VectorXd::Random(A.rows());
  z[4] = 0.0;
  VectorXd sum = VectorXd::Ones(A.cols());
  blocks.AddTransposed(z(rows), &sum);
  const VectorXd transposed = A.transpose() * z;
  EXPECT_LT((sum - transposed - VectorXd::Ones(A.cols())).cwiseAbs().maxCoeff(), 1e-14);
}

TEST_P(RowBlocksTest, TheGramMatrixIsSolvedAsADenseOne) {
  std::mt19937 draw(4);
  const SparseMatrix A = Chain(GetParam(), &draw);
  const RowBlocks blocks(A, MostOf(A));
  EnvelopeMatrix K = blocks.MakeGram();
  VectorXd theta = VectorXd::Random(A.rows()).cwiseAbs();
  theta[4] = 0.0;
  const VectorXd diagonal = VectorXd::Random(A.cols()).cwiseAbs().array() + 0.1;
  const Eigen::MatrixXd dense = Eigen::MatrixXd(A.transpose() * theta.asDiagonal() * A) +
                                Eigen::MatrixXd(diagonal.asDiagonal());
  const VectorXd right = VectorXd::Random(A.cols());
  for (int again = 0; again < 2; ++again) {
    K.SetZero();
    blocks.AddGram(theta(blocks.order()), &K);
    K.AddDiagonal(diagonal);
    ASSERT_TRUE(K.Factorize());
    EXPECT_LT((K.Solve(right) - dense.llt().solve(right)).cwiseAbs().maxCoeff(), 1e-10);
  }
  K.SetZero();
  K.AddDiagonal(-diagonal);
  EXPECT_FALSE(K.Factorize());
}

// The band is found although variables are shuffled, and a variable of every row does not fill it.
TEST_P(RowBlocksTest, AChainHasANarrowEnvelope) {
  std::mt19937 draw(5);
  const SparseMatrix A = Chain(GetParam(), &draw);
  EXPECT_LE(RowBlocks(A, MostOf(A)).MakeGram().multiplications(), 9 * kWidth * kWidth * A.cols());
}

INSTANTIATE_TEST_SUITE_P(WithoutAndWithACommonVariable, RowBlocksTest, ::testing::Bool());

}  // namespace
}  // namespace halfstep::opt
