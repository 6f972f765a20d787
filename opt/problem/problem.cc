#include "opt/problem/problem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "opt/problem/plain_stream.h"
#include "opt/problem/require.h"

namespace halfstep::opt {
namespace {

void Append(const Eigen::VectorXd& tail, Eigen::VectorXd* whole) {
  const Eigen::Index old = whole->size();
  whole->conservativeResize(old + tail.size());
  whole->tail(tail.size()) = tail;
}

void RequireBounds(const std::string& name, const Eigen::VectorXd& lower,
                   const Eigen::VectorXd& upper, Eigen::Index size) {
  Require(lower.size() == size && upper.size() == size,
          name + ": " + std::to_string(size) + " values need as many bounds, not " +
              std::to_string(lower.size()) + " and " + std::to_string(upper.size()));
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < size; ++i) {
    const bool ordered = lower[i] <= upper[i] && lower[i] < kInfinity && upper[i] > -kInfinity;
    if (ordered) continue;
    PlainStream told;
    told << name << "[" << i << "]: bounds [" << lower[i] << ", " << upper[i] << "] hold nothing";
    Require(false, told.str());
  }
}

void RequirePattern(const ConstraintBlock& block, int num_variables) {
  const SparsityPattern& pattern = block.pattern();
  Require(pattern.rows.size() == pattern.cols.size(),
          block.name() + ": pattern with unequal numbers of rows and columns");
  const auto refuse = [&block](const std::pair<int, int>& at, const std::string& what) {
    Require(false, block.name() + ": pattern entry (" + std::to_string(at.first) + ", " +
                       std::to_string(at.second) + ") " + what);
  };
  std::vector<std::pair<int, int>> entries;
  entries.reserve(pattern.rows.size());
  for (size_t k = 0; k < pattern.rows.size(); ++k) {
    entries.emplace_back(pattern.rows[k], pattern.cols[k]);
    const auto& [row, col] = entries.back();
    if (row >= 0 && row < block.rows() && col >= 0 && col < num_variables) continue;
    refuse(entries.back(), "is outside " + std::to_string(block.rows()) + " rows and " +
                               std::to_string(num_variables) + " variables");
  }
  if (!std::is_sorted(entries.begin(), entries.end())) std::sort(entries.begin(), entries.end());
  const auto twice = std::adjacent_find(entries.begin(), entries.end());
  if (twice != entries.end()) refuse(*twice, "stands twice");
}

/// Outside [lower, upper] by how much; infinite for a value that is not finite.
double Outside(double value, double lower, double upper) {
  if (!std::isfinite(value)) return std::numeric_limits<double>::infinity();
  return std::max({0.0, lower - value, value - upper});
}

}  // namespace

BlockId Problem::AddVariables(VariableBlock block) {
  Require(constraints_.empty(), block.name + ": variables are added before the constraints");
  RequireBounds(block.name, block.lower, block.upper, block.initial.size());
  const int offset = num_variables();
  Append(block.initial, &initial_);
  Append(block.lower, &lower_);
  Append(block.upper, &upper_);
  variables_.push_back({std::move(block), offset});
  return {static_cast<int>(variables_.size()) - 1};
}

void Problem::AddConstraint(std::unique_ptr<ConstraintBlock> block) {
  Require(block != nullptr, "AddConstraint of nothing");
  RequireBounds(block->name(), block->lower(), block->upper(), block->rows());
  RequirePattern(*block, num_variables());
  const int first_row = num_constraints();
  const size_t first_nonzero = pattern_.rows.size();
  Append(block->lower(), &constraint_lower_);
  Append(block->upper(), &constraint_upper_);
  for (const int row : block->pattern().rows) pattern_.rows.push_back(first_row + row);
  for (const int col : block->pattern().cols) pattern_.cols.push_back(col);
  constraints_.push_back({std::move(block), first_row, first_nonzero});
}

void Problem::AddCost(std::unique_ptr<CostTerm> term, double weight) {
  Require(term != nullptr, "AddCost of nothing");
  Require(std::isfinite(weight), term->name() + ": the weight is not finite");
  costs_.push_back({std::move(term), weight});
}

int Problem::num_equalities() const {
  return static_cast<int>((constraint_lower_.array() == constraint_upper_.array()).count());
}

int Problem::offset(BlockId id) const {
  return variables_.at(static_cast<size_t>(id.index)).offset;
}

const VariableBlock& Problem::variables(BlockId id) const {
  return variables_.at(static_cast<size_t>(id.index)).block;
}

void Problem::RequireSize(const Eigen::VectorXd& x) const {
  Require(x.size() == num_variables(),
          "x has " + std::to_string(x.size()) + " entries, not " + std::to_string(num_variables()));
}

double Problem::Cost(const Eigen::VectorXd& x) const {
  RequireSize(x);
  double cost = 0.0;
  for (const WeightedCost& c : costs_) cost += c.weight * c.term->Evaluate(x);
  return cost;
}

Eigen::VectorXd Problem::Gradient(const Eigen::VectorXd& x) const {
  RequireSize(x);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(x.size());
  for (const WeightedCost& c : costs_) c.term->AddGradient(x, c.weight, gradient);
  return gradient;
}

Eigen::VectorXd Problem::Constraints(const Eigen::VectorXd& x) const {
  RequireSize(x);
  Eigen::VectorXd values(num_constraints());
  for (const PlacedConstraint& c : constraints_) {
    c.block->Evaluate(x, values.segment(c.first_row, c.block->rows()));
  }
  return values;
}

std::vector<double> Problem::Jacobian(const Eigen::VectorXd& x) const {
  RequireSize(x);
  std::vector<double> nonzeros(pattern_.rows.size());
  for (const PlacedConstraint& c : constraints_) {
    c.block->Jacobian(x,
                      std::span(nonzeros).subspan(c.first_nonzero, c.block->pattern().rows.size()));
  }
  return nonzeros;
}

Eigen::VectorXd Problem::ConstraintsWithJacobian(const Eigen::VectorXd& x,
                                                 std::vector<double>* nonzeros) const {
  RequireSize(x);
  Eigen::VectorXd values(num_constraints());
  nonzeros->resize(pattern_.rows.size());
  for (const PlacedConstraint& c : constraints_) {
    c.block->EvaluateWithJacobian(
        x, values.segment(c.first_row, c.block->rows()),
        std::span(*nonzeros).subspan(c.first_nonzero, c.block->pattern().rows.size()));
  }
  return values;
}

Eigen::MatrixXd Problem::DenseJacobian(const Eigen::VectorXd& x) const {
  const std::vector<double> nonzeros = Jacobian(x);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(num_constraints(), num_variables());
  for (size_t k = 0; k < nonzeros.size(); ++k)
    dense(pattern_.rows[k], pattern_.cols[k]) = nonzeros[k];
  return dense;
}

Violation Problem::MaxViolation(const Eigen::VectorXd& x) const {
  return MaxViolation(x, Constraints(x));
}

Violation Problem::MaxViolation(const Eigen::VectorXd& x,
                                const Eigen::VectorXd& constraints) const {
  RequireSize(x);
  Require(constraints.size() == num_constraints(), "constraint values of another problem");
  double worst = 0.0;
  Eigen::Index row = -1, variable = -1;
  for (Eigen::Index i = 0; i < constraints.size(); ++i) {
    const double out = Outside(constraints[i], constraint_lower_[i], constraint_upper_[i]);
    if (out > worst) worst = out, row = i;
  }
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const double out = Outside(x[j], lower_[j], upper_[j]);
    if (out > worst) worst = out, row = -1, variable = j;
  }
  if (variable >= 0) {
    const int j = static_cast<int>(variable);
    return {worst, VariableName(j), VariableUnit(j)};
  }
  if (row < 0) return {};
  const int i = static_cast<int>(row);
  return {worst, RowName(i), RowUnit(i)};
}

const Problem::PlacedConstraint& Problem::ConstraintOf(int row) const {
  Require(row >= 0 && row < num_constraints(), "row " + std::to_string(row) + " does not exist");
  const auto after = std::upper_bound(constraints_.begin(), constraints_.end(), row,
                                      [](int r, const auto& c) { return r < c.first_row; });
  return *std::prev(after);
}

const Problem::PlacedVariables& Problem::VariablesOf(int variable) const {
  Require(variable >= 0 && variable < num_variables(),
          "variable " + std::to_string(variable) + " does not exist");
  const auto after = std::upper_bound(variables_.begin(), variables_.end(), variable,
                                      [](int v, const auto& b) { return v < b.offset; });
  return *std::prev(after);
}

std::string Problem::RowName(int row) const {
  const PlacedConstraint& c = ConstraintOf(row);
  return c.block->RowName(row - c.first_row);
}

std::string Problem::RowUnit(int row) const { return ConstraintOf(row).block->unit(); }

std::string Problem::VariableName(int variable) const {
  const PlacedVariables& v = VariablesOf(variable);
  return v.block.name + "[" + std::to_string(variable - v.offset) + "]";
}

std::string Problem::VariableUnit(int variable) const { return VariablesOf(variable).block.unit; }

}  // namespace halfstep::opt
