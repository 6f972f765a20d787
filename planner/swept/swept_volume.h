#pragma once

#include <optional>
#include <vector>

#include "planner/swept/box_tree.h"
#include "planner/swept/voxel_grid.h"
#include "wpg/motion/half_step.h"
#include "wpg/motion/motion_bounds.h"
#include "wpg/motion/motion_model.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// How finely a swept volume is baked. A coarser one is smaller and baked sooner but refuses more
/// half-steps that are free; none is unsound.
struct SweptVolumeOptions {
  double cell = 0.01;            ///< edge of the cells that the volume is made of [m], 1e-3 … 0.1
  double displacement = 0.0025;  ///< what a body may move within an interval of time [m], > 0
  double clearance = 0.005;  ///< δ: what misses the volume is at least δ from the robot [m], ≥ 0
  /// Intervals are not cut below this [s]. A body that moves farther is inflated by what it moves;
  /// a leg whose motion has no bound even so (nearly stretched) has no swept volume.
  double shortest_interval = 1e-4;
  friend bool operator==(const SweptVolumeOptions&, const SweptVolumeOptions&) = default;
};

/// Edge of the cells of a foot's volume where it has one of its own [m].
constexpr double FootCell(double cell) { return 0.5 * cell; }

/// Bakes swept volumes of one robot. Const and thread-safe.
class SweptVolumeBaker {
 public:
  /// `robot` is borrowed and must outlive this.
  SweptVolumeBaker(const RobotModel& robot, const SweptVolumeOptions& options);

  /// A body as it is posed in the middle of an interval of time, and how far any point of it can be
  /// from there within the interval.
  struct Placement {
    size_t body = 0;                                            ///< index of RobotModel::bodies
    Eigen::Isometry3d X_SBody = Eigen::Isometry3d::Identity();  ///< seen from the support sole
    double displacement = 0.0;                                  ///< [m]
    double time = 0.0;  ///< the middle of the interval [s]; it tells an interval of a body
  };
  /// Intervals that cover all of the half-step for every body of the robot. None when the motion
  /// has no bound somewhere: a leg does not reach, or is nearly stretched.
  std::optional<std::vector<Placement>> Cover(const HalfStep& half_step,
                                              const MotionModel& model) const;

  /// Returns a volume that contains every point within `clearance` of a body of the robot at any
  /// time of the half-step, in the frame S of its support sole; and the mirror images of those of
  /// the mirrored half-step, so that one volume serves both sides of a robot that is not quite
  /// symmetric. None, as for Cover, when either motion has no bound. Source: planner/README.md,
  /// "Swept volumes".
  std::optional<BoxTree> Bake(const HalfStep& half_step, const MotionModel& model) const;

  /// The volumes of a half-step on levels.
  struct Parts {
    BoxTree rest;   ///< of all bodies that are on no foot
    BoxTree swing;  ///< of the foot that swings
    BoxTree stand;  ///< of the foot that stands
  };
  /// The same as Bake for each part; those of the feet in finer cells (FootCell), for feet stand
  /// near to what they must not touch.
  std::optional<Parts> BakeParts(const HalfStep& half_step, const MotionModel& model) const;

  const SweptVolumeOptions& options() const { return options_; }  ///< as given

 private:
  // The placements of a half-step and of the mirrored one.
  struct Covered {
    std::vector<Placement> own, mirrored;
  };
  std::optional<Covered> CoverBoth(const HalfStep& half_step, const MotionModel& model) const;
  BoxTree TreeOf(const Covered& covered, double cell) const;

  struct Outline {
    Eigen::Matrix3Xd normals;  // in the body's link frame, unit
    Eigen::VectorXd offsets;   // of the body's supporting planes [m]
  };
  // A body on the other side whose mirror image (nearly) is in this one, where all joint angles are
  // zero. All is in this body's link frame.
  struct Twin {
    size_t body = 0;
    Eigen::Affine3d X_LinkImage = Eigen::Affine3d::Identity();  // its link's mirror image
    Eigen::VectorXd offsets;                                    // of its planes along the normals
    double reach = 0.0;  // of its farthest point from the origin [m]
  };
  std::optional<Twin> FindTwin(size_t body) const;
  // What a placed body is inflated by [m].
  double Inflation(const Placement& placement) const;
  // Around a placed body and all that is near enough.
  HalfSpaces Inflated(const Placement& placement) const;
  // The box around it; no half-spaces.
  HalfSpaces Bounds(const Placement& placement) const;
  // Makes the region around a placed body larger, so that it is also around the mirror image of its
  // placed twin. False, and nothing done, where that is too far away.
  bool AddTwin(const Placement& placement, const Placement& twin, HalfSpaces* region) const;

  const RobotModel& robot_;
  SweptVolumeOptions options_;
  MotionBounds bounds_;
  std::vector<Outline> outlines_;
  std::vector<std::optional<Twin>> twins_;  // by body
};

}  // namespace halfstep
