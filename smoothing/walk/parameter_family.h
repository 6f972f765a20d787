#pragma once

#include <array>
#include <cstddef>

#include "wpg/enumerators.h"
#include "wpg/nth.h"

namespace halfstep {

/// The families of parameters that a point of the smoothing homotopy is made of. Each is a row of
/// the table in parameter_families.cc.
enum class ParameterFamily {
  kOverlap,       ///< Δ of a junction
  kHeightScale,   ///< η of a step
  kDuration,      ///< T of a half-step
  kSupportPoint,  ///< support point of a step
  kViaLateral,    ///< how far aside the via point of a step is
  kFootRamp,      ///< ramps of the swing foot's speed in a half-step
  kFootDelay,     ///< the fraction of a half-step between floor and horizontal motion
  kLiftShare,     ///< the fraction of a half-step's flight in which the foot rises or sinks
  kViaAlong,      ///< how far ahead of the support sole's centre the via point of a step is
  kZmpShift,      ///< the fraction of a half-step in which its ZMP shifts
  kZmpBumpRamp,   ///< ramps of the bump of a half-step's ZMP
  kFootstepX,     ///< how far the footstep of a step is moved along its planned x
  kFootstepY,     ///< and along its planned y
  kFootstepYaw,   ///< how far it is turned
  kRiseBegin,     ///< when the waist begins to rise in a half-step
  kRiseEnd,       ///< when it has risen
};
/// How many families there are.
inline constexpr int kNumParameterFamilies = NumEnumerators<ParameterFamily>();

/// Every family, in the order of programs and files.
constexpr std::array<ParameterFamily, kNumParameterFamilies> AllParameterFamilies() {
  std::array<ParameterFamily, kNumParameterFamilies> all{};
  for (size_t i = 0; i < all.size(); ++i) all[i] = static_cast<ParameterFamily>(i);
  return all;
}

/// Something of each family.
template <typename T>
struct ByParameterFamily {
  std::array<T, kNumParameterFamilies> values{};  ///< in the order of ParameterFamily

  /// That of a family.
  constexpr T& operator[](ParameterFamily family) { return Nth(values, family); }
  /// The same, to be read.
  constexpr const T& operator[](ParameterFamily family) const { return Nth(values, family); }
  friend bool operator==(const ByParameterFamily&, const ByParameterFamily&) = default;
};

}  // namespace halfstep
