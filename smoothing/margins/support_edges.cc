#include "smoothing/margins/support_edges.h"

namespace halfstep {

using Eigen::Vector2d;

Side SupportEdges::SoleOf(const Vector2d& corner) const {
  return SoleWithCorner({PlaceOf(Side::kLeft), PlaceOf(Side::kRight)}, at_.robot().sole_size,
                        corner);
}

Pose2 SupportEdges::PlaceOf(Side side) const {
  return shadows_ == nullptr ? FootPose(at_.jet().value, side) : shadows_->place(side);
}

void SupportEdges::AddCorner(const Vector2d& corner, const Vector2d& weight,
                             WalkState* gradient) const {
  const Side of = SoleOf(corner);
  const Vector2d arm = corner - PlaceOf(of).position();
  const int foot = FootIndex(of);
  gradient->segment<2>(foot) += weight;
  if (shadows_ != nullptr) (*gradient)[foot + 2] -= weight.dot(shadows_->tilt());
  (*gradient)[foot + 3] += weight.dot(Vector2d(-arm.y(), arm.x()));
}

double SupportEdges::Share(int i, const Vector2d& p) const {
  const Vector2d a = polygon_.corner(i), b = polygon_.corner((i + 1) % polygon_.size());
  const Vector2d edge = b - a;
  return edge.dot(p - a) / edge.squaredNorm();
}

WalkState SupportEdges::BySoles(int i, const Vector2d& inward, const Vector2d& p) const {
  const Vector2d a = polygon_.corner(i), b = polygon_.corner((i + 1) % polygon_.size());
  const double share = Share(i, p);
  WalkState gradient = WalkState::Zero();
  AddCorner(a, -(1.0 - share) * inward, &gradient);
  AddCorner(b, -share * inward, &gradient);
  return gradient;
}

double SupportEdges::HeightBeside(int i, const Vector2d& p) const {
  if (shadows_ == nullptr) return at_.heights().middle();
  const auto height_of = [&](int corner) {
    return shadows_->heights().of(SoleOf(polygon_.corner(corner % polygon_.size())));
  };
  const double share = Share(i, p);
  return (1.0 - share) * height_of(i) + share * height_of(i + 1);
}

}  // namespace halfstep
