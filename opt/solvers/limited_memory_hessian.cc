#include "opt/solvers/limited_memory_hessian.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace halfstep::opt {

Eigen::VectorXd LimitedMemoryHessian::Times(const Eigen::VectorXd& v) const {
  if (s_.empty()) return sigma_ * v;
  return sigma_ * v - U_ * C_.partialPivLu().solve(U_.transpose() * v);
}

void LimitedMemoryHessian::Update(const Eigen::VectorXd& s, Eigen::VectorXd y) {
  const double ss = s.squaredNorm();
  if (memory_ == 0 || !(ss > 1e-24) || !y.allFinite()) return;
  if (s_.empty()) {
    // Nothing is curved so far: B stays 0.
    if (y.norm() <= 1e-12 * std::sqrt(ss)) return;
    sigma_ = std::clamp(y.norm() / std::sqrt(ss), 1e-8, 1e8);
  }
  // Powell's damping keeps B positive definite.
  const Eigen::VectorXd Bs = Times(s);
  const double sBs = s.dot(Bs), sy = s.dot(y);
  if (sy < 0.2 * sBs) {
    const double theta = 0.8 * sBs / (sBs - sy);
    y = theta * y + (1.0 - theta) * Bs;
  }
  if (!(s.dot(y) > 1e-16 * ss)) return;
  s_.push_back(s);
  y_.push_back(std::move(y));
  if (s_.size() > memory_) {
    s_.pop_front();
    y_.pop_front();
  }
  sigma_ = std::clamp(s_.back().dot(y_.back()) / s_.back().squaredNorm(), 1e-8, 1e8);
  Assemble();
}

void LimitedMemoryHessian::Clear() {
  s_.clear();
  y_.clear();
  sigma_ = 0.0;
}

void LimitedMemoryHessian::Assemble() {
  const Eigen::Index m = static_cast<Eigen::Index>(s_.size()), n = s_.front().size();
  Eigen::MatrixXd S(n, m), Y(n, m);
  for (Eigen::Index i = 0; i < m; ++i) {
    S.col(i) = s_[static_cast<size_t>(i)];
    Y.col(i) = y_[static_cast<size_t>(i)];
  }
  const Eigen::MatrixXd SY = S.transpose() * Y;
  U_.resize(n, 2 * m);
  U_ << sigma_ * S, Y;
  C_.setZero(2 * m, 2 * m);
  C_.topLeftCorner(m, m) = sigma_ * S.transpose() * S;
  C_.topRightCorner(m, m) = SY.triangularView<Eigen::StrictlyLower>();
  C_.bottomLeftCorner(m, m) = C_.topRightCorner(m, m).transpose();
  C_.bottomRightCorner(m, m) = -SY.diagonal().asDiagonal().toDenseMatrix();
}

}  // namespace halfstep::opt
