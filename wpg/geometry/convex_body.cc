#include "wpg/geometry/convex_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "wpg/check.h"
#include "wpg/elementary.h"

namespace halfstep {
namespace {

bool HasVertex(const ConvexBody& body, const Eigen::Vector3d& p) {
  return (body.vertices.colwise() - p).colwise().squaredNorm().minCoeff() == 0.0;
}

double FarthestFrom(const ConvexBody& body, const Eigen::Vector3d& center, int* vertex) {
  double farthest = -1.0;
  for (int i = 0; i < static_cast<int>(body.vertices.cols()); ++i) {
    const Eigen::Vector3d d = body.vertices.col(i) - center;
    const double reach = Hypot(d.head<2>().norm() + body.disc_radius, d.z());
    if (reach > farthest) {
      farthest = reach;
      *vertex = i;
    }
  }
  return farthest + body.ball_radius;
}

ConvexBody MakeSegment(double length) {
  ConvexBody body;
  body.vertices.resize(3, 2);
  body.vertices << 0, 0, 0, 0, -length / 2, length / 2;
  return body;
}

// Rounded by discs or balls about the segment.
ConvexBody MakeRound(double radius, double length, double ConvexBody::*rounding) {
  HALFSTEP_CHECK(std::isfinite(radius) && radius > 0, "radius = " << radius);
  HALFSTEP_CHECK(std::isfinite(length) && length > 0, "length = " << length);
  ConvexBody body = MakeSegment(length);
  body.*rounding = radius;
  BoundBySphere(&body);
  return body;
}

}  // namespace

double Support(const ConvexBody& body, const Eigen::Vector3d& direction) {
  const double x = direction.x(), y = direction.y(), z = direction.z();
  const auto& v = body.vertices;
  const std::span<const int32_t> few = body.directions.Along(direction);
  double farthest = -std::numeric_limits<double>::infinity();
  for (const int32_t i : few) {
    farthest = std::max(farthest, v(0, i) * x + v(1, i) * y + v(2, i) * z);
  }
  if (few.empty()) {
    farthest = (v.row(0) * x + v.row(1) * y + v.row(2) * z).maxCoeff();
  }
  if (body.disc_radius > 0) farthest += body.disc_radius * std::sqrt(x * x + y * y);
  return farthest + body.ball_radius;
}

int FarthestVertex(const ConvexBody& body, const Eigen::Vector3d& direction) {
  const double x = direction.x(), y = direction.y(), z = direction.z();
  const Eigen::Index n = body.vertices.cols();
  const double *xs = body.vertices.data(), *ys = xs + n, *zs = ys + n;
  double best = -std::numeric_limits<double>::infinity();
  Eigen::Index farthest = 0;
  const auto look_at = [&](Eigen::Index i) {
    const double along = xs[i] * x + ys[i] * y + zs[i] * z;
    if (along > best) {
      best = along;
      farthest = i;
    }
  };
  const std::span<const int32_t> few = body.directions.Along(direction);
  for (const int32_t i : few) look_at(i);
  if (few.empty()) {
    for (Eigen::Index i = 0; i < n; ++i) look_at(i);
  }
  return static_cast<int>(farthest);
}

Eigen::Vector3d SupportPoint(const ConvexBody& body, const Eigen::Vector3d& direction) {
  Eigen::Vector3d point = body.vertices.col(FarthestVertex(body, direction));
  const double radial = direction.head<2>().norm();
  if (body.disc_radius > 0 && radial > 0) {
    point.head<2>() += body.disc_radius / radial * direction.head<2>();
  }
  if (body.ball_radius > 0) point += body.ball_radius * direction.normalized();
  return point;
}

// Badoiu & Clarkson 2003, "Smaller core-sets for balls": the centre walks towards the farthest
// point by 1/(i + 1). It starts at the middle of the axis-aligned bounds, often the best: it is
// when the farthest vertex has its mirror image there, as in boxes, cylinders and capsules.
void BoundBySphere(ConvexBody* body) {
  HALFSTEP_CHECK(body->vertices.cols() > 0, "a body without vertices");
  Eigen::Vector3d center =
      (body->vertices.rowwise().minCoeff() + body->vertices.rowwise().maxCoeff()) / 2;
  int vertex = 0;
  body->radius = std::numeric_limits<double>::infinity();
  for (int i = 1; i <= 100; ++i) {
    const double radius = FarthestFrom(*body, center, &vertex);
    if (radius < body->radius) {
      body->center = center;
      body->radius = radius;
    }
    if (i == 1 && HasVertex(*body, 2.0 * center - body->vertices.col(vertex))) break;
    center += (body->vertices.col(vertex) - center) / (i + 1);
  }
  body->radius += 1e-12 * (body->radius + body->center.norm());
}

void MapDirections(ConvexBody* body) {
  constexpr Eigen::Index kFew = 20;
  body->directions = body->vertices.cols() > kFew ? DirectionMap(body->vertices) : DirectionMap();
}

ConvexBody MakeBox(const Eigen::Vector3d& size) {
  HALFSTEP_CHECK(size.allFinite() && size.minCoeff() > 0, "size = " << size.transpose());
  ConvexBody body;
  body.vertices.resize(3, 8);
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d sign((i & 1) ? 0.5 : -0.5, (i & 2) ? 0.5 : -0.5, (i & 4) ? 0.5 : -0.5);
    body.vertices.col(i) = sign.cwiseProduct(size);
  }
  body.normals.resize(3, 6);
  body.normals << Eigen::Matrix3d::Identity(), -Eigen::Matrix3d::Identity();
  body.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  BoundBySphere(&body);
  return body;
}

ConvexBody MakeSphere(double radius) {
  HALFSTEP_CHECK(std::isfinite(radius) && radius > 0, "radius = " << radius);
  ConvexBody body;
  body.vertices = Eigen::Matrix3Xd::Zero(3, 1);
  body.ball_radius = radius;
  BoundBySphere(&body);
  return body;
}

ConvexBody MakeCylinder(double radius, double length) {
  return MakeRound(radius, length, &ConvexBody::disc_radius);
}

ConvexBody MakeCapsule(double radius, double length) {
  return MakeRound(radius, length, &ConvexBody::ball_radius);
}

}  // namespace halfstep
