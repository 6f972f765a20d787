#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <unsupported/Eigen/AutoDiff>
#include <vector>

namespace halfstep {

/// A number with its derivatives with respect to θ and to the shift's fraction.
using UnitDual = Eigen::AutoDiffScalar<Eigen::Vector2d>;
/// Coefficients of powers of x, from x⁰ on.
using UnitSeries = std::vector<UnitDual>;

/// The solution c(x) of the LIPM c_xx = λ²·(c − p) with c(0) = c0 and c_x(0) = c1, where p has the
/// coefficients `p`: summed until what is left out is below rounding on |x| ≤ 1.
UnitSeries SolveLipm(const UnitDual& lambda, std::span<const double> p, const UnitDual& c0,
                     const UnitDual& c1);

/// Σ c_k·x^k and Σ k·c_k·x^{k−1} at x = ±1.
std::array<UnitDual, 2> Ends(const UnitSeries& c, double x);

/// CoM c and ZMP p on a piece of [0, ½], in powers of x = (σ − center)/width.
struct UnitPiece {
  UnitDual center;  ///< of x = 0
  UnitDual width;   ///< of x from 0 to 1
  UnitSeries com;   ///< c
  UnitSeries zmp;   ///< p
};

/// The pre-bump −B of RestToRest on [0, σ₁], `first` = σ₁, and the CoM's motion under it from rest;
/// r is the bump's ramp.
std::vector<UnitPiece> PreBump(const UnitDual& theta, const UnitDual& first, double r);
/// Its derivative with respect to r, which is from rest, too. At ½ towards smaller r.
std::vector<UnitPiece> PreBumpByRamp(const UnitDual& theta, const UnitDual& first, double r);

}  // namespace halfstep
