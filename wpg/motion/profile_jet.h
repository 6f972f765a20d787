#pragma once

namespace halfstep {

/// A profile F(σ, θ) from 0 to 1 in dimensionless time σ = τ/T ∈ [0, 1], with θ = ω·T, and the
/// derivatives that its jet in time needs. Subscripts are partial derivatives.
struct UnitJet {
  double value = 0.0;                   ///< F
  double s = 0.0, ss = 0.0, sss = 0.0;  ///< F_σ, F_σσ, F_σσσ (the last piecewise).
  double theta = 0.0, theta_s = 0.0, theta_ss = 0.0;  ///< F_θ, F_σθ, F_σσθ.

  /// The derivative with respect to a parameter that moves the time of every value: F at σ becomes
  /// F at σ + w·dr, with w affine in σ, `w` at this σ and `w_s` its slope. Only value, s and ss.
  UnitJet Moved(double w, double w_s) const {
    return {.value = w * s, .s = w_s * s + w * ss, .ss = 2.0 * w_s * ss + w * sss};
  }
};

/// How a form F(σ) is computed: how far its value, s and ss may be from the exact ones at the same
/// σ, by rounding, and the largest |F|, |F_σ|, |F_σσ|, |F_σσσ|. Source: smoothing/README.md,
/// "Rounding".
struct UnitAccuracy {
  UnitJet error;  ///< value, s and ss
  UnitJet most;   ///< value, s, ss and sss
};

/// A profile π(τ; T) of local time τ ∈ [0, T] [s]: value, first and second time derivative, and the
/// derivatives of these three with respect to the duration T at fixed τ. Exact everywhere;
/// `second_T` jumps where the third time derivative does.
struct ProfileJet {
  double value = 0.0;     ///< π
  double first = 0.0;     ///< π̇ [1/s]
  double second = 0.0;    ///< π̈ [1/s²]
  double third = 0.0;     ///< d³π/dτ³ [1/s³], piecewise
  double value_T = 0.0;   ///< ∂π/∂T [1/s]
  double first_T = 0.0;   ///< ∂π̇/∂T [1/s²]
  double second_T = 0.0;  ///< ∂π̈/∂T [1/s³]
};

/// The same of a profile: of value, first and second.
struct ProfileAccuracy {
  ProfileJet error;  ///< largest error, by rounding
  ProfileJet most;   ///< largest size
};

/// π(τ; T) = F(τ/T, ω·T) by the chain rule; `f` taken at σ = τ/T.
inline ProfileJet ToTime(const UnitJet& f, double sigma, double duration, double omega) {
  const double r = 1.0 / duration;
  return {.value = f.value,
          .first = f.s * r,
          .second = f.ss * r * r,
          .third = f.sss * r * r * r,
          .value_T = -sigma * r * f.s + omega * f.theta,
          .first_T = (-f.s - sigma * f.ss) * r * r + omega * r * f.theta_s,
          .second_T = (-2.0 * f.ss - sigma * f.sss) * r * r * r + omega * r * r * f.theta_ss};
}

}  // namespace halfstep
