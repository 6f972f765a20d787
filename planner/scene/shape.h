#pragma once

#include <Eigen/Core>
#include <variant>

#include "wpg/geometry/convex_body.h"

namespace halfstep {

/// Centred at the origin of its frame, edges along the axes.
struct Box {
  Eigen::Vector3d size{0, 0, 0};  ///< full edge lengths [m] > 0
};
struct Sphere {
  double radius = 0.0;  ///< [m] > 0
};
/// Along z, centred.
struct Cylinder {
  double radius = 0.0, length = 0.0;  ///< [m] > 0
};
/// Along z, centred.
struct Capsule {
  double radius = 0.0;  ///< [m] > 0
  double length = 0.0;  ///< between the centres of its two balls [m] > 0
};
/// Triangle mesh: not assumed convex or closed.
struct TriangleMesh {
  Eigen::Matrix3Xd vertices;   ///< [m] (3×n)
  Eigen::Matrix3Xi triangles;  ///< (3×m), vertex indices.
};

/// What an obstacle is made of, as the scene file says it: no query has to guess it.
using Shape = std::variant<Box, Sphere, Cylinder, Capsule, ConvexBody, TriangleMesh>;

/// The body that a shape is; a mesh stays one. Preconditions as for MakeBox and the like.
inline ConvexBody BodyOf(const Box& box) { return MakeBox(box.size); }
inline ConvexBody BodyOf(const Sphere& sphere) { return MakeSphere(sphere.radius); }
inline ConvexBody BodyOf(const Cylinder& c) { return MakeCylinder(c.radius, c.length); }
inline ConvexBody BodyOf(const Capsule& c) { return MakeCapsule(c.radius, c.length); }
inline const ConvexBody& BodyOf(const ConvexBody& body) { return body; }
inline const TriangleMesh& BodyOf(const TriangleMesh& mesh) { return mesh; }

/// The faces of a convex body's core, the body without its ball; none when it has fewer than 4
/// vertices.
TriangleMesh FacesOf(const ConvexBody& body);

}  // namespace halfstep
