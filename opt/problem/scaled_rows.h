#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "opt/problem/problem.h"

namespace halfstep::opt {

/// The rows of a problem as one-sided ones, c(x) ≥ 0 (m): one for each finite side of each row, two
/// for an equality, scaled once so that their derivatives at a first point are at most 1.
class ScaledRows {
 public:
  /// `jacobian` is that of the first point, in the order of the problem's pattern. `problem` is
  /// borrowed.
  ScaledRows(const Problem& problem, const std::vector<double>& jacobian);

  /// Number of one-sided rows, m.
  Eigen::Index size() const { return static_cast<Eigen::Index>(sides_.size()); }
  /// The group of each row (m): rows with derivatives along the same variables form one.
  const std::vector<size_t>& groups() const { return groups_; }
  /// The variables of each group, in ascending order.
  const std::vector<std::vector<int>>& variables() const { return variables_; }
  /// c (m) for the values g(x) of the problem's rows.
  Eigen::VectorXd Values(const Eigen::VectorXd& values) const;
  /// ∂c/∂x (m×n) for the Jacobian of the problem; no entries for fixed variables (lower = upper).
  Eigen::SparseMatrix<double> Jacobian(const std::vector<double>& jacobian) const;

 private:
  struct Side {
    int row;
    double factor;  // sign times scale
    double bound;
  };

  const Problem& problem_;
  std::vector<Side> sides_;
  std::vector<size_t> first_sides_;  // of each row, and the number of all
  std::vector<size_t> groups_;
  std::vector<std::vector<int>> variables_;
};

}  // namespace halfstep::opt
