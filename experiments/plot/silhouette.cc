#include "experiments/plot/silhouette.h"

#include <variant>

#include "experiments/report/drawn_mesh.h"
#include "wpg/geometry/planar_hull.h"

namespace halfstep::plot {
namespace {

TriangleMesh SurfaceOf(const ConvexBody& body) { return DrawnMesh(body); }
TriangleMesh SurfaceOf(const TriangleMesh& mesh) { return mesh; }

}  // namespace

std::vector<std::vector<Eigen::Vector2d>> Silhouette(const Obstacle& obstacle, int first,
                                                     int second) {
  const TriangleMesh surface =
      std::visit([](const auto& shape) { return SurfaceOf(BodyOf(shape)); }, obstacle.shape);
  std::vector<Eigen::Vector2d> points;
  for (const auto& vertex : surface.vertices.colwise()) {
    const Eigen::Vector3d p = obstacle.X_WO * vertex;
    points.emplace_back(p[first], p[second]);
  }
  if (points.empty()) return {};
  std::vector<std::vector<Eigen::Vector2d>> polygons;
  if (!std::holds_alternative<TriangleMesh>(obstacle.shape)) {
    std::vector<Eigen::Vector2d> hull(2 * points.size() + 1);
    hull.resize(PlanarHull(points, hull));
    polygons.push_back(std::move(hull));
    return polygons;
  }
  for (const auto& triangle : surface.triangles.colwise()) {
    std::vector<Eigen::Vector2d> corners;
    for (int k = 0; k < 3; ++k) corners.push_back(points[static_cast<size_t>(triangle[k])]);
    polygons.push_back(std::move(corners));
  }
  return polygons;
}

}  // namespace halfstep::plot
