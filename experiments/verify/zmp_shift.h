#pragma once

#include <vector>

namespace halfstep::verify {

/// A number from 0 to 1 and its first two derivatives.
struct Jet {
  double value = 0, first = 0, second = 0;  ///< with respect to what it is a function of
};

/// The step S(x) = 10x³ − 15x⁴ + 6x⁵ on [begin, end], 0 before and 1 after.
Jet StepAt(double sigma, double begin, double end);
/// sup |S''| over [from, to].
double StepSecondBound(double from, double to, double begin, double end);

/// The ZMP's shift p(σ) from rest to rest, σ ∈ [0, 1], and the CoM c(σ) that the pendulum
/// c'' = θ²(c − p) moves with it: a bump −a·B before σ₁ = ½ − δ, the step from σ₁ to 1 − σ₁, and
/// the mirror image p(σ) = 1 − p(1 − σ) of the bump. Source: wpg/README.md, "Rest to rest".
class ZmpShift {
 public:
  /// `shift`: 2δ ∈ [0.01, 0.5]; the bump rises for the fraction `ramp` ∈ [0.1, 1] of its length;
  /// θ ∈ [0.5, 60]. Precondition: these (std::logic_error).
  ZmpShift(double theta, double shift, double ramp);

  Jet Com(double sigma) const { return At(&Piece::com, sigma); }  ///< c
  Jet Zmp(double sigma) const { return At(&Piece::zmp, sigma); }  ///< p
  /// sup |c''| over all σ: θ²(½ + a).
  double ComSecondBound() const { return theta_ * theta_ * (0.5 + bump_); }
  /// A bound of |p''| over [from, to].
  double ZmpSecondBound(double from, double to) const;

 private:
  // Powers of x = (σ − center)/width, up to σ = end.
  struct Piece {
    double center, width, end;
    std::vector<double> com, zmp;
  };
  Jet At(std::vector<double> Piece::*powers, double sigma) const;

  double theta_, first_;       // θ, σ₁
  double bump_ = 0;            // a
  double bump_second_ = 0;     // sup |B''|, by the bump's length
  std::vector<Piece> pieces_;  // of [0, ½]
};

}  // namespace halfstep::verify
