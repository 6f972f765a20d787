#pragma once

#include <functional>
#include <vector>

#include "wpg/geometry/foothold.h"
#include "wpg/geometry/side.h"
#include "wpg/motion/half_step.h"

namespace halfstep {

/// Which places of the swing sole beside the support sole are tried, seen from a left support;
/// mirrored for a right one. Published: 5 cm × 5 cm × 5 yaws.
struct StepGrid {
  double x_min = -0.35, x_max = 0.35;   ///< [m]
  double y_min = -0.37, y_max = -0.01;  ///< [m], negative: to the right of a left support
  double spacing = 0.05;                ///< of x and y [m], counted from (x_min, y_min)
  std::vector<double> yaws = {-0.5, -0.25, 0.0, 0.25, 0.5};  ///< [rad]
};

/// The discrete half-steps that planners choose from: from level to level at the same height so
/// far. An element i is one place X_SF of a foot
/// beside the other. It serves two half-steps: *down*, where the support foot is S and the swing
/// foot lands on X_SF; and *up*, where the foot F that has landed supports and the other one leaves
/// its place X_FS = X_SF⁻¹ for the via point.
struct StepSet {
  HalfStep prototype;                ///< duration, via point and shape of all of them
  std::vector<Foothold> placements;  ///< X_SF of each element, seen from a left support

  int size() const { return static_cast<int>(placements.size()); }  ///< number of elements
  /// X_SF of element i when `support` supports.
  Foothold Placement(int i, Side support) const;
  /// The half-step on `support` that lands element i.
  HalfStep Down(int i, Side support) const;
  /// The half-step that follows it: on the foot that has landed, Opposite(support).
  HalfStep Up(int i, Side support) const;
};

/// Every place of the grid for which `keeps` accepts both the down and the up half-step of a left
/// support. `keeps` shall prove robot-only margins for all t, of the mirrored half-step as well
/// where the robot's legs are not mirror images. `progress` (may be empty) is called
/// with the fraction done, and stops the search by returning false; then the set is empty.
StepSet MakeStepSet(const StepGrid& grid, const HalfStep& prototype,
                    const std::function<bool(const HalfStep&)>& keeps,
                    const std::function<bool(double)>& progress = {});

}  // namespace halfstep
