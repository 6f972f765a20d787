#include "smoothing/margins/support_edges.h"

#include <limits>

namespace halfstep {

using Eigen::Vector2d;

SupportEdges::SupportEdges(const SuperposedWalk& walk, const LocalTime& at, const WalkState& x,
                           const Vector2d& sole_size)
    : polygon_(SupportAt(walk, at, x, sole_size)), x_(x), sole_size_(sole_size) {}

Vector2d SupportEdges::MoveOf(const Vector2d& corner, const WalkState& dx) const {
  // It is a corner of that sole which has one there.
  double nearest = std::numeric_limits<double>::infinity();
  Vector2d move(0, 0);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Pose2 X_WF = FootPose(x_, side);
    const double distance =
        (SoleCorners(X_WF, sole_size_).colwise() - corner).colwise().norm().minCoeff();
    if (!(distance < nearest)) continue;
    nearest = distance;
    const Vector2d arm = corner - X_WF.position();
    const int foot = FootIndex(side);
    move = dx.segment<2>(foot) + dx[foot + 3] * Vector2d(-arm.y(), arm.x());
  }
  return move;
}

double SupportEdges::Slope(int i, const Vector2d& inward, const Vector2d& p, const Vector2d& dp,
                           const WalkSensitivity& along) const {
  if (Traits(along.parameter.family).move == nullptr) return inward.dot(dp);  // soles rest
  const Vector2d a = polygon_.corner(i), b = polygon_.corner((i + 1) % polygon_.size());
  const Vector2d edge = b - a;
  const double share = edge.dot(p - a) / edge.squaredNorm();
  const WalkState& dx = along.jet.value;
  return inward.dot(dp - (1.0 - share) * MoveOf(a, dx) - share * MoveOf(b, dx));
}

}  // namespace halfstep
