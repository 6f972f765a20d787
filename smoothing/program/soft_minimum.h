#pragma once

#include <Eigen/Core>

#include "wpg/elementary.h"

namespace halfstep {

/// Σ e^{−ρ·slack} over slacks and its gradient, both times e^{ρ·least}: no overflow, whatever the
/// slacks. The soft minimum is least − log(sum)/ρ. Source: smoothing/README.md, "Overlap program".
struct SoftMinimum {
  double least;              ///< of all slacks
  double sum;                ///< Σ e^{−ρ·(slack − least)}
  Eigen::VectorXd gradient;  ///< Σ of each slack's weight times its gradient (n)

  /// Adds a slack; returns its weight e^{−ρ·(slack − least)}, by which its gradient is to be added.
  double Add(double slack, double sharpness) {
    if (slack < least) {
      const double shrink = Exp(-sharpness * (least - slack));
      sum *= shrink;
      gradient *= shrink;
      least = slack;
    }
    const double weight = Exp(-sharpness * (slack - least));
    sum += weight;
    return weight;
  }
};

}  // namespace halfstep
