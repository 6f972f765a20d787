#pragma once

#include <optional>
#include <vector>

#include "planner/search/step_set.h"
#include "planner/swept/box_tree.h"

namespace halfstep {

/// The swept volumes of a set: of its down and of its up half-steps, as they are on a left support;
/// on a right one their mirror images.
/// A half-step whose motion has no bound has no volume and is never free.
struct SweptVolumes {
  using Volumes = std::vector<std::optional<BoxTree>>;  ///< by element

  StepSet set;   ///< whose half-steps they are of
  Volumes down;  ///< of set.Down(i, Side::kLeft)
  Volumes up;    ///< of set.Up(i, Side::kRight), on a left support
  /// Where set.on_levels, those above are of all bodies but the feet, and these of the foot that
  /// swings and of the one that stands; else they are empty.
  Volumes down_swing = {}, up_swing = {};
  Volumes down_stand = {}, up_stand = {};  ///< see down_swing
};

}  // namespace halfstep
