#pragma once

#include <array>
#include <string_view>

#include "wpg/geometry/side.h"

namespace halfstep {

/// The quantities that a walk is made of, in the order of WalkState. Each is a row of kQuantities.
/// Feet: sole centres; z is up from the plane z = 0 of the frame in which they are seen. The
/// waist's z is how far it is above where it stands on that plane.
enum Quantity : int {
  kComX,
  kComY,
  kZmpX,
  kZmpY,
  kWaistYaw,
  kLeftX,
  kLeftY,
  kLeftZ,
  kLeftYaw,
  kRightX,
  kRightY,
  kRightZ,
  kRightYaw,
  kWaistZ,
  kNumQuantities
};

/// Index of the first of a foot's four quantities (x, y, z, yaw).
constexpr int FootIndex(Side side) { return side == Side::kLeft ? kLeftX : kRightX; }

/// What a quantity is of a point or of a body. It says how the quantity changes with the frame in
/// which it is seen. After an x, the y of the same point follows.
enum class Component { kX, kY, kZ, kYaw };

/// The row of a quantity.
struct QuantityTraits {
  Quantity quantity;        ///< whose row it is
  std::string_view name;    ///< "com_x"
  std::string_view unit;    ///< "m"
  std::string_view column;  ///< of trajectory.csv, seen in W: "com_x_m"
  Component component;      ///< what it is
  Quantity mirrored;        ///< the quantity that it is in a mirror
  /// Whether ThirdRanges bounds its third time derivative. No margin asks that of the ZMP.
  bool bounded_third = true;
};

/// The row of each quantity.
inline constexpr std::array<QuantityTraits, kNumQuantities> kQuantities = {{
    {kComX, "com_x", "m", "com_x_m", Component::kX, kComX},
    {kComY, "com_y", "m", "com_y_m", Component::kY, kComY},
    {kZmpX, "zmp_x", "m", "zmp_x_m", Component::kX, kZmpX, false},
    {kZmpY, "zmp_y", "m", "zmp_y_m", Component::kY, kZmpY, false},
    {kWaistYaw, "waist_yaw", "rad", "waist_yaw_rad", Component::kYaw, kWaistYaw},
    {kLeftX, "left_foot_x", "m", "left_foot_x_m", Component::kX, kRightX},
    {kLeftY, "left_foot_y", "m", "left_foot_y_m", Component::kY, kRightY},
    {kLeftZ, "left_foot_z", "m", "left_foot_z_m", Component::kZ, kRightZ},
    {kLeftYaw, "left_foot_yaw", "rad", "left_foot_yaw_rad", Component::kYaw, kRightYaw},
    {kRightX, "right_foot_x", "m", "right_foot_x_m", Component::kX, kLeftX},
    {kRightY, "right_foot_y", "m", "right_foot_y_m", Component::kY, kLeftY},
    {kRightZ, "right_foot_z", "m", "right_foot_z_m", Component::kZ, kLeftZ},
    {kRightYaw, "right_foot_yaw", "rad", "right_foot_yaw_rad", Component::kYaw, kLeftYaw},
    {kWaistZ, "waist_z", "m", "waist_z_m", Component::kZ, kWaistZ},
}};

namespace internal {
constexpr bool QuantitiesStandInTheirPlaces() {
  for (int q = 0; q < kNumQuantities; ++q) {
    if (kQuantities[static_cast<std::size_t>(q)].quantity != q) return false;
  }
  return true;
}
static_assert(QuantitiesStandInTheirPlaces(), "a quantity has no row, or it is not in its place");
}  // namespace internal

}  // namespace halfstep
