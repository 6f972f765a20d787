#pragma once

#include <Eigen/Core>
#include <vector>

namespace halfstep::opt {

/// The finite bounds of n values as terms −μ Σ log(s_i) of a barrier function, s_i > 0 the slack of
/// a side, with a primal-dual multiplier z_i ≈ μ/s_i each. Remembers the multipliers, not the
/// values. Vectors of multipliers are (size()), all others (n).
/// Source: opt/README.md, "halfstep/barrier"; [Nocedal2006], chapter 19.
class BarrierTerms {
 public:
  /// The terms of lower ≤ values ≤ upper (n); values with lower = upper are fixed and have no side.
  /// When `may_be_outside`, a side with a slack below 1e-10 is outside: no term, but a violation to
  /// be lowered. Else every slack must stay positive. Multipliers begin at 1.
  BarrierTerms(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, bool may_be_outside);

  size_t size() const { return sides_.size(); }  ///< number of sides with a finite bound
  /// Whether any side is outside at these values.
  bool AnyOutside(const Eigen::VectorXd& values) const;

  const Eigen::VectorXd& multipliers() const { return multipliers_; }  ///< one for each side, > 0
  /// μ/s_i.
  Eigen::VectorXd CentralMultipliers(const Eigen::VectorXd& values, double mu) const;
  /// Brings multipliers within a factor of 10⁶ of μ/s_i.
  void ClampMultipliers(const Eigen::VectorXd& values, double mu);
  /// Takes the fraction α of a Newton step for z s = μ, while the values change by α·change.
  void AdvanceMultipliers(const Eigen::VectorXd& values, const Eigen::VectorXd& change, double mu,
                          double alpha);

  /// Adds −Σ z_i ∇s_i for z = `multipliers`, 1 for sides outside.
  void AddGradient(const Eigen::VectorXd& values, const Eigen::VectorXd& multipliers,
                   Eigen::VectorXd* gradient) const;
  /// Adds z_i/s_i for each side inside.
  void AddCurvature(const Eigen::VectorXd& values, Eigen::VectorXd* diagonal) const;
  /// The largest |s_i z_i − μ| of sides inside.
  double ComplementarityError(const Eigen::VectorXd& values, double mu) const;
  /// The largest α ≤ 1 at which slacks inside, linear in α·change, keep a hundredth of themselves.
  double StepLimit(const Eigen::VectorXd& values, const Eigen::VectorXd& change) const;
  /// `merit` plus the terms at `there`, and the violations there of what is outside at `here`; +inf
  /// when a side that is inside at `here` is not there.
  double AddedToMerit(double merit, const Eigen::VectorXd& here, const Eigen::VectorXd& there,
                      double mu) const;

 private:
  // One inequality sign·(value − bound) ≥ 0.
  struct Side {
    int index;
    double sign, bound;
    double Slack(const Eigen::VectorXd& values) const { return sign * (values[index] - bound); }
  };

  const Side& SideAt(Eigen::Index i) const { return sides_[static_cast<size_t>(i)]; }
  bool IsOutside(const Side& side, const Eigen::VectorXd& values) const {
    return side.Slack(values) < least_;
  }

  double least_;  // slack of a side inside
  std::vector<Side> sides_;
  Eigen::VectorXd multipliers_;
};

}  // namespace halfstep::opt
