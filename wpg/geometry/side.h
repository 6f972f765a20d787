#pragma once

#include <string_view>

namespace halfstep {

/// Which foot, leg or arm. Also the index of per-leg arrays: 0 left, 1 right.
enum class Side { kLeft = 0, kRight = 1 };

/// The other side.
constexpr Side Opposite(Side side) { return side == Side::kLeft ? Side::kRight : Side::kLeft; }
constexpr int Index(Side side) { return static_cast<int>(side); }  ///< 0 for left, 1 for right.
/// +1 for left, −1 for right: the sign of y on that side.
constexpr double Sign(Side side) { return side == Side::kLeft ? 1.0 : -1.0; }
/// "left" or "right".
constexpr std::string_view Name(Side side) { return side == Side::kLeft ? "left" : "right"; }

}  // namespace halfstep
