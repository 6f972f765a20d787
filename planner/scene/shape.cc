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

}  // namespace halfstep
