#pragma once

#include <optional>

#include "wpg/geometry/foothold.h"
#include "wpg/geometry/side.h"
#include "wpg/motion/half_step_shape.h"
#include "wpg/motion/walk_state.h"

namespace halfstep {

/// Half a step, from rest to rest, the support foot fixed at the origin of S.
///
///   z │            ╭──● via point (via_along, ±via_lateral, via_height)
///     │          ╭─╯        Up:   the swing foot goes from X_SF to the via point, the CoM and the
///     │        ╭─╯                ZMP from mid-feet to the support point, the waist's yaw from
///     │        │                  the mean of the feet's yaws to the support's.
///   ──┴────────┴──────▶ x   Down: the time reverse, towards a new X_SF.
///            X_SF
///
/// The waist stands over the lower of two soles, and over the support sole at the via point, as
/// high as on the floor; so it rises (up) or sinks (down) only where the swing foot stands lower,
/// or where it is kept at another height while both feet stand (standing_crouch).
///
/// ZMP: bump on [0, t1], shift on [t1, t2], bump on [t2, T]. The foot is in the air only on (t2, T]
/// (up) or [0, t1) (down). Left and right are mirror images.
/// Source: [Perrin2011] §III; wpg/README.md, "Half-step".
struct HalfStep {
  Side support = Side::kLeft;             ///< the foot that stands
  HalfStepKind kind = HalfStepKind::kUp;  ///< up: towards the via point; down: from it
  Foothold X_SF = {};         ///< where the swing sole stands, seen from the support sole.
  double duration = 2.0;      ///< T [s]
  double via_height = 0.25;   ///< above the support sole [m] ≥ 0; no lower than X_SF
  double via_lateral = 0.24;  ///< distance of the via point from the support sole's centre [m].
  double via_along = 0.0;     ///< how far the via point is ahead of that centre, along its x [m]
  HalfStepShape shape = {};   ///< times and forms, as fractions of T
  /// shape.crouch where both feet stand [m] ≥ 0, in a half-step that changes the waist's height;
  /// none: the same.
  std::optional<double> standing_crouch = {};

  Side swing() const { return Opposite(support); }  ///< the foot that moves
  /// The pose X_SV of the via point seen from above: there the swing foot is between up and down.
  Pose2 via() const { return {via_along, Sign(swing()) * via_lateral, 0.0}; }
  /// The support point, in S: CoM and ZMP are there while the swing foot is at the via point.
  Eigen::Vector2d support_point() const { return {0.0, Sign(swing()) * shape.support_point}; }
  /// How far the waist is kept below where it stands, while both feet do [m].
  double crouch_on_floor() const { return standing_crouch.value_or(shape.crouch); }
  /// The states at rest, in S: with both feet standing, and at the via point.
  WalkState OnFloor() const;
  WalkState AtVia() const;  ///< with the swing foot at the via point
  /// Where the half-step begins.
  WalkState Start() const { return kind == HalfStepKind::kUp ? OnFloor() : AtVia(); }
  /// Where it ends.
  WalkState End() const { return kind == HalfStepKind::kUp ? AtVia() : OnFloor(); }

  HalfStep Mirrored() const;  ///< left and right exchanged: the reflection in the xz plane
  friend bool operator==(const HalfStep&, const HalfStep&) = default;
};

}  // namespace halfstep
