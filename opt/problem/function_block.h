#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

namespace halfstep::opt {

/// The entries of a Jacobian that may differ from zero anywhere: (rows[k], cols[k]). Both lists
/// have the same length, no entry stands twice; `rows` count within the block, `cols` in the whole
/// x.
struct SparsityPattern {
  std::vector<int> rows;  ///< counted within the block
  std::vector<int> cols;  ///< counted in the whole x
};

/// g: Rⁿ → Rᵐ with a sparse Jacobian. Evaluation is const: a block knows no current x. Any method
/// may throw; a solver then ends in Ending::kFailed with the exception's message.
class FunctionBlock {
 public:
  virtual ~FunctionBlock() = default;

  virtual std::string name() const = 0;  ///< for reports: "clearance"
  virtual std::string unit() const = 0;  ///< of its rows; "" for a number
  virtual int rows() const = 0;          ///< number of rows, constant
  /// Declared once: the same pattern in every call, whatever the values.
  virtual const SparsityPattern& pattern() const = 0;
  /// values (rows) at the whole x (n), in natural units.
  virtual void Evaluate(const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> values) const = 0;
  /// ∂g_rows[k]/∂x_cols[k] at the whole x, in the pattern's order.
  virtual void Jacobian(const Eigen::VectorXd& x, std::span<double> nonzeros) const = 0;
  /// Evaluates both; to be overridden where they share most of the computation.
  virtual void EvaluateWithJacobian(const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> values,
                                    std::span<double> nonzeros) const {
    Evaluate(x, values);
    Jacobian(x, nonzeros);
  }
  /// Name of a row in reports: "name[row]" unless overridden.
  virtual std::string RowName(int row) const;
};

/// lower ≤ g(x) ≤ upper, row by row, in natural units. An infinite side does not constrain; equal
/// sides are an equality. Constants belong in the bounds, not in the values.
class ConstraintBlock : public FunctionBlock {
 public:
  virtual Eigen::VectorXd lower() const = 0;  ///< (rows); asked once, when added
  virtual Eigen::VectorXd upper() const = 0;  ///< (rows); asked once, when added
};

}  // namespace halfstep::opt
