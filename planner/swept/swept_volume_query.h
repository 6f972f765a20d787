#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "planner/collision/mesh_interior.h"
#include "planner/collision/triangle_tree.h"
#include "planner/ground/level_borders.h"
#include "planner/scene/no_step_areas.h"
#include "planner/scene/scene.h"
#include "planner/search/half_step_query.h"
#include "planner/swept/box_tree_query.h"
#include "planner/swept/obstacle_places.h"
#include "planner/swept/swept_volumes.h"
#include "wpg/geometry/bounds_tree.h"
#include "wpg/geometry/foothold.h"

namespace halfstep {

/// Swept volumes against a scene. A half-step is free when its volume meets no obstacle, and then
/// the robot is at least the baked clearance from all of them for all t. An obstacle that moves, or
/// of which not all is known, counts wherever it may be at any time (PlacesOf): what is free is
/// free whenever it is executed. Queries are const and thread-safe; SetObstaclePose is not.
/// On ground with solids (a set on levels) all bodies but the feet keep off all solids, and each
/// foot off those that are higher than where it stands: the foot that swings off those that are
/// higher than its own footstep of that half-step. Source: planner/README.md, "On levels". Exact up
/// to rounding (1e-5) for boxes, spheres, capsules, cylinders and triangles; a mesh is its surface
/// and what it winds around.
class SweptVolumeQuery : public HalfStepQuery {
 public:
  /// `volumes` is borrowed and must outlive this. A landing sole, of the outline
  /// RobotModel::sole_outline (2×k) [m], keeps `no_step` ≥ 0 [m] from the no-step areas and touches
  /// none. Soles stand at the ground's one level, or on levels where their outline is inside that
  /// of their height by `foothold` ≥ 0 [m] (LevelBorders): what does not is not free. Half-steps
  /// are executed at times of [0, until] [s]. Precondition: finite poses, volumes for each element,
  /// a set on levels or ground of one level without solids (std::logic_error). Throws InputError as
  /// PlacesOf.
  SweptVolumeQuery(const SweptVolumes& volumes, const Eigen::Matrix2Xd& sole_outline,
                   const Scene& scene, double no_step = 0.0,
                   double until = std::numeric_limits<double>::infinity(), double foothold = 0.0);

  bool DownIsFree(int i, Side support, const Foothold& X_WS) const override;
  bool UpIsFree(int i, Side support, const Foothold& X_WS) const override;
  bool Bears(const Foothold& X_WF) const override;

  /// A distance [m] from the volume (so from the robot: the baked clearance more) that is free of
  /// obstacles in all directions of the axes; 0 when the half-step is not free. Found by halving to
  /// 1 mm; at most `cap` [m]. No-step areas do not count.
  double DownClearance(int i, Side support, const Foothold& X_WS, double cap) const;
  /// The same of the up half-step.
  double UpClearance(int i, Side support, const Foothold& X_WS, double cap) const;

  /// Moves one obstacle of the scene; the others stay as they are prepared, and so does how far it
  /// is grown. Precondition: it has no waypoints (std::logic_error).
  void SetObstaclePose(int obstacle, const Eigen::Isometry3d& X_WO);

 private:
  struct Mesh {
    explicit Mesh(const TriangleMesh& mesh) : triangles(mesh), interior(mesh) {}
    TriangleTree triangles;
    MeshInterior interior;
  };
  struct Prepared {
    OrientedBox around;  // in its own frame; of a box, itself
    std::variant<std::monostate, RoundBody, std::shared_ptr<const Mesh>> shape;  // none: the box
    OrientedBox around_W;
    Eigen::Isometry3d X_WO;
    double extra = 0.0;  // by which it is grown [m]
    // Of a solid of the ground [m]; an obstacle has none, and is never left out.
    double top = std::numeric_limits<double>::infinity();

    void BeMesh(const TriangleMesh& mesh);
  };
  // An upright cylinder around a place.
  struct Upright {
    Eigen::Vector3d center;
    double radius, half_height;
  };
  // Four of them, side by side.
  struct Cylinders {
    float x[4], y[4], radius[4], z[4], half_height[4];
  };
  // A volume's bounds and first node, apart from its tree: most queries read nothing else.
  struct Bounds {
    Eigen::Vector3d middle, half;
    bool empty = true;
    BoxNode root;
  };
  struct Placed {
    const std::optional<BoxTree>& volume;
    const Bounds& bounds;
    bool mirrored;
    Foothold X_WS;
    double cos, sin;                                          // of its yaw
    double above = -std::numeric_limits<double>::infinity();  // solids up to here do not count
  };
  // Of a half-step: of all bodies, or of the parts of a set on levels.
  struct PlacedParts {
    Placed body;
    std::optional<Placed> swing = {}, stand = {};
  };

  static Prepared Prepare(const Obstacle& obstacle);
  // Moves a place, and returns what is around it.
  Upright Move(int place, const Eigen::Isometry3d& X_WO);
  void PlantTree(const std::vector<Upright>& cylinders);
  void Put(int32_t slot, const Upright& cylinder);
  static std::vector<Bounds> BoundsOf(const std::vector<std::optional<BoxTree>>& volumes);
  PlacedParts Down(int i, Side support, const Foothold& X_WS) const;
  PlacedParts Up(int i, Side support, const Foothold& X_WS) const;
  bool IsFree(const PlacedParts& parts, double extra) const {
    return IsFree(parts.body, extra) && (!parts.swing || IsFree(*parts.swing, extra)) &&
           (!parts.stand || IsFree(*parts.stand, extra));
  }
  bool IsFree(const Placed& placed, double extra) const;
  // By which a volume's bounds are widened, with what the rounding of float coordinates needs.
  double Slack(const Placed& placed, double extra) const;
  // Whether the volume meets a place among those of a leaf of the tree.
  bool MeetsLeaf(const Placed& placed, const BoundsTree::Node& leaf, double extra) const;
  // An obstacle as it is seen from the support sole, and in the mirror for a right support.
  static OrientedBox Seen(const Placed& placed, const Prepared& obstacle);
  // Whether the volume meets it; `around` is Seen().
  bool MeetsObstacle(const BoxTree& tree, const Placed& placed, const Prepared& obstacle,
                     const OrientedBox& around, double extra) const;
  double Clearance(const PlacedParts& parts, double cap) const;

  const SweptVolumes& volumes_;
  std::vector<Bounds> down_bounds_, up_bounds_;
  std::vector<Bounds> down_swing_bounds_, up_swing_bounds_, down_stand_bounds_, up_stand_bounds_;
  std::vector<Prepared> places_;           // of the obstacles in their order, one or more of each
  std::vector<int> only_places_;           // by obstacle; −1: it has waypoints
  BoundsTree tree_;                        // of the cylinders
  std::vector<int32_t> leaf_begins_;       // by node: a leaf's first slot, a multiple of four
  std::vector<int32_t> slots_, place_at_;  // by place; by slot
  std::vector<Cylinders> cylinders_;       // by slot / 4
  double farthest_ = 0.0;                  // coordinate of an obstacle [m]
  std::shared_ptr<const Ground> ground_;
  std::optional<double> level_;  // the only one [m]; none: the set is on levels
  LevelBorders levels_;
  Eigen::Matrix2Xd sole_outline_;
  double foothold_ = 0.0, no_step_ = 0.0;  // [m]
  NoStepAreas areas_;
};

}  // namespace halfstep
