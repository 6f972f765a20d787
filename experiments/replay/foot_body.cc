#include "experiments/replay/foot_body.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace halfstep::replay {
namespace {

// How far a body of one or two vertices reaches below the lower one.
double ReachBelow(const ConvexBody& body, const Eigen::Matrix3Xd& vertices) {
  if (body.disc_radius == 0.0 || vertices.cols() != 2) return body.ball_radius;
  const double rise = (vertices.col(1) - vertices.col(0)).normalized().z();
  return body.ball_radius + body.disc_radius * std::sqrt(std::max(0.0, 1.0 - rise * rise));
}

std::optional<ConvexBody> HullOf(const Eigen::Matrix3Xd& vertices) {
  try {
    return MakeHull(vertices);
  } catch (const std::runtime_error&) {
    return std::nullopt;  // next to nothing is left
  }
}

}  // namespace

std::optional<ConvexBody> AboveSole(const ConvexBody& body, const Eigen::Isometry3d& X_SoleBody,
                                    double least) {
  Eigen::Matrix3Xd vertices = X_SoleBody * Eigen::Matrix3Xd(body.vertices);
  const double lowest = least + ReachBelow(body, vertices);
  if (vertices.row(2).minCoeff() >= lowest) return body;
  if (vertices.row(2).maxCoeff() <= lowest) return std::nullopt;
  // Straight up: the cut itself where sides are upright.
  vertices.row(2) = vertices.row(2).cwiseMax(lowest);
  vertices = X_SoleBody.inverse() * vertices;
  if (vertices.cols() >= 4) return HullOf(vertices);
  ConvexBody shorter = body;
  shorter.vertices = vertices;
  BoundBySphere(&shorter);
  return shorter;
}

}  // namespace halfstep::replay
