#include "opt/problem/scaled_rows.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace halfstep::opt {

ScaledRows::ScaledRows(const Problem& problem, const std::vector<double>& jacobian)
    : problem_(problem) {
  Eigen::VectorXd slope = Eigen::VectorXd::Ones(problem.num_constraints());
  for (size_t k = 0; k < jacobian.size(); ++k) {
    double& most = slope[problem.pattern().rows[k]];
    most = std::max(most, std::abs(jacobian[k]));
  }
  for (int row = 0; row < problem.num_constraints(); ++row) {
    const double scale = 1.0 / slope[row];
    const double lower = problem.constraint_lower()[row], upper = problem.constraint_upper()[row];
    first_sides_.push_back(sides_.size());
    if (std::isfinite(lower)) sides_.push_back({row, scale, lower});
    if (std::isfinite(upper)) sides_.push_back({row, -scale, upper});
  }
  first_sides_.push_back(sides_.size());
  std::vector<std::vector<int>> columns(static_cast<size_t>(problem.num_constraints()));
  for (size_t k = 0; k < jacobian.size(); ++k) {
    columns[static_cast<size_t>(problem.pattern().rows[k])].push_back(problem.pattern().cols[k]);
  }
  std::map<std::vector<int>, size_t> known;
  for (const Side& side : sides_) {
    std::vector<int>& own = columns[static_cast<size_t>(side.row)];
    if (!std::is_sorted(own.begin(), own.end())) std::sort(own.begin(), own.end());
    // Neighbours often are of the same group.
    if (!groups_.empty() && variables_[groups_.back()] == own) {
      groups_.push_back(groups_.back());
      continue;
    }
    const auto [at, added] = known.try_emplace(own, variables_.size());
    if (added) variables_.push_back(own);
    groups_.push_back(at->second);
  }
}

Eigen::VectorXd ScaledRows::Values(const Eigen::VectorXd& values) const {
  Eigen::VectorXd c(size());
  Eigen::Index i = 0;
  for (const Side& side : sides_) c[i++] = side.factor * (values[side.row] - side.bound);
  return c;
}

Eigen::SparseMatrix<double> ScaledRows::Jacobian(const std::vector<double>& jacobian) const {
  const SparsityPattern& pattern = problem_.pattern();
  std::vector<Eigen::Triplet<double>> entries;
  for (size_t k = 0; k < jacobian.size(); ++k) {
    const int v = pattern.cols[k];
    if (jacobian[k] == 0.0 || problem_.lower()[v] == problem_.upper()[v]) continue;
    const size_t row = static_cast<size_t>(pattern.rows[k]);
    for (size_t i = first_sides_[row]; i < first_sides_[row + 1]; ++i) {
      entries.emplace_back(static_cast<int>(i), v, sides_[i].factor * jacobian[k]);
    }
  }
  Eigen::SparseMatrix<double> A(size(), problem_.num_variables());
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

}  // namespace halfstep::opt
