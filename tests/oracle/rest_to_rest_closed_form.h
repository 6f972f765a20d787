#pragma once

#include <array>

#include "tests/oracle/real.h"

namespace halfstep::oracle {

/// CoM and ZMP of a half-step as fractions of their way, with derivatives in σ = τ/T.
struct ComZmp {
  Real c = 0, c_rate = 0, p = 0, p_rate = 0;
};

/// The pair (c, p) of wpg/README.md, "Rest to rest", by hyperbolic functions: on each piece
/// c = Σ_k D^{2k} p/λ^{2k} + A cosh λx + B sinh λx. This cancels (up to thirteen digits), which
/// quadruple precision bears.
class RestToRestClosedForm {
 public:
  /// `theta` = ωT, `shift` = 2δ.
  RestToRestClosedForm(Real theta, Real shift);
  /// σ is clamped to [0, 1].
  ComZmp At(Real sigma) const;

 private:
  using Polynomial = std::array<Real, 7>;
  // p + p''/λ² + p''''/λ⁴ + p''''''/λ⁶, which solves c − c''/λ² = p.
  static Polynomial Particular(const Polynomial& p, Real lambda);
  ComZmp OnBump(Real sigma) const;
  ComZmp OnShift(Real sigma) const;

  Real sigma1_, delta_, lambda_bump_, lambda_shift_;
  Polynomial bump_{}, bump_particular_{}, shift_{}, shift_particular_{};
  Real bump_cosh_ = 0, bump_sinh_ = 0;  // of the bump for amplitude 1
  Real amplitude_ = 0, shift_sinh_ = 0;
};

}  // namespace halfstep::oracle
