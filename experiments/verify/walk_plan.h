#pragma once

#include <array>
#include <optional>
#include <vector>

#include "experiments/verify/form_columns.h"
#include "wpg/geometry/foothold.h"
#include "wpg/geometry/side.h"

namespace halfstep::verify {

/// Half a step, seen from its support sole S. Source: [Perrin2011] §III; wpg/README.md,
/// "Half-step".
struct HalfStep {
  bool up = true;              ///< towards the via point; else down from it
  Side support = Side::kLeft;  ///< the foot that stands
  Foothold X_SF;               ///< where the other one stands before (up) or after it (down)
  double duration = 0;         ///< T [s]
  double via_height = 0;       ///< of the via point [m]
  /// Where CoM and ZMP are then: along the sole's y, towards the swing foot [m].
  double support_point = 0;
  FormColumns form;   ///< its `footstep` has no meaning here
  double crouch = 0;  ///< how far the waist is kept below where the robot file has it [m]
  /// The same while both feet stand; none: as far.
  std::optional<double> standing_crouch = {};

  Side swing() const { return Opposite(support); }  ///< the foot that moves
};

/// A half-step and the place of its support sole.
struct PlacedHalfStep {
  HalfStep half_step;  ///< as seen from there
  Foothold X_WS;       ///< in W
  double rest = 0;     ///< how long nothing moves before it begins [s]
};

/// A footstep: where a foot is put, and how.
struct PlannedFootstep {
  Side side = Side::kLeft;            ///< the foot
  Foothold X_WF;                      ///< its sole's place, in W
  double via_height = 0;              ///< of both half-steps that lead there [m]
  double duration = 0;                ///< of each of them [s]
  double rest = 0;                    ///< before the first of them begins, on both feet [s]
  double rest_on_one = 0;             ///< between them, on one foot [s]
  std::optional<double> crouch = {};  ///< of its half-steps from the via point on [m]; none: common
};

/// What footsteps are planned to be: half-steps 2j (up) and 2j + 1 (down) are step j.
struct WalkPlan {
  std::array<Foothold, 2> start;           ///< soles, by Index(Side)
  std::vector<PlacedHalfStep> half_steps;  ///< in their order

  int size() const { return static_cast<int>(half_steps.size()); }  ///< n
  int num_steps() const { return size() / 2; }                      ///< n/2
};

/// How far the waist is kept below where it stands, at the start [m].
double StartCrouch(const WalkPlan& plan);
/// Whether it changes that later.
bool ChangesCrouch(const WalkPlan& plan);

/// The half-steps of footsteps from `start`. Of `common`, what is not a footstep's own is taken.
WalkPlan PlanOf(const std::array<Foothold, 2>& start, const std::vector<PlannedFootstep>& footsteps,
                const HalfStep& common);

/// The plan in which footstep j stands at X_WF·moves[j], X_WF where it was. Precondition: as many
/// moves as steps (std::logic_error).
WalkPlan Moved(const WalkPlan& plan, const std::vector<Pose2>& moves);

}  // namespace halfstep::verify
