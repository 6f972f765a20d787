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
  StepSet set;                               ///< whose half-steps they are of
  std::vector<std::optional<BoxTree>> down;  ///< of set.Down(i, Side::kLeft)
  std::vector<std::optional<BoxTree>> up;    ///< of set.Up(i, Side::kRight), on a left support
};

}  // namespace halfstep
