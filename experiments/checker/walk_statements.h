#pragma once

#include <memory>
#include <string>
#include <vector>

#include "experiments/checker/interval_proof.h"
#include "experiments/checker/mesh_tree.h"
#include "experiments/checker/walk_state.h"
#include "experiments/verify/certificate_text.h"
#include "planner/scene/scene.h"

namespace halfstep::checker {

/// One statement about a walk: of all instants, or where it counts.
struct WalkStatement {
  verify::Family family = verify::kFloor;  ///< by which margin
  std::string subject = {};                ///< whose
  double demanded = 0.0;                   ///< [unit of the family]
  /// Side and joint; indices of a robot's bodies, of an obstacle, and of a solid of the ground
  /// behind the obstacles; unused.
  size_t a = 0, b = 0;
  Eigen::Vector3d direction{0, 0, 0};  ///< along which two bodies were separated last; 0: none
  bool told = false;                   ///< whether by others, so that no other one is looked for
  bool in_parts = false;               ///< it took an obstacle's triangles, not its hull
};

/// A convex polygon (2×n) as a flat body in the plane z = 0, or an upright prism.
ConvexBody PrismOver(const Eigen::Matrix2Xd& polygon, double bottom = 0.0, double top = 0.0);

/// Bounds of where the centre of a body's bounding sphere is at any instant.
Vector CenterAt(const FrameIn<Curve>& X_W, const ConvexBody& body);

/// Statements of a robot among obstacles, and how to look at them.
class WalkStatements {
 public:
  /// Borrows all but the obstacles' bodies.
  WalkStatements(const RobotModel& robot, const Scene& scene,
                 const verify::CertificateText& certificate);

  /// When obstacles set off or turn to where they go next [s]: no interval may reach across.
  std::vector<double> WaypointTimes() const;
  std::vector<WalkStatement>& all() { return all_; }  ///< of families that count at instants
  /// +∞ where a statement does not count. Throws NotDefined where nothing is known.
  Kept Look(WalkStatement* statement, WalkState* state) const;
  /// A convex body in motion, and bounds of where the centre of its sphere is.
  struct Placed {
    const ConvexBody& shape;    ///< in its own frame
    const FrameIn<Curve>& X_W;  ///< that frame
    const Vector& center;       ///< of its bounding sphere, in W [m]
  };
  /// How far two of them are apart along the best direction known [m]; `told`: along this one.
  static Kept Apart(const Placed& a, const Placed& b, double demanded, Eigen::Vector3d* direction,
                    bool told);

 private:
  Kept OfSwingFoot(WalkStatement* statement, const WalkState& state) const;
  // The solid of the ground that a clearance is from, or null.
  const GroundSolid* SolidOf(const WalkStatement& statement) const;
  Kept FromSolid(WalkStatement* statement, const Placed& moving) const;
  Kept FromObstacle(WalkStatement* statement, const Placed& moving, const WalkState& state) const;
  Kept FromMesh(WalkStatement* statement, const FrameIn<Curve>& X_WO, const Placed& moving,
                double demanded) const;
  Kept OfJoint(const WalkStatement& statement, WalkState* state) const;
  Kept OfBodies(WalkStatement* statement, WalkState* state) const;
  Kept Friction(WalkState* state) const;
  Kept Torque(const WalkStatement& statement, WalkState* state) const;

  const RobotModel& robot_;
  const Scene& scene_;
  const verify::CertificateText& certificate_;
  std::vector<ConvexBody> obstacles_;  ///< and the solids of the ground; of meshes what is around
  std::vector<std::unique_ptr<MeshTree>> meshes_;  ///< by obstacle; null: it is convex
  ConvexBody foot_;                                ///< seen from above, in its sole's plane
  std::vector<WalkStatement> all_;
};

}  // namespace halfstep::checker
