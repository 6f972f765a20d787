#pragma once

#include <array>
#include <vector>

#include "tests/oracle/real.h"

namespace halfstep::oracle {

/// CoM and ZMP of a half-step as fractions of their way, with derivatives in σ = τ/T.
struct ComZmp {
  Real c = 0, c_rate = 0, p = 0, p_rate = 0;
  Real c_second = 0;
};

/// The pair (c, p) of wpg/README.md, "Rest to rest", by hyperbolic functions: on each piece
/// c = Σ_k D^{2k} p/λ^{2k} + A cosh λx + B sinh λx. This cancels (up to thirteen digits), which
/// quadruple precision bears.
class RestToRestClosedForm {
 public:
  /// `theta` = ωT, `shift` = 2δ, `bump_ramp` = r of the bump; 1: the round bump.
  RestToRestClosedForm(Real theta, Real shift, Real bump_ramp);
  /// σ is clamped to [0, 1].
  ComZmp At(Real sigma) const;

 private:
  ComZmp ByPieces(Real sigma) const;

  using Polynomial = std::array<Real, 7>;
  // A piece of σ, with x = (σ − center)/width.
  struct Piece {
    Real center = 0, width = 0, lambda = 0;
    Polynomial zmp{}, particular{};
    Real cosh = 0, sinh = 0;  // of the free motion

    ComZmp At(Real x) const;
  };
  // p + p''/λ² + p/λ⁴ + p''/λ⁶, which solves c − c''/λ² = p.
  static Polynomial Particular(const Polynomial& p, Real lambda);
  static Piece Begun(Real theta, Real center, Real width, const Polynomial& zmp, const ComZmp& at);

  Real theta_, sigma1_, delta_;
  std::vector<Piece> bump_;  // for amplitude 1
  Piece shift_;
  Real amplitude_ = 0;
};

}  // namespace halfstep::oracle
