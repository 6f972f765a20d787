#include "planner/scene/shape.h"

namespace halfstep {

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
