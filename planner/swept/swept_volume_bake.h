#pragma once

#include <functional>
#include <optional>
#include <stop_token>

#include "planner/swept/swept_volume.h"
#include "planner/swept/swept_volumes.h"

namespace halfstep {

/// The two volumes of one element of a set.
struct ElementVolumes {
  /// Of the down and of the up half-step, on a left support; none: its motion has no bound.
  std::optional<BoxTree> down, up;
};

/// How the work of a bake is done; none of it changes the result.
struct BakeHooks {
  int threads = 0;            ///< 0: as many as the machine has
  std::stop_token stop = {};  ///< ends the bake early
  /// Called with the fraction done, never by two threads at once; stops the bake by returning
  /// false. May be empty.
  std::function<bool(double)> progress = {};
  /// `recall` returns an element that was baked before, or none; `keep` stores one that was baked
  /// now. Called by several threads at once. May be empty.
  std::function<std::optional<ElementVolumes>(int)> recall = {};
  std::function<void(int, const ElementVolumes&)> keep = {};  ///< see recall
};

/// Bakes all elements of a set, or none when stopped. An exception of a hook ends the bake and is
/// rethrown.
std::optional<SweptVolumes> BakeSweptVolumes(const RobotModel& robot, const MotionModel& model,
                                             const StepSet& set, const SweptVolumeOptions& options,
                                             const BakeHooks& hooks = {});

}  // namespace halfstep
