#include "wpg/motion/sole_section.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace halfstep {
namespace {

using Eigen::Vector2d;

// A bound of ρ by one edge's normal, linear in λ, with its gradient with respect to p.
struct RoomBound {
  double left = 0.0, right = 0.0;  // at λ = 0 and 1
  Vector2d normal{0, 0};

  double At(double share) const { return (1.0 - share) * left + share * right; }
  double slope() const { return right - left; }
};
using RoomBounds = std::array<RoomBound, 8>;

double Least(const RoomBounds& bounds, double share) {
  double least = std::numeric_limits<double>::infinity();
  for (const RoomBound& bound : bounds) least = std::min(least, bound.At(share));
  return least;
}

// How far p is inside of a sole along an inward normal.
double Depth(const Pose2& X_WF, const Vector2d& sole_size, const Vector2d& p, const Vector2d& n) {
  const Vector2d n_F = X_WF.rotation().transpose() * n;
  return n.dot(p - X_WF.position()) + 0.5 * sole_size.dot(n_F.cwiseAbs());
}

// The middle of all λ of [0, 1] at which the least bound is largest: it is concave, and largest at
// an end or where two of the bounds cross.
double BestShare(const RoomBounds& bounds) {
  constexpr double kEqual = 1e-12;
  double best = -std::numeric_limits<double>::infinity(), first = 0.0, last = 0.0;
  const auto consider = [&](double share) {
    const double least = Least(bounds, share);
    if (least < best - kEqual) return;
    if (least > best + kEqual) first = last = share;
    best = std::max(best, least);
    first = std::min(first, share);
    last = std::max(last, share);
  };
  consider(0.0);
  consider(1.0);
  for (size_t i = 0; i < bounds.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      const double apart = bounds[i].slope() - bounds[j].slope();
      if (apart == 0.0) continue;
      const double share = (bounds[j].left - bounds[i].left) / apart;
      if (share > 0.0 && share < 1.0) consider(share);
    }
  }
  return 0.5 * (first + last);
}

// The gradient of the largest least bound: that of the bound that is least there, or, where λ is
// held between one that falls and one that grows, of their mixture that does neither.
Vector2d GradientAt(const RoomBounds& bounds, double share) {
  constexpr double kEqual = 1e-10;
  const double least = Least(bounds, share);
  const RoomBound *falls = nullptr, *grows = nullptr;
  for (const RoomBound& bound : bounds) {
    if (bound.At(share) > least + kEqual) continue;
    const bool up = bound.slope() > 0.0;
    const RoomBound*& of = up ? grows : falls;
    if (of == nullptr || std::abs(bound.slope()) < std::abs(of->slope())) of = &bound;
  }
  if (grows == nullptr || (falls != nullptr && share <= 0.0)) return falls->normal;
  if (falls == nullptr || share >= 1.0) return grows->normal;
  const double of_grows = -falls->slope() / (grows->slope() - falls->slope());
  return (1.0 - of_grows) * falls->normal + of_grows * grows->normal;
}

}  // namespace

// The section's edges have the normals of the soles' edges, and its depth along one is linear in λ.
SoleSection SoleSection::Widest(const Pose2& X_WL, const Pose2& X_WR, const Vector2d& sole_size,
                                const std::array<Vector2d, 2>& crosses) {
  const Eigen::Matrix2d of_left = X_WL.rotation(), of_right = X_WR.rotation();
  const std::array<Vector2d, 4> axes = {of_left.col(0), of_left.col(1), of_right.col(0),
                                        of_right.col(1)};
  RoomBounds depths;
  for (size_t i = 0; i < depths.size(); ++i) {
    const Vector2d n = (i % 2 == 0 ? 1.0 : -1.0) * axes[i / 2];
    depths[i] = {Depth(X_WL, sole_size, crosses[0], n), Depth(X_WR, sole_size, crosses[1], n), n};
  }
  SoleSection best;
  best.room = -std::numeric_limits<double>::infinity();
  for (const Vector2d& u : axes) {
    RoomBounds bounds = depths;
    for (RoomBound& bound : bounds) {
      const double share = std::max(std::abs(bound.normal.dot(u)), kAround);
      bound = {bound.left / share, bound.right / share, bound.normal / share};
    }
    const double share = BestShare(bounds), room = Least(bounds, share);
    if (!(room > best.room)) continue;
    best = {share, u, room, GradientAt(bounds, share)};
  }
  return best;
}

}  // namespace halfstep
