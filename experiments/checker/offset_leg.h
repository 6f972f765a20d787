#pragma once

#include <array>
#include <functional>
#include <vector>

#include "experiments/checker/taylor.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::checker {

/// Joint angles of a leg whose axes need not meet, along a walk, by interval Newton (Krawczyk's
/// operator). At the walk's first instant they are those of Leg::met, followed while axes and sole
/// move straight to the leg's own places: the branch of wpg/README.md, "Offset hips and ankles".
/// From there on they are the only continuous ones. Source: experiments/check.md, "A certified
/// walk"; [Krawczyk1969].
class OffsetLeg {
 public:
  using Angles = std::array<Curve, 6>;  ///< [rad]
  /// Angles on an interval, which are also within E of a path at every instant.
  struct Lift {
    Angles q;                   ///< [rad]
    Angles path;                ///< [rad]
    std::array<Interval, 6> E;  ///< [rad]
  };
  /// The frame, seen from the waist, where the waist was at q = 0, carried by the sole, on [from,
  /// to]; both in seconds.
  using Foot = std::function<FrameIn<Curve>(double from, double to)>;

  /// Borrows both. Precondition: they differ in where axes and sole are at q = 0, not in how these
  /// are turned, and `met` has a closed form.
  OffsetLeg(const Leg& leg, const Leg& met) : leg_(leg), met_(met) {}

  /// Follows the leg from the first of the knots to the last, or as far as it can; parts of what is
  /// between two of them are halved down to 1 µs.
  void Follow(const std::vector<double>& knots, const Foot& foot);
  /// The angles on [from, to], `foot` being that of this interval. Throws NotDefined unless it lies
  /// in a part that was followed as a whole, and where the operator does not contract.
  Angles On(double from, double to, const FrameIn<Curve>& foot) const;

 private:
  struct Part {
    double from, to;  // [s], or of the offsets
    Lift lift;
  };
  template <typename Way>
  bool Extend(const Way& way, double from, double to, std::array<Interval, 6>* q,
              std::vector<Part>* parts) const;

  const Leg& leg_;
  const Leg& met_;
  std::vector<Part> parts_;
};

}  // namespace halfstep::checker
