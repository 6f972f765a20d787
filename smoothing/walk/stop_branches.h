#pragma once

#include <string_view>

#include "wpg/motion/half_step.h"

namespace halfstep {

/// Which stop branches of a walk (SuperposedWalk::StopBranch) must be feasible as well.
enum class StopBranches {
  kNone,
  kDown,  ///< after down half-steps: the robot can come to rest on both feet within a step
  kAll,   ///< after every half-step: at rest within a half-step, perhaps on one foot
};
std::string_view Name(StopBranches branches);  ///< "none", "down" or "all", as in YAML

/// Whether the stop branch after a half-step of this kind is among them.
bool Demands(StopBranches branches, HalfStepKind after);

}  // namespace halfstep
