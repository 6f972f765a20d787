#pragma once

namespace halfstep {

/// g [m/s²], along −z of W.
inline constexpr double kGravity = 9.81;

}  // namespace halfstep
