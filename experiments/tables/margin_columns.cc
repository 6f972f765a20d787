#include "experiments/tables/margin_columns.h"

#include <algorithm>
#include <array>

#include "smoothing/margins/family_traits.h"
#include "wpg/robot/acceleration_limits.h"

namespace halfstep {
namespace {

// The last one only for robots that have the family.
constexpr std::array kFamilies = {MarginFamily::kZmp,        MarginFamily::kJoint,
                                  MarginFamily::kJointSpeed, MarginFamily::kFootSpeed,
                                  MarginFamily::kClearance,  MarginFamily::kSelfClearance,
                                  MarginFamily::kZmpRobot,   MarginFamily::kTorque,
                                  MarginFamily::kFriction,   MarginFamily::kJointAcceleration};

}  // namespace

std::span<const MarginFamily> FamiliesOfTrajectory(const RobotModel& robot) {
  return std::span(kFamilies).first(kFamilies.size() - (HasAccelerationLimits(robot) ? 0 : 1));
}

std::optional<std::string> TrajectoryColumnOf(MarginFamily family) {
  if (std::ranges::find(kFamilies, family) == kFamilies.end()) return std::nullopt;
  const FamilyTraits& traits = Traits(family);
  const std::string name(traits.name), ending(traits.key.substr(name.size()));  // "_m"
  return name + (name.ends_with("clearance") ? "" : "_margin") + ending;
}

}  // namespace halfstep
