#pragma once

#include <Eigen/Core>
#include <vector>

namespace halfstep::opt {

/// A symmetric positive definite matrix (n×n) whose variables are ordered so that each row of its
/// lower triangle begins near the diagonal; what lies between a row's first entry and its diagonal
/// is stored, without indices, and takes the Cholesky factor. Source: [George1981], chapter 4.
class EnvelopeMatrix {
 public:
  /// `positions[v]`: the row of variable v (n); `first[p]` ≤ p: where row p begins (n).
  EnvelopeMatrix(std::vector<int> positions, std::vector<int> first);

  void SetZero();  ///< all entries
  /// The entries of row p from column `first[p]` on: entry (p, q) is Row(p)[q].
  double* Row(int p) { return entries_.data() + offset_[static_cast<size_t>(p)]; }
  /// Adds to the diagonal, by variable (n).
  void AddDiagonal(const Eigen::ArrayXd& diagonal);
  /// The row of a variable.
  int PositionOf(int variable) const { return positions_[static_cast<size_t>(variable)]; }

  /// Puts the Cholesky factor in the place of the matrix. False: it is not positive definite.
  bool Factorize();
  /// The inverse times `right` (n), by variable, after Factorize.
  Eigen::VectorXd Solve(const Eigen::VectorXd& right) const;
  /// What Factorize takes.
  long multiplications() const { return multiplications_; }

 private:
  const double* Row(int p) const { return entries_.data() + offset_[static_cast<size_t>(p)]; }

  std::vector<int> positions_, first_;
  std::vector<Eigen::Index> offset_;  // of each row's (absent) entry of column 0
  Eigen::VectorXd entries_;
  long multiplications_ = 0;
};

}  // namespace halfstep::opt
