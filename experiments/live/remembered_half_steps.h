#pragma once

#include <mutex>
#include <string>
#include <unordered_set>

#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

/// Remembers of which half-steps something was proved that depends on the robot and its ground
/// alone, and so holds whenever, and on flat ground wherever they are: that a walk which is cut
/// after half-step j keeps some margins from the half-step's beginning to its end. That depends on
/// half-step j and on those before it that have not ended when it begins. Two walks are the same in
/// this when they differ by the rounding of placing a half-step in the world. Safe to use from
/// several threads.
class RememberedHalfSteps {
 public:
  /// Whether it also depends on where the support sole stands: the ground is not flat.
  explicit RememberedHalfSteps(bool by_place) : by_place_(by_place) {}

  /// Whether half-step j of the walk was remembered, or one that moves in the same way.
  bool Knows(const SuperposedWalk& walk, int j) const;
  /// Remembers half-step j of the walk as proved.
  void Remember(const SuperposedWalk& walk, int j);

 private:
  bool by_place_;
  mutable std::mutex mutex_;
  std::unordered_set<std::string> known_;
};

}  // namespace halfstep
