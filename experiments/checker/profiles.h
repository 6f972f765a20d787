#pragma once

#include <array>
#include <utility>
#include <vector>

#include "experiments/checker/interval.h"

namespace halfstep::checker {

/// A function π of σ made of pieces that join with two derivatives, Σ c_k x^k with
/// x = (σ − centre)/width, constant before and after. Source: wpg/README.md, "Half-step".
class Profile {
 public:
  /// One piece.
  struct Piece {
    Interval begin, end;           ///< σ
    Interval center, width;        ///< |x| ≤ 1 on it
    std::vector<Interval> powers;  ///< c_k
    double tail = 0.0;             ///< |π| and |dπ/dx| are farther from the sum by no more
  };

  /// From 0 before the first piece to 1 after the last.
  explicit Profile(const std::vector<Piece>& pieces);
  /// S(x) = 10x³ − 15x⁴ + 6x⁵ on [begin, end].
  static Profile Step(const Interval& begin, const Interval& end);
  /// S_r on [begin, end]: its speed rises in the fraction r, is constant, and falls.
  static Profile RampedStep(const Interval& begin, const Interval& end, double r);

  /// π, π', π'' and π''' of all σ of an interval, the last of the pieces on both sides.
  std::array<Interval, 4> At(const Interval& sigma) const;
  /// Where it begins and ends to change.
  std::pair<Interval, Interval> span() const { return {pieces_[1].begin, pieces_.back().begin}; }

 private:
  std::vector<Piece> pieces_;  // with both constants
};

/// The ZMP p that goes from rest to rest, and the CoM c of c'' = θ²(c − p).
/// Source: wpg/README.md, "Rest to rest".
struct Pendulum {
  Interval theta_squared;  ///< θ²
  Profile com, zmp;        ///< c, of which only value and slope are of use; p

  /// For a shift 2δ and a bump that rises and falls in the fraction `ramp` each; θ > 0.
  static Pendulum Of(const Interval& theta_squared, const Interval& shift, double ramp);
  /// c and its derivatives: those of second and third order follow from the equation.
  std::array<Interval, 4> ComAt(const Interval& sigma) const;
};

}  // namespace halfstep::checker
