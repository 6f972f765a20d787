#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "opt/problem/problem.h"
#include "tests/problems/dual.h"

namespace halfstep::testing {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline std::vector<double> Plain(const Eigen::VectorXd& x) { return {x.begin(), x.end()}; }

/// f given as a generic function of an indexable x; its gradient by automatic differentiation.
template <class F>
class AutoCost : public opt::CostTerm {
 public:
  explicit AutoCost(F f) : f_(std::move(f)) {}
  std::string name() const override { return "cost"; }
  std::string unit() const override { return "1"; }
  double Evaluate(const Eigen::VectorXd& x) const override { return f_(Plain(x)); }
  void AddGradient(const Eigen::VectorXd& x, double weight,
                   Eigen::Ref<Eigen::VectorXd> gradient) const override {
    const Dual value = f_(Seeded(x));
    gradient += weight * value.gradient;
  }

 private:
  F f_;
};

/// One row lower ≤ g(x) ≤ upper, g a generic function of an indexable x that reads only `reads`.
template <class G>
class AutoRow : public opt::ConstraintBlock {
 public:
  AutoRow(std::string name, G g, double lower, double upper, std::vector<int> reads)
      : name_(std::move(name)), g_(std::move(g)), lower_(lower), upper_(upper) {
    pattern_.rows.assign(reads.size(), 0);
    pattern_.cols = std::move(reads);
  }
  std::string name() const override { return name_; }
  std::string unit() const override { return "1"; }
  int rows() const override { return 1; }
  const opt::SparsityPattern& pattern() const override { return pattern_; }
  Eigen::VectorXd lower() const override { return Eigen::VectorXd::Constant(1, lower_); }
  Eigen::VectorXd upper() const override { return Eigen::VectorXd::Constant(1, upper_); }
  void Evaluate(const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> values) const override {
    values[0] = g_(Plain(x));
  }
  void Jacobian(const Eigen::VectorXd& x, std::span<double> nonzeros) const override {
    const Dual value = g_(Seeded(x));
    for (size_t k = 0; k < nonzeros.size(); ++k) {
      nonzeros[k] = value.gradient[pattern_.cols[k]];
    }
  }
  std::string RowName(int) const override { return name_; }

 private:
  std::string name_;
  G g_;
  double lower_, upper_;
  opt::SparsityPattern pattern_;
};

/// A problem put together from expressions. `x` is indexed from 0.
class ProblemBuilder {
 public:
  ProblemBuilder(Eigen::VectorXd initial, Eigen::VectorXd lower, Eigen::VectorXd upper)
      : size_(static_cast<int>(initial.size())) {
    problem_.AddVariables({"x", "1", std::move(initial), std::move(lower), std::move(upper)});
  }
  /// Unbounded variables.
  explicit ProblemBuilder(const Eigen::VectorXd& initial)
      : ProblemBuilder(initial, Eigen::VectorXd::Constant(initial.size(), -kInfinity),
                       Eigen::VectorXd::Constant(initial.size(), kInfinity)) {}

  template <class F>
  ProblemBuilder& Minimize(F f) {
    problem_.AddCost(std::make_unique<AutoCost<F>>(std::move(f)), 1.0);
    return *this;
  }
  /// Reads all of x unless `reads` says less.
  template <class G>
  ProblemBuilder& Row(const std::string& name, double lower, G g, double upper,
                      std::vector<int> reads = {}) {
    if (reads.empty()) {
      for (int j = 0; j < size_; ++j) reads.push_back(j);
    }
    problem_.AddConstraint(
        std::make_unique<AutoRow<G>>(name, std::move(g), lower, upper, std::move(reads)));
    return *this;
  }
  template <class G>
  ProblemBuilder& NonNegative(const std::string& name, G g) {
    return Row(name, 0.0, std::move(g), kInfinity);
  }
  opt::Problem Build() { return std::move(problem_); }

 private:
  int size_;
  opt::Problem problem_;
};

inline Eigen::VectorXd Vector(std::initializer_list<double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.begin(),
                                           static_cast<Eigen::Index>(values.size()));
}
inline Eigen::VectorXd Constant(int size, double value) {
  return Eigen::VectorXd::Constant(size, value);
}

}  // namespace halfstep::testing
