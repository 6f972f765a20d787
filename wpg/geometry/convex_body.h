#pragma once

#include <Eigen/Core>
#include <vector>

#include "wpg/geometry/direction_map.h"

namespace halfstep {

/// A convex body in its own frame: the Minkowski sum of
///   the convex hull of `vertices`, a disc of `disc_radius` in the local xy plane, and a ball of
///   `ball_radius`.
/// So a sphere is one vertex and a ball, a capsule two vertices and a ball, a cylinder two vertices
/// and a disc, a box eight vertices, a mesh the vertices of its hull: all exact, one support
/// function.
struct ConvexBody {
  /// [m] (3×n), n ≥ 1, extreme points only. Row-major, which makes Support() 1.7 times as fast (40
  /// vertices).
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor> vertices;
  Eigen::Matrix3Xd normals;  ///< outward unit face normals (3×m); empty when n < 4.
  std::vector<Eigen::Vector3i>
      triangles;                    ///< faces, counter-clockwise from outside; empty when n < 4.
  double disc_radius = 0.0;         ///< [m] ≥ 0
  double ball_radius = 0.0;         ///< [m] ≥ 0
  Eigen::Vector3d center{0, 0, 0};  ///< centre of a sphere that contains the body [m].
  double radius = 0.0;              ///< its radius [m].
  /// Of `vertices`, for Support and FarthestVertex; empty: they look at all vertices. See
  /// MapDirections.
  DirectionMap directions;
};

/// h(d) = max over the body of d·x [m] for a unit direction d in the body's frame.
double Support(const ConvexBody& body, const Eigen::Vector3d& direction);
/// Index of the vertex that is farthest along `direction`, which may have any length.
int FarthestVertex(const ConvexBody& body, const Eigen::Vector3d& direction);
/// A point of the body where d·x is largest [m]; any d ≠ 0.
Eigen::Vector3d SupportPoint(const ConvexBody& body, const Eigen::Vector3d& direction);

/// Recomputes `center` and `radius` from the other members: small, not minimal, and containing
/// (relative margin 1e-12).
void BoundBySphere(ConvexBody* body);

/// Makes `directions` from `vertices` where it makes Support faster: for more than a few vertices.
/// No answer changes. For bodies whose vertices stay as they are; who moves them has to call it
/// again.
void MapDirections(ConvexBody* body);

/// Axis-aligned box of full edge lengths `size` [m], centred at the origin. Precondition, here and
/// below: finite positive sizes (std::logic_error).
ConvexBody MakeBox(const Eigen::Vector3d& size);
/// Ball of `radius` [m] around the origin.
ConvexBody MakeSphere(double radius);
/// Cylinder of `length` [m] along z, centred at the origin.
ConvexBody MakeCylinder(double radius, double length);
/// Capsule along z: the two ball centres are `length` [m] apart.
ConvexBody MakeCapsule(double radius, double length);
/// Convex hull of `points` (3×n) [m]: its vertices are points of them, exactly, and it contains all
/// of them, for it is the hull of its vertices with a ball around whose radius is how far a point
/// may lie outside. 0 when all points are vertices, else of the order of rounding (1e-15 of the
/// coordinates), or 1e-12 of the size where points so near to each other were merged. Throws
/// std::runtime_error with a sentence when the points are fewer than four, not finite, or (nearly)
/// coplanar: thinner than 1e-9 of their size.
ConvexBody MakeHull(const Eigen::Matrix3Xd& points);

}  // namespace halfstep
