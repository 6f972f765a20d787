#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "opt/problem/cost_term.h"
#include "opt/problem/function_block.h"
#include "opt/problem/variable_block.h"

namespace halfstep::opt {

/// The largest violation of a problem's bounds at a point.
struct Violation {
  double amount = 0.0;  ///< ≥ 0, natural unit of the row; inf when a value there is not finite
  std::string row;      ///< name of that row or variable; "" when nothing is violated
  std::string unit;     ///< of that row or variable
};

/// The nonlinear program
///
///     minimize    f(x) = Σ_k w_k f_k(x)
///     subject to  lower ≤ g(x) ≤ upper,    lower_x ≤ x ≤ upper_x,    x ∈ Rⁿ
///
/// made of blocks that know nothing of each other (opt/README.md). Blocks are stacked in the order
/// of addition. All evaluation is const; a Problem may be evaluated from several threads if its
/// blocks may. x of a wrong size is a std::logic_error.
class Problem {
 public:
  /// Broken preconditions (sizes, lower > upper, NaN bounds) are std::logic_error. All variables
  /// are added before the first constraint.
  BlockId AddVariables(VariableBlock block);
  /// Rows l ≤ g(x) ≤ u, below those that are there.
  void AddConstraint(std::unique_ptr<ConstraintBlock> block);
  /// Adds weight·f to the cost; weight is finite.
  void AddCost(std::unique_ptr<CostTerm> term, double weight);

  int num_variables() const { return static_cast<int>(lower_.size()); }               ///< n
  int num_constraints() const { return static_cast<int>(constraint_lower_.size()); }  ///< m
  int num_equalities() const;                        ///< rows with lower = upper
  int offset(BlockId id) const;                      ///< index in x of the block's first variable
  const VariableBlock& variables(BlockId id) const;  ///< the block of that id

  const Eigen::VectorXd& initial() const { return initial_; }                    ///< (n)
  const Eigen::VectorXd& lower() const { return lower_; }                        ///< (n)
  const Eigen::VectorXd& upper() const { return upper_; }                        ///< (n)
  const Eigen::VectorXd& constraint_lower() const { return constraint_lower_; }  ///< (m)
  const Eigen::VectorXd& constraint_upper() const { return constraint_upper_; }  ///< (m)
  const SparsityPattern& pattern() const { return pattern_; }  ///< of the stacked Jacobian

  double Cost(const Eigen::VectorXd& x) const;                   ///< Σ weight·f at x (n)
  Eigen::VectorXd Gradient(const Eigen::VectorXd& x) const;      ///< (n)
  Eigen::VectorXd Constraints(const Eigen::VectorXd& x) const;   ///< (m)
  std::vector<double> Jacobian(const Eigen::VectorXd& x) const;  ///< in the order of pattern()
  /// Constraints (m), and the Jacobian into `nonzeros`.
  Eigen::VectorXd ConstraintsWithJacobian(const Eigen::VectorXd& x,
                                          std::vector<double>* nonzeros) const;
  Eigen::MatrixXd DenseJacobian(const Eigen::VectorXd& x) const;  ///< (m×n), for checks and reports

  /// The largest violation of rows and of variable bounds, each in its natural unit.
  Violation MaxViolation(const Eigen::VectorXd& x) const;
  /// The same when `constraints` = g(x) is known already.
  Violation MaxViolation(const Eigen::VectorXd& x, const Eigen::VectorXd& constraints) const;

  std::string RowName(int row) const;            ///< of a constraint row, by its block
  std::string RowUnit(int row) const;            ///< of a constraint row
  std::string VariableName(int variable) const;  ///< "overlap[3]"
  std::string VariableUnit(int variable) const;  ///< as VariableBlock says it; "" for a number

  /// Aligned text table: the cost's terms, then the `max_rows` rows and variables with the least
  /// room to a bound (most violated first) with value, bounds, room and unit.
  std::string Report(const Eigen::VectorXd& x, int max_rows = 20) const;

 private:
  struct WeightedCost {
    std::unique_ptr<CostTerm> term;
    double weight;
  };
  struct PlacedConstraint {
    std::unique_ptr<ConstraintBlock> block;
    int first_row;
    size_t first_nonzero;
  };
  struct PlacedVariables {
    VariableBlock block;
    int offset;
  };

  void RequireSize(const Eigen::VectorXd& x) const;
  const PlacedConstraint& ConstraintOf(int row) const;
  const PlacedVariables& VariablesOf(int variable) const;

  std::vector<PlacedVariables> variables_;
  std::vector<PlacedConstraint> constraints_;
  std::vector<WeightedCost> costs_;
  Eigen::VectorXd initial_, lower_, upper_, constraint_lower_, constraint_upper_;
  SparsityPattern pattern_;
};

}  // namespace halfstep::opt
