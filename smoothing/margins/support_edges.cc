#include "smoothing/margins/support_edges.h"

#include <limits>

namespace halfstep {

using Eigen::Vector2d;

void SupportEdges::AddCorner(const Vector2d& corner, const Vector2d& weight,
                             WalkState* gradient) const {
  const WalkState& x = at_.jet().value;
  // It is a corner of that sole which has one there.
  double nearest = std::numeric_limits<double>::infinity();
  Side of = Side::kLeft;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const auto corners = SoleCorners(FootPose(x, side), at_.robot().sole_size);
    const double distance = (corners.colwise() - corner).colwise().norm().minCoeff();
    if (!(distance < nearest)) continue;
    nearest = distance;
    of = side;
  }
  const Vector2d arm = corner - FootPose(x, of).position();
  const int foot = FootIndex(of);
  gradient->segment<2>(foot) += weight;
  (*gradient)[foot + 3] += weight.dot(Vector2d(-arm.y(), arm.x()));
}

WalkState SupportEdges::BySoles(int i, const Vector2d& inward, const Vector2d& p) const {
  const Vector2d a = polygon_.corner(i), b = polygon_.corner((i + 1) % polygon_.size());
  const Vector2d edge = b - a;
  const double share = edge.dot(p - a) / edge.squaredNorm();
  WalkState gradient = WalkState::Zero();
  AddCorner(a, -(1.0 - share) * inward, &gradient);
  AddCorner(b, -share * inward, &gradient);
  return gradient;
}

}  // namespace halfstep
