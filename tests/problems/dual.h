#pragma once

#include <Eigen/Core>
#include <cmath>
#include <utility>
#include <vector>

namespace halfstep::testing {

/// A value with its gradient: forward automatic differentiation for problem cards.
struct Dual {
  double value = 0.0;
  Eigen::VectorXd gradient;
};

inline Dual operator-(Dual a) { return {-a.value, -a.gradient}; }
inline Dual operator+(Dual a, const Dual& b) {
  return {a.value + b.value, a.gradient + b.gradient};
}
inline Dual operator-(Dual a, const Dual& b) {
  return {a.value - b.value, a.gradient - b.gradient};
}
inline Dual operator*(const Dual& a, const Dual& b) {
  return {a.value * b.value, b.value * a.gradient + a.value * b.gradient};
}
inline Dual operator+(Dual a, double b) { return {a.value + b, std::move(a.gradient)}; }
inline Dual operator+(double a, Dual b) { return {a + b.value, std::move(b.gradient)}; }
inline Dual operator-(Dual a, double b) { return {a.value - b, std::move(a.gradient)}; }
inline Dual operator-(double a, const Dual& b) { return {a - b.value, -b.gradient}; }
inline Dual operator*(double a, const Dual& b) { return {a * b.value, a * b.gradient}; }
inline Dual operator/(const Dual& a, double b) { return {a.value / b, a.gradient / b}; }
inline Dual log(const Dual& a) { return {std::log(a.value), a.gradient / a.value}; }
inline Dual sqrt(const Dual& a) {
  const double root = std::sqrt(a.value);
  return {root, a.gradient / (2.0 * root)};
}

/// x_j with the gradient e_j.
inline std::vector<Dual> Seeded(const Eigen::VectorXd& x) {
  std::vector<Dual> duals;
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    duals.push_back({x[j], Eigen::VectorXd::Unit(x.size(), j)});
  }
  return duals;
}

/// v to the power n ≥ 1.
template <class Scalar>
Scalar Power(const Scalar& v, int n) {
  Scalar result = v;
  for (int i = 1; i < n; ++i) result = result * v;
  return result;
}

}  // namespace halfstep::testing
