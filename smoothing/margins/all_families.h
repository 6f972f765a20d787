#pragma once

#include <array>
#include <memory>

#include "smoothing/margins/clearance_margin.h"
#include "smoothing/margins/floor_margin.h"
#include "smoothing/margins/foot_speed_margin.h"
#include "smoothing/margins/foot_yaw_rate_margin.h"
#include "smoothing/margins/friction_margin.h"
#include "smoothing/margins/ground_margin.h"
#include "smoothing/margins/joint_acceleration_margin.h"
#include "smoothing/margins/joint_margin.h"
#include "smoothing/margins/joint_speed_margin.h"
#include "smoothing/margins/no_step_margin.h"
#include "smoothing/margins/own_margin.h"
#include "smoothing/margins/reach_margin.h"
#include "smoothing/margins/self_clearance_margin.h"
#include "smoothing/margins/torque_margin.h"
#include "smoothing/margins/zmp_margin.h"
#include "smoothing/margins/zmp_robot_margin.h"

namespace halfstep {

/// One object of each family, by MarginFamily.
using MarginStatementsOfAll =
    std::array<std::unique_ptr<const MarginStatements>, kNumMarginFamilies>;

/// The classes of families, in the order of MarginFamily.
template <typename... Families>
struct FamilyList {
  /// Of each class, in that order.
  static constexpr std::array<FamilyTraits, sizeof...(Families)> kTraits = {Families::kTraits...};
  /// `place` is borrowed.
  static MarginStatementsOfAll Make(const MarginPlace& place) {
    return {std::make_unique<Families>(place)...};
  }
};

/// The registry of families. A new family is one more class here, and its name in MarginFamily.
using AllFamilies =
    FamilyList<FloorMargin, FootSpeedMargin, FootYawRateMargin, ZmpMargin, ReachMargin, JointMargin,
               JointSpeedMargin, SelfClearanceMargin, ClearanceMargin, GroundMargin, NoStepMargin,
               ZmpRobotMargin, TorqueMargin, FrictionMargin, JointAccelerationMargin, OwnMargin>;

/// Whether each family's traits stand at its own index; checked when this is compiled.
constexpr bool FamiliesAreInOrder() {
  for (size_t i = 0; i < AllFamilies::kTraits.size(); ++i) {
    if (static_cast<size_t>(AllFamilies::kTraits[i].family) != i) return false;
  }
  return AllFamilies::kTraits.size() == kNumMarginFamilies;
}
static_assert(FamiliesAreInOrder(), "a family of MarginFamily has no class, or another place");

}  // namespace halfstep
