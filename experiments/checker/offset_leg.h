#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "experiments/checker/leg_motion.h"

namespace halfstep::checker {

/// Joint angles of a leg whose axes need not meet, as functions of time, by interval Newton
/// (Krawczyk's operator). For all instants of an interval and all shares s ∈ [0, 1] of the offsets
/// it shows boxes in which there is one posture, of the leg whose axes and sole are at
/// met + s·(leg − met) at q = 0. These begin with the closed form of Leg::met and end with the
/// leg's own posture: the branch of wpg/README.md, "Offset hips and ankles", a continuous function
/// of the poses. Source: experiments/check.md, "A certified walk"; [Krawczyk1969].
class OffsetLeg {
 public:
  /// Borrows both. Precondition: they differ in where axes and sole are at q = 0, not in how these
  /// are turned, and `met` has a closed form.
  OffsetLeg(const Leg& leg, const Leg& met);

  /// Joint angles [rad]; arguments as those of LegSolver::At. Throws NotDefined where the operator
  /// does not contract.
  std::array<Curve, 6> At(const FrameIn<Curve>& X_WB, const FrameIn<Curve>& carried) const;

 private:
  using Box = std::array<Interval, 6>;  // of postures [rad], or of what belongs to their equations
  // The leg with a share of the offsets: a point of each axis at q = 0, and the frame, seen from
  // the waist, where the waist was at q = 0, carried by the sole.
  struct Parts {
    std::array<Vector, 6> points;
    FrameIn<Curve> foot;
  };
  // About the inverse of the equations' Jacobian J, and the unit matrix less that times J.
  struct Slopes {
    Eigen::Matrix<double, 6, 6> inverse;
    std::array<Box, 6> rest;
  };

  Parts PartsAt(const Interval& share, const FrameIn<Curve>& foot) const;
  Slopes SlopesWithin(const Parts& parts, const Box& q) const;
  Box Krawczyk(const Parts& parts, const Box& q) const;
  std::optional<Box> Continued(const FrameIn<Curve>& foot, double from, double to,
                               const Box& q) const;
  template <int N>
  void AddDerivative(const Parts& parts, const Slopes& slopes, std::array<Curve, 6>* q) const;

  const Leg& leg_;
  const Leg& met_leg_;
  LegSolver met_;
};

}  // namespace halfstep::checker
