#include "planner/scene/shape.h"

#include <type_traits>

namespace halfstep {

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
    const auto extend = [&](const ConvexBody& body) {
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d direction = X_WO.linear().row(axis);
        const double origin = X_WO.translation()[axis];
        bounds.max()[axis] = origin + Support(body, direction);
        bounds.min()[axis] = origin - Support(body, -direction);
      }
    };
    std::visit(
        [&extend](const auto& s) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(s)>, TriangleMesh>) extend(BodyOf(s));
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
