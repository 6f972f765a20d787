#pragma once

#include <functional>
#include <optional>
#include <stop_token>

#include "planner/swept/swept_volume.h"
#include "planner/swept/swept_volumes.h"

namespace halfstep {

/// The volumes of one element of a set.
struct ElementVolumes {
  /// Of the down and of the up half-step, on a left support; none: its motion has no bound.
  std::optional<BoxTree> down, up;
  /// Of a set on levels, as SweptVolumes has them.
  std::optional<BoxTree> down_swing = {}, up_swing = {};
  std::optional<BoxTree> down_stand = {}, up_stand = {};  ///< see down_swing
};

/// Calls visit(volume) for each volume of an element in the order of files: two, or of a set on
/// levels six.
template <typename Element, typename Visit>
void ForEachVolume(Element& element, bool on_levels, const Visit& visit) {
  visit(element.down);
  visit(element.up);
  if (!on_levels) return;
  visit(element.down_swing);
  visit(element.up_swing);
  visit(element.down_stand);
  visit(element.up_stand);
}
/// How many that are.
constexpr size_t VolumesOfElement(const StepSet& set) { return set.on_levels ? 6 : 2; }
/// Puts an element's volumes where they belong. Precondition: `volumes` has room for all elements.
void PutElement(int i, ElementVolumes element, SweptVolumes* volumes);
/// Makes room for the volumes of all elements of volumes->set.
void MakeRoom(SweptVolumes* volumes);

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

/// A robot with a plate more under each foot: its outline from above (FootOutline) on the sole's
/// plane. For volumes on levels, where the family `floor` keeps that outline off solids.
RobotModel WithFootPlates(RobotModel robot);

/// Bakes all elements of a set, or none when stopped. On levels the volumes are those of the robot
/// WithFootPlates. An exception of a hook ends the bake and is
/// rethrown.
std::optional<SweptVolumes> BakeSweptVolumes(const RobotModel& robot, const MotionModel& model,
                                             const StepSet& set, const SweptVolumeOptions& options,
                                             const BakeHooks& hooks = {});

}  // namespace halfstep
