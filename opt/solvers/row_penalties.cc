#include "opt/solvers/row_penalties.h"

#include <algorithm>

namespace halfstep::opt {
namespace {

constexpr double kRaise = 10.0;

}  // namespace

RowPenalties::RowPenalties(const ScaledRows& rows, const Memory& known, double first, double most)
    : rows_(&rows), most_(most) {
  for (const std::vector<int>& variables : rows.variables()) {
    const auto found = known.find(variables);
    penalties_.push_back(found == known.end() ? first : found->second);
  }
}

Eigen::VectorXd RowPenalties::OfRows() const {
  Eigen::VectorXd penalties(rows_->size());
  for (Eigen::Index i = 0; i < penalties.size(); ++i) penalties[i] = penalties_[GroupOf(i)];
  return penalties;
}

double RowPenalties::Owed(const Eigen::VectorXd& c) const {
  return OfRows().dot((-c).cwiseMax(0.0));
}

std::vector<double> RowPenalties::Violations(const Eigen::VectorXd& c) const {
  std::vector<double> violations(penalties_.size(), 0.0);
  for (Eigen::Index i = 0; i < c.size(); ++i) violations[GroupOf(i)] += std::max(0.0, -c[i]);
  return violations;
}

bool RowPenalties::Raise(const std::vector<double>& violations, const std::vector<double>& least) {
  bool raised = false;
  for (size_t k = 0; k < penalties_.size(); ++k) {
    if (violations[k] <= least[k] || penalties_[k] >= most_) continue;
    penalties_[k] = std::min(most_, kRaise * penalties_[k]);
    raised = true;
  }
  return raised;
}

bool RowPenalties::TakeBack(const RowPenalties& before, const std::vector<double>& violations,
                            const std::vector<double>& most) {
  bool taken = false;
  for (size_t k = 0; k < penalties_.size(); ++k) {
    if (penalties_[k] == before.penalties_[k] || violations[k] <= most[k]) continue;
    penalties_[k] = before.penalties_[k];
    taken = true;
  }
  return taken;
}

RowPenalties::Memory RowPenalties::Remembered() const {
  Memory memory;
  for (size_t k = 0; k < penalties_.size(); ++k) memory[rows_->variables()[k]] = penalties_[k];
  return memory;
}

}  // namespace halfstep::opt
