#include "opt/scaled_rows.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace halfstep::opt {

ScaledRows::ScaledRows(const Problem& problem, const std::vector<double>& jacobian)
    : problem_(problem) {
  std::vector<double> slope(static_cast<size_t>(problem.num_constraints()), 1.0);
  for (size_t k = 0; k < jacobian.size(); ++k) {
    double& most = slope[static_cast<size_t>(problem.pattern().rows[k])];
    most = std::max(most, std::abs(jacobian[k]));
  }
  for (int row = 0; row < problem.num_constraints(); ++row) {
    const double scale = 1.0 / slope[static_cast<size_t>(row)];
    const double lower = problem.constraint_lower()[row], upper = problem.constraint_upper()[row];
    if (std::isfinite(lower)) sides_.push_back({row, scale, lower});
    if (std::isfinite(upper)) sides_.push_back({row, -scale, upper});
  }
  std::vector<std::vector<int>> columns(static_cast<size_t>(problem.num_constraints()));
  for (size_t k = 0; k < jacobian.size(); ++k) {
    columns[static_cast<size_t>(problem.pattern().rows[k])].push_back(problem.pattern().cols[k]);
  }
  std::map<std::vector<int>, int> known;
  for (const Side& side : sides_) {
    std::vector<int>& own = columns[static_cast<size_t>(side.row)];
    std::sort(own.begin(), own.end());
    const auto [at, added] = known.try_emplace(own, static_cast<int>(variables_.size()));
    if (added) variables_.push_back(own);
    groups_.push_back(at->second);
  }
}

Eigen::VectorXd ScaledRows::Values(const Eigen::VectorXd& values) const {
  Eigen::VectorXd c(size());
  for (Eigen::Index i = 0; i < size(); ++i) {
    const Side& side = sides_[static_cast<size_t>(i)];
    c[i] = side.factor * (values[side.row] - side.bound);
  }
  return c;
}

Eigen::SparseMatrix<double> ScaledRows::Jacobian(const std::vector<double>& jacobian) const {
  const SparsityPattern& pattern = problem_.pattern();
  std::vector<Eigen::Triplet<double>> entries;
  for (size_t k = 0; k < jacobian.size(); ++k) {
    const int v = pattern.cols[k];
    const bool fixed = problem_.lower()[v] == problem_.upper()[v];
    if (!fixed && jacobian[k] != 0.0) entries.emplace_back(pattern.rows[k], v, jacobian[k]);
  }
  Eigen::SparseMatrix<double, Eigen::RowMajor> by_row(problem_.num_constraints(),
                                                      problem_.num_variables());
  by_row.setFromTriplets(entries.begin(), entries.end());
  entries.clear();
  for (Eigen::Index i = 0; i < size(); ++i) {
    const Side& side = sides_[static_cast<size_t>(i)];
    for (decltype(by_row)::InnerIterator it(by_row, side.row); it; ++it) {
      entries.emplace_back(static_cast<int>(i), it.col(), side.factor * it.value());
    }
  }
  Eigen::SparseMatrix<double> A(size(), problem_.num_variables());
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

}  // namespace halfstep::opt
