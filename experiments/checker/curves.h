#pragma once

#include <array>
#include <vector>

#include "experiments/checker/interval.h"
#include "experiments/checker/taylor.h"
#include "experiments/checker/trajectory.h"

namespace halfstep::checker {

/// The curves of a trajectory's joints between its knots, and their derivatives, as bounds that
/// hold for every time of an interval. Before the first knot and after the last one joints rest.
///
/// Between knots a curve is a polynomial in Bernstein form, Σ b_i B_i(u) with u = (t − t_k)/h, so
/// it stays within the hull of its b_i. Of a part [u0, u1] the b_i follow by de Casteljau's
/// subdivision. The bounds of linear pieces are the knots themselves, without rounding.
class Curves {
 public:
  /// Of all joints of a trajectory, and after these the seven numbers of its base, if it has one:
  /// its quaternion is never shorter than ⅛. Throws InputError where velocities of the base are so
  /// large that this is not sure.
  explicit Curves(const Trajectory& trajectory);

  double begin() const { return times_.front(); }              ///< the first knot [s]
  double end() const { return times_.back(); }                 ///< the last knot [s]
  const std::vector<double>& times() const { return times_; }  ///< of all knots [s]

  /// Bounds of the position (order 0) or of its derivatives up to the third one for all
  /// t ∈ [from, to], both within [begin, end]. At a knot the derivatives are those of the pieces on
  /// both sides. Of linear pieces the second one is 0 (see Jump).
  Interval Range(int joint, int order, double from, double to) const;
  /// The position on [from, to]. Precondition: no knot lies between both.
  Curve On(int joint, double from, double to) const;
  /// How far the velocity jumps at a knot between two pieces [rad/s]: 0 where it is continuous by
  /// construction.
  Interval Jump(int joint, int knot) const;

 private:
  static constexpr size_t kOrders = 4;
  struct Piece {
    std::array<std::vector<Interval>, kOrders> control;  // b_i of each order
    std::array<Interval, kOrders> hull;
  };
  Interval OfPart(const Piece& piece, int order, double from, double to, size_t k) const;
  void CheckTurns(const Trajectory& trajectory) const;

  std::vector<double> times_;
  std::vector<std::vector<Piece>> pieces_;  // by joint
  // hulls_[joint][level][i]: of pieces i·2^level … (i + 1)·2^level − 1.
  std::vector<std::vector<std::vector<std::array<Interval, kOrders>>>> hulls_;
  bool jumps_ = false;
};

}  // namespace halfstep::checker
