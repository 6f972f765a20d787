#pragma once

#include <functional>
#include <vector>

#include "wpg/geometry/foothold.h"
#include "wpg/geometry/side.h"
#include "wpg/ground/ground.h"
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

/// The discrete half-steps that planners choose from. An element i is one place X_SF of a foot
/// beside the other, at its height or, on levels, higher or lower. It serves two half-steps:
/// *down*, where the support foot is S and the swing foot lands on X_SF; and *up*, where the foot F
/// that has landed supports and the other one leaves its place X_FS = X_SF⁻¹ for the via point.
struct StepSet {
  HalfStep prototype;                ///< duration, via point and shape of all of them
  std::vector<Foothold> placements;  ///< X_SF of each element, seen from a left support
  /// Whether it is for ground with solids, which feet touch: then its swept volumes tell the feet
  /// from the rest.
  bool on_levels = false;
  /// What differs between half-steps of other heights of the waist.
  struct Form {
    double crouch = 0.0;      ///< HalfStepShape::crouch [m]
    double via_height = 0.0;  ///< [m]
    friend bool operator==(const Form&, const Form&) = default;
  };
  /// The waist's heights, the first that of the prototype; empty: only that one.
  std::vector<Form> forms = {};
  /// Of an element, between which of `forms` it leads: its down half-step is of the first one, its
  /// up half-step leads to the other one.
  struct Change {
    int from = 0;  ///< of forms
    int to = 0;    ///< of forms
    friend bool operator==(const Change&, const Change&) = default;
  };
  std::vector<Change> changes = {};  ///< by element where there are forms, else empty

  int size() const { return static_cast<int>(placements.size()); }  ///< number of elements
  /// Of element i; of a set without forms {0, 0}.
  Change ChangeOf(int i) const {
    return changes.empty() ? Change{} : changes[static_cast<size_t>(i)];
  }
  int num_forms() const { return forms.empty() ? 1 : static_cast<int>(forms.size()); }  ///< ≥ 1
  /// The prototype at a height of the waist.
  HalfStep PrototypeOf(int form) const;
  /// X_SF of element i when `support` supports.
  Foothold Placement(int i, Side support) const;
  /// The half-step on `support` that lands element i.
  HalfStep Down(int i, Side support) const;
  /// The half-step that follows it: on the foot that has landed, Opposite(support).
  HalfStep Up(int i, Side support) const;
};

/// Whether planning on a ground needs a set on levels: there are several, or borders, or solids.
bool HasLevels(const Ground& ground);

/// The differences of height between levels at these heights [m] by which a foot may be tried to
/// land higher (> 0) or lower: 0 first, then ascending, none that is more than `most` ≥ 0 [m] or
/// differs by less than 1e-9 m from another.
std::vector<double> RisesBetween(const std::vector<double>& heights, double most);

/// Every place of the grid for which `keeps` accepts both the down and the up half-step of a left
/// support. `keeps` shall prove robot-only margins for all t, of the mirrored half-step as well
/// where the robot's legs are not mirror images. `progress` (may be empty) is called
/// with the fraction done, and stops the search by returning false; then the set is empty.
StepSet MakeStepSet(const StepGrid& grid, const HalfStep& prototype,
                    const std::function<bool(const HalfStep&)>& keeps,
                    const std::function<bool(double)>& progress = {});
/// The same for ground of several levels: of each of the `rises` [m], in their order, every place
/// of the grid at that height. What would land at the via point's height or above is not asked.
StepSet MakeStepSet(const StepGrid& grid, const HalfStep& prototype,
                    const std::vector<double>& rises,
                    const std::function<bool(const HalfStep&)>& keeps,
                    const std::function<bool(double)>& progress = {});

}  // namespace halfstep
