#pragma once

namespace halfstep {

/// Leg length of HRP-2, hip to ankle with the leg stretched [m]. Numbers that are told for HRP-2
/// are scaled to other robots by their legs' length over this.
inline constexpr double kLegOfHrp2 = 0.705;

}  // namespace halfstep
