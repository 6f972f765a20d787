#pragma once

#include <Eigen/Core>
#include <string>

namespace halfstep::opt {

/// A summand of the cost in its natural unit; the Problem holds its weight.
class CostTerm {
 public:
  virtual ~CostTerm() = default;

  virtual std::string name() const = 0;  ///< for reports: "duration"
  virtual std::string unit() const = 0;  ///< of f; "" for a number
  /// f(x) at the whole x (n).
  virtual double Evaluate(const Eigen::VectorXd& x) const = 0;
  /// gradient (n) += weight · ∇f(x).
  virtual void AddGradient(const Eigen::VectorXd& x, double weight,
                           Eigen::Ref<Eigen::VectorXd> gradient) const = 0;
};

}  // namespace halfstep::opt
