#include "experiments/checker/separation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace halfstep::checker {
namespace {

using Eigen::Vector3d;

// The point of the hull of at most four points that is nearest to the origin; of the points only
// those stay of which it is a combination.
Vector3d NearestInHull(std::vector<Vector3d>* points) {
  const size_t n = points->size();
  double least = std::numeric_limits<double>::infinity();
  Vector3d nearest = points->back();
  std::vector<Vector3d> kept = {points->back()};
  for (unsigned subset = 1; subset < (1U << n); ++subset) {
    std::vector<Vector3d> of;
    for (size_t i = 0; i < n; ++i) {
      if (subset & (1U << i)) of.push_back((*points)[i]);
    }
    // Weights of the affine hull's nearest point.
    const auto m = static_cast<Eigen::Index>(of.size());
    Eigen::MatrixXd E(3, m - 1);
    for (Eigen::Index i = 1; i < m; ++i) E.col(i - 1) = of[static_cast<size_t>(i)] - of[0];
    Eigen::VectorXd w(m);
    if (m > 1) {
      w.tail(m - 1) = E.colPivHouseholderQr().solve(-of[0]);
      w[0] = 1.0 - w.tail(m - 1).sum();
    } else {
      w[0] = 1.0;
    }
    if (!(w.minCoeff() >= 0.0)) continue;
    Vector3d point = Vector3d::Zero();
    for (Eigen::Index i = 0; i < m; ++i) point += w[i] * of[static_cast<size_t>(i)];
    if (point.squaredNorm() >= least) continue;
    least = point.squaredNorm();
    nearest = point;
    kept = of;
  }
  *points = kept;
  return nearest;
}

// Bounds of which the upper one is not below the maximum of n·x over a body at X.
Interval SupportAlong(const Vector& n_W, const ConvexBody& body, const Frame& X) {
  Vector n;  // Rᵀn: what n·(R x + p) asks for
  for (size_t k = 0; k < 3; ++k) n[k] = Dot({X.R[0][k], X.R[1][k], X.R[2][k]}, n_W);
  Vector3d middle, off;
  for (size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    middle[i] = n[k].Middle();
    off[i] = n[k].FarthestFrom(middle[i]);
  }
  // A sum of three products is off by less than four units in the last place of |n|·|x|; each n_k
  // by `off` more.
  constexpr double kRounded = 4 * 0x1p-52;
  double most = -std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < body.vertices.cols(); ++i) {
    const Vector3d x = body.vertices.col(i), size = x.cwiseAbs();
    const double error = Above(Above(off.dot(size) * (1.0 + kRounded)) +
                               kRounded * middle.cwiseAbs().dot(size) * (1.0 + kRounded));
    most = std::max(most, Above(middle.dot(x) + error));
  }
  const Interval length = Sqrt(Square(n[0]) + Square(n[1]) + Square(n[2]));
  const Interval of_disc = Sqrt(Square(n[0]) + Square(n[1])) * Interval(body.disc_radius);
  return Interval(most) + of_disc + length * Interval(body.ball_radius) + Dot(n_W, X.p);
}

}  // namespace

SeparationHint HintOf(const ConvexBody& a, const Eigen::Isometry3d& X_WA, const ConvexBody& b,
                      const Eigen::Isometry3d& X_WB) {
  const auto farthest = [&](const Vector3d& d) -> Vector3d {  // of b ⊖ a, against d
    const Vector3d of_b = X_WB * SupportPoint(b, X_WB.linear().transpose() * -d);
    const Vector3d of_a = X_WA * SupportPoint(a, X_WA.linear().transpose() * d);
    return of_b - of_a;
  };
  Vector3d nearest = X_WB * b.center - X_WA * a.center;
  if (nearest.squaredNorm() == 0.0) nearest = Vector3d::UnitZ();
  std::vector<Vector3d> points = {farthest(nearest)};
  nearest = points.front();
  SeparationHint best;
  best.distance = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < 64; ++i) {
    const double length = nearest.norm();
    if (length < 1e-12) break;
    const Vector3d next = farthest(nearest);
    const double along = next.dot(nearest) / length;
    if (along > best.distance) best = {along, nearest / length};
    if (length - along < 1e-10) break;
    points.push_back(next);
    nearest = NearestInHull(&points);
  }
  return best;
}

double GapAlong(const Eigen::Vector3d& n, const ConvexBody& a, const Frame& X_WA,
                const ConvexBody& b, const Frame& X_WB) {
  const Vector along = VectorOf(n);
  const Interval gap = -SupportAlong(-along, b, X_WB) - SupportAlong(along, a, X_WA);
  const Interval length = Sqrt(Square(along[0]) + Square(along[1]) + Square(along[2]));
  return gap.lo > 0.0 ? Below(gap.lo / length.hi) : Below(gap.lo / length.lo);
}

double LeastAlong(const Eigen::Vector3d& n, const ConvexBody& body, const Frame& X) {
  return -SupportAlong(-VectorOf(n), body, X).hi;
}

}  // namespace halfstep::checker
