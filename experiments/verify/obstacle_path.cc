#include "experiments/verify/obstacle_path.h"

#include <algorithm>
#include <cmath>

namespace halfstep::verify {
namespace {

// A piece of the known motion: from one place to the next.
struct Piece {
  double begin, end;
  Eigen::Vector3d from, to;
  double yaw_from, yaw_to;
};

// Calls visit(piece) for each, in order.
template <typename Visit>
void ForPieces(const Obstacle& obstacle, const Visit& visit) {
  Piece piece{0, 0, obstacle.X_WO.translation(), obstacle.X_WO.translation(), 0, 0};
  for (const auto& waypoint : obstacle.motion.waypoints) {
    piece = {piece.end, waypoint.t, piece.to, waypoint.translation, piece.yaw_to, waypoint.yaw};
    visit(piece);
  }
}

}  // namespace

Eigen::Isometry3d ObstaclePath::At(double t) const {
  Eigen::Vector3d place = obstacle_.X_WO.translation();
  double yaw = 0;
  ForPieces(obstacle_, [&](const Piece& piece) {
    if (t < piece.begin) return;
    const double done = std::min(1.0, (t - piece.begin) / (piece.end - piece.begin));
    place = (1 - done) * piece.from + done * piece.to;
    yaw = (1 - done) * piece.yaw_from + done * piece.yaw_to;
  });
  const double c = std::cos(yaw), s = std::sin(yaw);
  Eigen::Matrix3d turn;
  turn << c, -s, 0, s, c, 0, 0, 0, 1;
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = turn * obstacle_.X_WO.linear();
  X.translation() = place;
  return X;
}

double ObstaclePath::Uncertainty(double t) const {
  const ObstacleMotion& said = obstacle_.motion;
  double passed = t < said.measured_at ? said.measured_at - t : t - said.measured_at;
  if (passed > said.horizon) passed = said.horizon;
  return said.error + said.speed * passed;
}

double ObstaclePath::FastestWithin(double begin, double end) const {
  double fastest = 0;
  ForPieces(obstacle_, [&](const Piece& piece) {
    if (piece.end <= begin || piece.begin >= end) return;
    const double way =
        (piece.to - piece.from).norm() + radius_ * std::abs(piece.yaw_to - piece.yaw_from);
    fastest = std::max(fastest, way / (piece.end - piece.begin));
  });
  return fastest + obstacle_.motion.speed;
}

}  // namespace halfstep::verify
