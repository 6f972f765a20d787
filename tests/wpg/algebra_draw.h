#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "tests/wpg/random_direction.h"
#include "wpg/motion/vector_ball.h"

namespace halfstep {

/// Numbers and vectors of very different sizes, many of them zero, so that each term of a bound is
/// once the only one.
class AlgebraDraw {
 public:
  explicit AlgebraDraw(unsigned seed) : random_(seed) {}

  double Uniform(double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random_);
  }
  /// Zero, or up to `most` and as far as a thousandth of it.
  double Sparse(double most) {
    return Uniform(0, 1) < 0.6 ? 0.0 : most * std::pow(10, Uniform(-3, 0));
  }
  Eigen::Vector3d Direction() { return RandomDirection(&random_); }
  Eigen::Vector3d Sparse3(double most) { return Sparse(most) * Direction(); }
  VectorBall Ball(double most) { return {Sparse3(most), Sparse(0.5 * most)}; }
  /// One of the vectors of a ball, on its edge.
  Eigen::Vector3d In(const VectorBall& ball) { return ball.center + ball.radius * Direction(); }
  Eigen::Matrix3d Turn(double angle) {
    return Eigen::AngleAxisd(angle, Direction()).toRotationMatrix();
  }
  Eigen::Matrix3d Inertia() {
    Eigen::Matrix3d A;
    for (double& entry : A.reshaped()) entry = Uniform(-1, 1);
    return Sparse(3.0) * A * A.transpose();
  }

 private:
  std::mt19937 random_;
};

/// How far truths are beyond their bounds, relative to rounding, and the nearest to one.
struct AlgebraTally {
  double excess = 0.0, nearest = 0.0;

  void Compare(double truth, double bound, double size) {
    excess = std::max(excess, (truth - bound) / (1e-12 * (1.0 + size)));
    if (truth > 1e-6 * (1.0 + size)) nearest = std::max(nearest, truth / bound);
  }
  void Compare(const Eigen::Vector3d& truth, const VectorBall& ball) {
    Compare((truth - ball.center).norm(), ball.radius, truth.norm() + ball.most());
  }
};

}  // namespace halfstep
