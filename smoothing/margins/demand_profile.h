#pragma once

#include <array>
#include <string_view>

#include "smoothing/margins/margin.h"

namespace halfstep {

/// A named set of limits and demanded margins: what `smoothing.profile` of a config may name.
enum class DemandProfile : int {
  /// What a laboratory asks before a robot may try a walk, sized for HRP-2; configs scale it to
  /// the robot. Which limits these are was measured by survival in replay:
  /// notebooks-data/measurements.md, "Walkable".
  kWalkable,
  kLimit,  ///< what physics and the robot's files allow: MarginLimits{}
  /// What the source paper asked: a point mass's ZMP, joints, collisions. Nothing of the whole
  /// robot's dynamics, and no limits of the feet. Source: [Perrin2011].
  kPaper,
};
/// All of them.
inline constexpr std::array kDemandProfiles = {DemandProfile::kWalkable, DemandProfile::kLimit,
                                               DemandProfile::kPaper};

std::string_view Name(DemandProfile profile);  ///< "walkable" … as in YAML

/// What a profile demands; without margins of one's own.
MarginLimits LimitsOf(DemandProfile profile);

}  // namespace halfstep
