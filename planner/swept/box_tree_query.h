#pragma once

#include <Eigen/Core>

#include "planner/collision/triangle_tree.h"
#include "planner/swept/box_tree.h"
#include "planner/swept/oriented_box.h"

namespace halfstep {

/// Whether something meets the region of a BoxTree, everything closed and solid: an obstacle inside
/// the region meets it, and so does one around it. "No" is proved; rounding says "yes".
/// `extra` [m] ≥ 0: the region's boxes count as larger by this on every side; a "no" then says that
/// the region is more than `extra` away.

/// `root`: a copy of the tree's first node, which is nearer at hand than the node itself; null:
/// none.

/// For a box. Exact within 1e-5 of the coordinates and sizes.
bool Meets(const BoxTree& tree, const OrientedBox& box, double extra = 0.0,
           const BoxNode* root = nullptr);

/// A sphere, capsule or cylinder: the sum of a segment on the local z axis, a disc in the local xy
/// plane and a ball.
struct RoundBody {
  double half_length = 0.0;  ///< of the segment [m]
  double disc_radius = 0.0;  ///< [m]
  double ball_radius = 0.0;  ///< [m]
};
/// For a round body at (axes, center). Exact but for bodies so near that 64 alternating projections
/// do not tell: these meet.
bool Meets(const BoxTree& tree, const RoundBody& body, const Eigen::Vector3d& center,
           const Eigen::Matrix3d& axes, double extra = 0.0, const BoxNode* root = nullptr);

/// For the triangles of a mesh at (axes, origin): its surface only.
bool Meets(const BoxTree& tree, const TriangleTree& mesh, const Eigen::Vector3d& origin,
           const Eigen::Matrix3d& axes, double extra = 0.0);

}  // namespace halfstep
