#include "experiments/verify/min_norm_point.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "wpg/nth.h"

namespace halfstep::verify {
namespace {

using Long = long double;
using Vector = Eigen::Matrix<Long, 3, 1>;

// The point of a set, without its ball, where direction·x is least.
Vector Least(const ConvexSet& set, const Vector& direction) {
  const Eigen::Vector3d d = direction.cast<double>();
  size_t best = 0;
  double least = d.dot(set.points[0]);
  for (size_t i = 1; i < set.points.size(); ++i) {
    const double here = d.dot(set.points[i]);
    if (here < least) {
      least = here;
      best = i;
    }
  }
  Vector point = set.points[best].cast<Long>();
  if (set.disc > 0) {
    // Where the direction is along the axis, what rounding leaves across it may point anywhere,
    // also along it: out of the disc, whose middle is as near then.
    const Vector axis = set.disc_axis.cast<Long>().normalized();
    const Vector across = direction - axis * axis.dot(direction);
    if (across.norm() > 1e-16L * direction.norm()) {
      point -= static_cast<Long>(set.disc) * (across - axis * axis.dot(across)).normalized();
    }
  }
  return point;
}

// The largest coordinate [m].
double Extent(const ConvexSet& set) {
  double most = set.disc;
  for (const Eigen::Vector3d& p : set.points) most = std::max(most, p.cwiseAbs().maxCoeff());
  return most;
}

// The corral: affinely independent points of the difference, and weights.
struct Corral {
  std::vector<Vector> points;
  std::vector<Long> weights;

  Vector Point() const {
    Vector x = Vector::Zero();
    for (size_t i = 0; i < points.size(); ++i) x += weights[i] * points[i];
    return x;
  }
  // Weights of the affine hull's point of least norm; empty when the points are dependent.
  std::vector<Long> AffineMinimum() const {
    const Eigen::Index n = static_cast<Eigen::Index>(points.size());
    if (n == 1) return {1};
    Eigen::Matrix<Long, 3, Eigen::Dynamic, 0, 3, 4> D(3, n - 1);
    for (Eigen::Index i = 1; i < n; ++i) D.col(i - 1) = Nth(points, i) - points[0];
    // Columns of length one, so that long and short edges count alike.
    const Eigen::Matrix<Long, Eigen::Dynamic, 1, 0, 4, 1> lengths = D.colwise().norm().transpose();
    for (Eigen::Index i = 0; i + 1 < n; ++i) D.col(i) /= lengths[i];
    const Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4> G = D.transpose() * D;
    const auto lu = G.fullPivLu();
    if (!lu.isInvertible()) return {};
    const Eigen::Matrix<Long, Eigen::Dynamic, 1, 0, 4, 1> y = lu.solve(-D.transpose() * points[0]);
    std::vector<Long> weights(points.size());
    weights[0] = 1;
    for (Eigen::Index i = 1; i < n; ++i) {
      Nth(weights, i) = y[i - 1] / lengths[i - 1];
      weights[0] -= y[i - 1] / lengths[i - 1];
    }
    return weights;
  }
  void Drop(size_t i) {
    points.erase(points.begin() + static_cast<std::ptrdiff_t>(i));
    weights.erase(weights.begin() + static_cast<std::ptrdiff_t>(i));
  }
  // Wolfe's minor cycle: moves to the point of least norm of the hull of a subset. False when the
  // newest point adds nothing.
  bool Settle() {
    for (;;) {
      const std::vector<Long> target = AffineMinimum();
      if (target.empty()) {
        Drop(points.size() - 1);
        return false;
      }
      Long step = 1;
      size_t blocking = points.size();
      for (size_t i = 0; i < points.size(); ++i) {
        if (target[i] > 0) continue;
        const Long here = weights[i] / (weights[i] - target[i]);
        if (here < step || blocking == points.size()) {
          step = std::min(step, here);
          blocking = i;
        }
      }
      if (blocking == points.size()) {
        weights = target;
        return true;
      }
      if (points.size() == 1) return false;
      for (size_t i = 0; i < points.size(); ++i) weights[i] += step * (target[i] - weights[i]);
      Drop(blocking);
    }
  }
};

}  // namespace

Bracket DistanceOf(const ConvexSet& a, const ConvexSet& b, double enough) {
  const auto difference = [&](const Vector& d) { return Vector(Least(a, d) - Least(b, -d)); };
  Vector x = (a.points[0] - b.points[0]).cast<Long>();
  if (x.norm() == 0) x = Vector::UnitX();
  Corral corral{{difference(x)}, {1}};
  x = corral.Point();
  const Long balls = static_cast<Long>(a.ball) + b.ball;
  // Directions are rounded to double: that much of the coordinates may be too high.
  const Long rounding =
      4 * std::numeric_limits<double>::epsilon() * static_cast<Long>(Extent(a) + Extent(b));
  const Long enough_apart = static_cast<Long>(enough) + balls + rounding;
  Long lower = 0, upper = x.norm();
  for (int k = 0; k < 300; ++k) {
    const Long norm = x.norm();
    if (norm < upper) upper = norm;
    if (norm < 1e-13L) return {0, 0};
    const Vector v = difference(x);
    lower = std::max(lower, x.dot(v) / norm);
    if (upper - lower <= 1e-14L * (1 + upper) || lower >= enough_apart) break;
    if (std::find(corral.points.begin(), corral.points.end(), v) != corral.points.end()) break;
    if (corral.points.size() == 4) break;
    corral.points.push_back(v);
    corral.weights.push_back(0);
    if (!corral.Settle()) break;
    const Vector next = corral.Point();
    if (!(next.norm() < norm)) break;
    x = next;
  }
  return {static_cast<double>(std::max<Long>(lower - balls - rounding, 0)),
          static_cast<double>(std::max<Long>(upper - balls, 0))};
}

}  // namespace halfstep::verify
