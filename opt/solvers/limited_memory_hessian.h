#pragma once

#include <Eigen/Core>
#include <deque>

namespace halfstep::opt {

/// A positive definite estimate B of a Hessian from the last few steps s and changes of gradient y,
/// in compact form B = σI − U·C⁻¹·Uᵀ. Steps of little or negative curvature are damped.
/// Source: [Nocedal2006], sections 7.2 and 18.3.
class LimitedMemoryHessian {
 public:
  /// Uses the last `memory` pairs (s, y); with 0 of them B stays 0.
  explicit LimitedMemoryHessian(size_t memory) : memory_(memory) {}

  /// Records that a step s ≠ 0 (n) changed the gradient by y (n).
  void Update(const Eigen::VectorXd& s, Eigen::VectorXd y);
  void Clear();                                           ///< forgets all pairs
  Eigen::VectorXd Times(const Eigen::VectorXd& v) const;  ///< B v (n)

  bool remembers() const { return memory_ > 0; }   ///< whether B learns from steps
  double sigma() const { return sigma_; }          ///< σ of B, above; 0 before the first step
  bool empty() const { return s_.empty(); }        ///< whether no pair is known
  const Eigen::MatrixXd& U() const { return U_; }  ///< (n × 2·pairs)
  const Eigen::MatrixXd& C() const { return C_; }  ///< (2·pairs × 2·pairs)

 private:
  void Assemble();

  size_t memory_;
  double sigma_ = 0.0;  // before the first step nothing is known
  std::deque<Eigen::VectorXd> s_, y_;
  Eigen::MatrixXd U_, C_;
};

}  // namespace halfstep::opt
