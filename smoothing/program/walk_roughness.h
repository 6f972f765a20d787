#pragma once

#include "smoothing/program/overlap_variables.h"
#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

/// How violently a walk moves, as integrals over its whole duration.
struct WalkRoughness {
  double com_acceleration = 0.0;  ///< ∫‖c̈‖² dt [m²/s³]
  double com_jerk = 0.0;          ///< ∫‖c⃛‖² dt [m²/s⁵]
  double foot_speed = 0.0;        ///< ∫‖v_L‖² + ‖v_R‖² dt, sole centres [m²/s]
};

/// Weights of the integrals, in the units that make seconds of them.
struct RoughnessWeights {
  double com_acceleration = 0.0;  ///< [s⁴/m²]
  double com_jerk = 0.0;          ///< [s⁶/m²]
  double foot_speed = 0.0;        ///< [s²/m²]
};

/// The integrals of a walk: c̈ = ω²(c − p), c⃛ = ω²(ċ − ṗ). On each stretch between
/// the ends of profiles' pieces the integrands are sums of polynomials and exponentials in closed
/// form, and Gauss–Legendre quadrature with 10 nodes gives their integrals to about 1e-10
/// (relative). Source: smoothing/README.md, "Overlap program".
WalkRoughness RoughnessOf(const SuperposedWalk& walk);

/// Σ weights · integrals [s], and when `gradient` is not null its derivatives with respect to every
/// parameter, term by term (a parameter may come several times). Exact up to the quadrature: the
/// integrands are continuous, so only the ends of the half-steps' own stretches move with the
/// parameters.
double WeightedRoughness(const SuperposedWalk& walk, const RoughnessWeights& weights,
                         ParameterGradient* gradient);

}  // namespace halfstep
