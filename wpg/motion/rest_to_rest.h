#pragma once

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
/// That is the round bump, which the `bump_ramp` r = 1 stands for. For r ≤ ½ the bump has a flat
/// top: B(x) = S(x/r) on [0, r], 1 on [r, 1 − r], S((1 − x)/r) on [1 − r, 1], S the Smoothstep. In
/// between it is the mixture w·(round) + (1 − w)·(that for ½), w = 2r − 1.
///
/// p is C². The pre-bump's amplitude a is the one for which c(½) = ½; by antisymmetry rest at the
/// start is then rest at the end. On each piece c = polynomial + e^{±θσ}; it is evaluated by the
/// power series of that closed form, summed to rounding, because its terms cancel (the polynomial's
/// coefficients grow like (θδ)⁻⁵, and the result does not).
/// Source: wpg/README.md, "Rest to rest".
class RestToRest {
 public:
  /// theta = ω·T ∈ [0.5, 60]; shift_fraction = 2δ = (t2 − t1)/T ∈ [0.01, 0.5]; bump_ramp ∈ [0.1,
  /// 1] (std::logic_error).
  RestToRest(double theta, double shift_fraction, double bump_ramp = 1.0);

  /// c and p at σ: 0 and at rest before 0, 1 and at rest after 1.
  UnitJet Com(double sigma) const { return At(com_, sigma); }
  UnitJet Zmp(double sigma) const { return At(zmp_, sigma); }  ///< p; see Com

  /// Derivatives of Com(σ) and Zmp(σ) with respect to shift_fraction: only value, s and ss.
  UnitJet ComByShift(double sigma) const { return ByShift(com_, sigma); }
  UnitJet ZmpByShift(double sigma) const { return ByShift(zmp_, sigma); }  ///< see ComByShift
  /// The same with respect to bump_ramp; at ½, where it has a kink, towards smaller values.
  UnitJet ComByBumpRamp(double sigma) const { return ByBumpRamp(com_, com_by_ramp_, sigma); }
  UnitJet ZmpByBumpRamp(double sigma) const {  ///< see ComByBumpRamp
    return ByBumpRamp(zmp_, zmp_by_ramp_, sigma);
  }

  /// sup |c_σσ| over all σ: θ²·(½ + a), since |c − p| ≤ ½ + a (wpg/README.md, "Rest to rest").
  double ComSecondBound() const { return theta_ * theta_ * (0.5 + bump_.value); }
  /// A bound of |p_σσ| on [from, to]: exact on the shift, and a·sup|B''|/σ₁² where [from, to]
  /// touches a bump; sup|B''| is 24, or 10/√3/r² with a flat top; of a mixture theirs is mixed.
  double ZmpSecondBound(double from, double to) const;

  /// Values that hold c_σσσ on [from, to]: that at the middle, and θ²·(|c_σσ| + |p_σσ|) times half
  /// of the length around it, since c_σσσ = θ²·(c_σ − p_σ) is continuous.
  Range ComThirdRange(double from, double to) const;

  /// How Com and Zmp are computed, where θ is off by 4 roundings: running errors of the same
  /// series.
  const UnitAccuracy& ComAccuracy() const { return com_accuracy_; }
  const UnitAccuracy& ZmpAccuracy() const { return zmp_accuracy_; }  ///< see ComAccuracy

  /// a: how far the ZMP goes beyond either end of the shift, as a fraction of it.
  double bump() const { return bump_.value; }

 private:
  struct Coefficient {
    double value = 0.0;
    double theta = 0.0;  // its derivative with respect to θ
    double shift = 0.0;  // and to shift_fraction
  };
  // Σ_k coefficients[k]·x^k with x = (σ − center)/width, where σ < end.
  struct Piece {
    double center;
    double width;
    double end;
    double center_shift, width_shift;  // their derivatives with respect to shift_fraction
    std::vector<Coefficient> coefficients;

    template <bool with_theta = true>  // false: without derivatives with respect to θ
    UnitJet At(double sigma) const;
    UnitJet ByShift(double sigma) const;
  };

  // The piece of [0, ½] in which σ is.
  static const Piece& PieceAt(const std::vector<Piece>& pieces, double sigma);
  // The values on [0, 1], by the pieces of [0, ½].
  static UnitJet At(const std::vector<Piece>& pieces, double sigma);
  static UnitJet ByShift(const std::vector<Piece>& pieces, double sigma);
  UnitJet ByBumpRamp(const std::vector<Piece>& pieces, const std::vector<Piece>& by_ramp,
                     double sigma) const;

  // `round`: the share of the round bump.
  void FindAccuracy(double shift_fraction, double bump_ramp, double round);

  double theta_;
  double first_;            // σ₁
  double bump_second_;      // sup|B''|
  Coefficient bump_;        // a
  std::vector<Piece> com_;  // those of the bump on [0, σ₁], and [σ₁, ½]
  std::vector<Piece> zmp_;
  // Derivatives with respect to bump_ramp, but for what a multiplies on [0, σ₁]; and a'/a.
  std::vector<Piece> com_by_ramp_, zmp_by_ramp_;
  double bump_by_ramp_ = 0.0;
  UnitAccuracy com_accuracy_, zmp_accuracy_;
};

}  // namespace halfstep
