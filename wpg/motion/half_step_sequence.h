#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "wpg/geometry/foothold.h"
#include "wpg/geometry/side.h"
#include "wpg/motion/half_step.h"
#include "wpg/motion/motion_model.h"

namespace halfstep {

/// Where a foot stands, X_WF.
struct Footstep {
  Side side = Side::kLeft;  ///< the foot that stands there
  Foothold X_WF;            ///< the sole's place, in W
  /// What follows holds for both half-steps of the step that leads here.
  double via_height = 0.25;  ///< [m]
  double duration = 2.0;     ///< T of each half-step [s]
  /// How long the robot rests on both feet before the step begins [s] ≥ 0. Before the first step of
  /// a walk it counts for nothing, since the walk begins with that step.
  double rest = 0.0;
  /// How long it rests on one foot before the other lands here [s] ≥ 0.
  double rest_on_one_foot = 0.0;
  /// HalfStepShape::crouch of the step [m]; none: that of the walk. The waist comes to it in the up
  /// half-step, in which the foot leaves the floor.
  std::optional<double> crouch = {};
};

/// A half-step placed in the world: X_WS is the pose of its support sole.
struct PlacedHalfStep {
  HalfStep half_step;  ///< seen from its support sole
  Foothold X_WS;       ///< place of that sole, in W
  /// How long the robot rests before it begins, as planned [s] ≥ 0; nothing for the first one.
  double rest = 0.0;
};

/// A plan: half-steps 0 … n−1, alternately up and down, each beginning where the one before ends,
/// at once or after a rest.
/// Step j is made of half-steps 2j (up) and 2j + 1 (down).
struct HalfStepSequence {
  std::array<Foothold, 2> start;           ///< soles at the start, by Index(Side); yaws unwrapped.
  std::vector<PlacedHalfStep> half_steps;  ///< n ≥ 2, even.
  std::shared_ptr<const MotionModel> model;  ///< of all half-steps; never null

  int size() const { return static_cast<int>(half_steps.size()); }  ///< n
  int num_steps() const { return size() / 2; }                      ///< n/2
  int num_junctions() const { return size() - 1; }                  ///< n − 1
};

/// The sequence that takes the footsteps in their order from the soles `start`. `via_lateral` [m]
/// and `shape` hold for all half-steps, its crouch for those whose footstep has none, and while the
/// robot stands at the start. Precondition: at least one footstep (std::logic_error).
HalfStepSequence MakeSequence(const std::array<Foothold, 2>& start,
                              const std::vector<Footstep>& footsteps, double via_lateral,
                              const HalfStepShape& shape, std::shared_ptr<const MotionModel> model);

/// Whether the waist comes to another height that is not for the ground's sake: Footstep::crouch.
bool ChangesCrouch(const HalfStepSequence& sequence);
/// The same plan seen in a mirror (xz plane of W).
HalfStepSequence Mirrored(const HalfStepSequence& sequence);
/// The same plan moved by X_VW, heights kept: frame W of the plan is placed in frame V.
HalfStepSequence Moved(const Pose2& X_VW, const HalfStepSequence& sequence);

}  // namespace halfstep
