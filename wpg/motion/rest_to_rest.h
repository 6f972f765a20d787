#pragma once

#include <optional>
#include <vector>

#include "wpg/motion/profile_jet.h"
#include "wpg/motion/vector_ball.h"

namespace halfstep {

/// The normalized ZMP shift p(σ) and its CoM c(σ), both from 0 to 1, that satisfy the LIPM
/// c_σσ = θ²·(c − p) for all σ ∈ [0, 1] and begin and end exactly at rest:
/// c(0) = p(0) = 0, c(1) = p(1) = 1, c_σ(0) = c_σ(1) = 0. Here θ = ω·T.
///
///     p(σ) = −a·B(σ/σ₁)                     on [0, σ₁],  B(x) = (4x(1 − x))³,
///     p(σ) = ½ + (15x − 10x³ + 3x⁵)/16      on [σ₁, ½],  x = (σ − ½)/δ,  σ₁ = ½ − δ,
///     p(σ) = 1 − p(1 − σ)                   on [½, 1].
///
/// With a `bump_ramp` r the bump has a flat top: B(x) = S(x/r) on [0, r], 1 on [r, 1 − r], S((1 −
/// x)/r) on [1 − r, 1], S the Smoothstep.
///
/// p is C². The pre-bump's amplitude a is the one for which c(½) = ½; by antisymmetry rest at the
/// start is then rest at the end. On each piece c = polynomial + e^{±θσ}; it is evaluated by the
/// power series of that closed form, summed to rounding, because its terms cancel (the polynomial's
/// coefficients grow like (θδ)⁻⁵, and the result does not).
/// Source: wpg/README.md, "Rest to rest".
class RestToRest {
 public:
  /// theta = ω·T ∈ [0.5, 60]; shift_fraction = 2δ = (t2 − t1)/T ∈ [0.01, 0.5]; bump_ramp ∈ [0.1,
  /// 0.5], or none (std::logic_error).
  RestToRest(double theta, double shift_fraction, std::optional<double> bump_ramp = std::nullopt);

  /// c and p at σ: 0 and at rest before 0, 1 and at rest after 1.
  UnitJet Com(double sigma) const;
  UnitJet Zmp(double sigma) const;  ///< p; see Com

  /// sup |c_σσ| over all σ: θ²·(½ + a), since |c − p| ≤ ½ + a (wpg/README.md, "Rest to rest").
  double ComSecondBound() const { return theta_ * theta_ * (0.5 + bump_.value); }
  /// A bound of |p_σσ| on [from, to]: exact on the shift, and a·sup|B''|/σ₁² where [from, to]
  /// touches a bump; sup|B''| is 24, or 10/√3/r² with a flat top.
  double ZmpSecondBound(double from, double to) const;

  /// Values that hold c_σσσ on [from, to]: that at the middle, and θ²·(|c_σσ| + |p_σσ|) times half
  /// of the length around it, since c_σσσ = θ²·(c_σ − p_σ) is continuous.
  Range ComThirdRange(double from, double to) const;

  /// a: how far the ZMP goes beyond either end of the shift, as a fraction of it.
  double bump() const { return bump_.value; }

 private:
  struct Coefficient {
    double value = 0.0;
    double theta = 0.0;  ///< its derivative with respect to θ.
  };
  /// Σ_k coefficients[k]·x^k with x = (σ − center)/width, where σ < end.
  struct Piece {
    double center;
    double width;
    double end;
    std::vector<Coefficient> coefficients;

    UnitJet At(double sigma) const;
  };

  // The value on [0, 1], by the pieces of [0, ½].
  static UnitJet At(const std::vector<Piece>& pieces, double sigma);

  double theta_;
  double first_;            // σ₁
  double bump_second_;      // sup|B''|
  Coefficient bump_;        // a
  std::vector<Piece> com_;  // those of the bump on [0, σ₁], and [σ₁, ½]
  std::vector<Piece> zmp_;
};

}  // namespace halfstep
