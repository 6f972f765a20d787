#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <unsupported/Eigen/AutoDiff>
#include <vector>

#include "wpg/motion/profile_jet.h"
#include "wpg/rounded.h"

namespace halfstep {

/// A number with its derivatives with respect to θ and to the shift's fraction.
using UnitDual = Eigen::AutoDiffScalar<Eigen::Vector2d>;

// What follows is there for UnitDual and for WithError, which finds how far rounding carries what
// is computed with the other.

/// The solution c(x) of the LIPM c_xx = λ²·(c − p) with c(0) = c0 and c_x(0) = c1, where p has the
/// coefficients `p`: coefficients of powers of x, from x⁰ on, summed until what is left out is
/// below rounding on |x| ≤ 1.
template <typename Number>
std::vector<Number> SolveLipm(const Number& lambda, std::span<const Number> p, const Number& c0,
                              const Number& c1);

/// Σ c_k·x^k and Σ k·c_k·x^{k−1} at x = ±1.
template <typename Number>
std::array<Number, 2> Ends(const std::vector<Number>& c, double x);

/// CoM c and ZMP p on a piece of [0, ½], in powers of x = (σ − center)/width.
template <typename Number>
struct UnitPiece {
  Number center;            ///< of x = 0
  Number width;             ///< of x from 0 to 1
  std::vector<Number> com;  ///< c
  std::vector<Number> zmp;  ///< p
};

/// Raises `error` (value, s and ss) to what Horner's rule and the coefficients' own errors make of
/// Σ c_k x^k, x = (σ − center)/width, for all |x| ≤ 1, and `most` (sss) to its third derivative.
/// What the series leaves out is below 1e-21 of the sum of its terms.
void AddSeries(const std::vector<WithError>& series, const WithError& center,
               const WithError& width, UnitJet* error, UnitJet* most);

/// The pre-bump −B of RestToRest on [0, σ₁], `first` = σ₁, and the CoM's motion under it from rest;
/// r is the bump's ramp.
template <typename Number>
std::vector<UnitPiece<Number>> PreBump(const Number& theta, const Number& first, double r);
/// Its derivative with respect to r, which is from rest, too. At ½ towards smaller r.
std::vector<UnitPiece<UnitDual>> PreBumpByRamp(const UnitDual& theta, const UnitDual& first,
                                               double r);

}  // namespace halfstep
