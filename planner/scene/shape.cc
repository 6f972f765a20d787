#include "planner/scene/shape.h"

#include <cmath>
#include <type_traits>

#include "planner/scene/shape_extents.h"
#include "wpg/check.h"

namespace halfstep {
namespace {

double Positive(double value) {
  HALFSTEP_CHECK(std::isfinite(value) && value > 0.0, "a size of " << value << " m");
  return value;
}

// h(d) of a shape along a unit direction in its frame [m]: to the bit that of Support() of its
// body, which takes long to make.
double Along(const Box& box, const Eigen::Vector3d& d) {
  const Eigen::Vector3d far = HalfExtents(box).cwiseProduct(d).cwiseAbs();
  return far.x() + far.y() + far.z();
}
double Along(const Sphere& sphere, const Eigen::Vector3d&) { return HalfExtents(sphere).x(); }
double Along(const Cylinder& cylinder, const Eigen::Vector3d& d) {
  const Eigen::Vector3d half = HalfExtents(cylinder);
  return std::fabs(half.z() * d.z()) + half.x() * std::sqrt(d.x() * d.x() + d.y() * d.y());
}
double Along(const Capsule& capsule, const Eigen::Vector3d& d) {
  return std::fabs(0.5 * Positive(capsule.length) * d.z()) + Positive(capsule.radius);
}
double Along(const ConvexBody& body, const Eigen::Vector3d& d) { return Support(body, d); }

}  // namespace

Eigen::Vector3d HalfExtents(const Box& box) {
  return 0.5 *
         Eigen::Vector3d(Positive(box.size.x()), Positive(box.size.y()), Positive(box.size.z()));
}

Eigen::Vector3d HalfExtents(const Sphere& sphere) {
  return Eigen::Vector3d::Constant(Positive(sphere.radius));
}

Eigen::Vector3d HalfExtents(const Cylinder& cylinder) {
  const double radius = Positive(cylinder.radius);
  return {radius, radius, 0.5 * Positive(cylinder.length)};
}

Eigen::Vector3d HalfExtents(const Capsule& capsule) {
  const double radius = Positive(capsule.radius);
  return {radius, radius, 0.5 * Positive(capsule.length) + radius};
}

double RadiusAboutOrigin(const Shape& shape) {
  return std::visit(
      [](const auto& s) {
        const auto& body = BodyOf(s);
        double radius = body.vertices.colwise().norm().maxCoeff();
        if constexpr (!std::is_same_v<std::decay_t<decltype(s)>, TriangleMesh>) {
          radius += body.disc_radius + body.ball_radius;
        }
        return radius;
      },
      shape);
}

TriangleMesh FacesOf(const ConvexBody& body) {
  TriangleMesh mesh;
  mesh.vertices = body.vertices;
  mesh.triangles.resize(3, static_cast<Eigen::Index>(body.triangles.size()));
  for (size_t i = 0; i < body.triangles.size(); ++i) {
    mesh.triangles.col(static_cast<Eigen::Index>(i)) = body.triangles[i];
  }
  return mesh;
}

Eigen::AlignedBox3d BoundsOf(const Shape& shape, const Eigen::Isometry3d& X_WO) {
  Eigen::AlignedBox3d bounds;
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) {
    for (const Eigen::Vector3d& p : mesh->vertices.colwise()) bounds.extend(X_WO * p);
  } else {
    std::visit(
        [&](const auto& s) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(s)>, TriangleMesh>) {
            for (int axis = 0; axis < 3; ++axis) {
              const Eigen::Vector3d direction = X_WO.linear().row(axis);
              const double origin = X_WO.translation()[axis];
              bounds.max()[axis] = origin + Along(s, direction);
              bounds.min()[axis] = origin - Along(s, -direction);
            }
          }
        },
        shape);
  }
  // Also for what a mesh's hull is widened by.
  const double rounding = 1e-12 * (1 + bounds.min().norm() + bounds.max().norm());
  bounds.max().array() += rounding;
  bounds.min().array() -= rounding;
  return bounds;
}

}  // namespace halfstep
