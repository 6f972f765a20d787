#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <variant>

#include "wpg/geometry/convex_body.h"

namespace halfstep {

class VoxelSet;

/// A box centred at the origin of its frame, with edges along the axes.
struct Box {
  Eigen::Vector3d size{0, 0, 0};  ///< full edge lengths [m] > 0
};
/// A ball centred at the origin of its frame.
struct Sphere {
  double radius = 0.0;  ///< [m] > 0
};
/// A cylinder along z, centred at the origin of its frame.
struct Cylinder {
  double radius = 0.0, length = 0.0;  ///< [m] > 0
};
/// A capsule along z, centred at the origin of its frame.
struct Capsule {
  double radius = 0.0;  ///< [m] > 0
  double length = 0.0;  ///< between the centres of its two balls [m] > 0
};
/// A triangle mesh, which need be neither convex nor closed.
struct TriangleMesh {
  Eigen::Matrix3Xd vertices;   ///< [m] (3×n)
  Eigen::Matrix3Xi triangles;  ///< (3×m), indices of vertices.
  /// Only the surface is in the way. What it surrounds is room, in which the robot may stand.
  bool hollow = false;
  /// When set, the triangles are the surface of these cubes (VoxelSet::Surface), and these are all
  /// that is inside.
  std::shared_ptr<const VoxelSet> cubes = nullptr;
};

/// What an obstacle is made of, in the type that the scene file names, so that no query has to
/// guess it.
using Shape = std::variant<Box, Sphere, Cylinder, Capsule, ConvexBody, TriangleMesh>;

/// The convex body that a shape is; a mesh is returned as it is. The preconditions are those of
/// MakeBox, MakeSphere, MakeCylinder and MakeCapsule.
inline ConvexBody BodyOf(const Box& box) { return MakeBox(box.size); }
/// A ball around the origin.
inline ConvexBody BodyOf(const Sphere& sphere) { return MakeSphere(sphere.radius); }
/// A cylinder along z.
inline ConvexBody BodyOf(const Cylinder& c) { return MakeCylinder(c.radius, c.length); }
/// A capsule along z.
inline ConvexBody BodyOf(const Capsule& c) { return MakeCapsule(c.radius, c.length); }
/// The body itself.
inline const ConvexBody& BodyOf(const ConvexBody& body) { return body; }
/// The mesh itself.
inline const TriangleMesh& BodyOf(const TriangleMesh& mesh) { return mesh; }

/// A distance from the origin of its frame that no point of a shape exceeds [m]. The preconditions
/// are those of BodyOf.
double RadiusAboutOrigin(const Shape& shape);

/// A box along the world's axes that holds a shape at a pose [m], wider by the rounding of its
/// coordinates and of its mesh's hull, 1e-12 of them. The preconditions are those of BodyOf.
Eigen::AlignedBox3d BoundsOf(const Shape& shape, const Eigen::Isometry3d& X_WO);

/// The faces of the convex hull of a body's vertices, without its disc and its ball. There are none
/// when it has fewer than 4 vertices.
TriangleMesh FacesOf(const ConvexBody& body);

}  // namespace halfstep
