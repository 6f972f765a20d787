#include "experiments/checker/curves.h"

#include <algorithm>

#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep::checker {
namespace {

using Control = std::vector<Interval>;

Interval HullOf(const Control& control) {
  Interval hull = control.front();
  for (const Interval& b : control) hull = Hull(hull, b);
  return hull;
}

// The b_i of the derivative with respect to t of a polynomial in u = (t − t_k)/h.
Control Derivative(const Control& b, const Interval& h) {
  if (b.size() == 1) return {0.0};
  Control slope;
  for (size_t i = 0; i + 1 < b.size(); ++i) {
    slope.push_back(Interval(static_cast<double>(b.size() - 1)) * (b[i + 1] - b[i]) / h);
  }
  return slope;
}

// The b_i of the part [0, u], or with `rest` of the part [u, 1].
Control Cut(Control b, const Interval& u, bool rest) {
  const Interval other = Interval(1.0) - u;
  Control first = {b.front()}, last = {b.back()};
  while (b.size() > 1) {
    for (size_t i = 0; i + 1 < b.size(); ++i) b[i] = other * b[i] + u * b[i + 1];
    b.pop_back();
    first.push_back(b.front());
    last.push_back(b.back());
  }
  std::ranges::reverse(last);
  return rest ? last : first;
}

// Of the cubic piece by positions and velocities, these times its duration.
Control Cubic(const Interval& q0, const Interval& v0, const Interval& v1, const Interval& q1) {
  return {q0, q0 + v0 / Interval(3.0), q1 - v1 / Interval(3.0), q1};
}

// Velocities of the base's seven numbers at a knot, of its quaternion q ½ωq.
std::array<Interval, 7> BaseRates(const Trajectory& of, Eigen::Index k) {
  const Eigen::Vector3d v = of.base_v.col(k).head<3>(), half = 0.5 * of.base_v.col(k).tail<3>();
  const Vector turn = VectorOf(half), xyz = VectorOf(of.base.col(k).tail<3>());
  const Interval w = of.base(3, k);
  const Vector across = Cross(turn, xyz);
  return {v[0],
          v[1],
          v[2],
          -Dot(turn, xyz),
          w * turn[0] + across[0],
          w * turn[1] + across[1],
          w * turn[2] + across[2]};
}

Control OfBase(const Trajectory& of, Eigen::Index i, Eigen::Index k, const Interval& h) {
  const Interval b0 = of.base(i, k), b1 = of.base(i, k + 1);
  if (of.base_v.size() == 0) return {b0, b1};
  return Cubic(b0, h * Nth(BaseRates(of, k), i), h * Nth(BaseRates(of, k + 1), i), b1);
}

Control Positions(const Trajectory& of, Eigen::Index j, Eigen::Index k, const Interval& h) {
  const Interval q0 = of.q(j, k), q1 = of.q(j, k + 1);
  if (of.interpolation == Interpolation::kLinear) return {q0, q1};
  const Interval v0 = h * Interval(of.v(j, k)), v1 = h * Interval(of.v(j, k + 1));
  if (of.interpolation == Interpolation::kCubic) {
    return Cubic(q0, v0, v1, q1);
  }
  const Interval a0 = h * h * Interval(of.a(j, k)), a1 = h * h * Interval(of.a(j, k + 1));
  const Interval five = 5.0, twenty = 20.0, two = 2.0;
  return {q0,
          q0 + v0 / five,
          q0 + two * v0 / five + a0 / twenty,
          q1 - two * v1 / five + a1 / twenty,
          q1 - v1 / five,
          q1};
}

}  // namespace

Curves::Curves(const Trajectory& trajectory)
    : times_(trajectory.times), jumps_(trajectory.interpolation == Interpolation::kLinear) {
  const Eigen::Index joints = trajectory.q.rows();
  for (Eigen::Index j = 0; j < joints + trajectory.base.rows(); ++j) {
    std::vector<Piece>& pieces = pieces_.emplace_back();
    std::vector<std::array<Interval, kOrders>> hulls;
    for (size_t k = 0; k + 1 < times_.size(); ++k) {
      const Interval h = Interval(times_[k + 1]) - Interval(times_[k]);
      Piece& piece = pieces.emplace_back();
      const auto knot = static_cast<Eigen::Index>(k);
      if (j < joints) {
        piece.control[0] = Positions(trajectory, j, knot, h);
      } else {
        piece.control[0] = OfBase(trajectory, j - joints, knot, h);
      }
      for (size_t order = 1; order < kOrders; ++order) {
        piece.control[order] = Derivative(piece.control[order - 1], h);
      }
      for (size_t order = 0; order < kOrders; ++order)
        piece.hull[order] = HullOf(piece.control[order]);
      hulls.push_back(piece.hull);
    }
    std::vector<std::vector<std::array<Interval, kOrders>>>& levels = hulls_.emplace_back();
    levels.push_back(std::move(hulls));
    while (levels.back().size() > 1) {
      std::vector<std::array<Interval, kOrders>> joined;
      for (size_t i = 0; i < levels.back().size(); i += 2) {
        std::array<Interval, kOrders> both = levels.back()[i];
        if (i + 1 < levels.back().size()) {
          for (size_t order = 0; order < kOrders; ++order) {
            both[order] = Hull(both[order], levels.back()[i + 1][order]);
          }
        }
        joined.push_back(both);
      }
      levels.push_back(std::move(joined));
    }
  }
  if (trajectory.base.size() > 0 && trajectory.base_v.size() > 0) CheckTurns(trajectory);
}

// With s the sum of both knots' quaternions, |s| ≤ 2, a quaternion q between both has s·q no less
// than the least s·b_i, and so |q| no less than half of that. Straight pieces have s·b_i ≥ 1.
void Curves::CheckTurns(const Trajectory& trajectory) const {
  const auto base = static_cast<size_t>(trajectory.q.rows());
  for (size_t k = 0; k + 1 < times_.size(); ++k) {
    for (size_t i = 0; i < 4; ++i) {
      Interval along;
      for (size_t n = base + 3; n < base + 7; ++n) {
        const Control& b = pieces_[n][k].control[0];
        along = along + (b.front() + b.back()) * b[i];
      }
      if (along.lo > 0.26) continue;
      throw InputError(
          {trajectory.file +
           Formatted(": base: knot %zu: turns too fast for the time until the next one "
                     "(valid: knots nearer to each other)",
                     k + 1)});
    }
  }
}

Interval Curves::OfPart(const Piece& piece, int order, double from, double to, size_t k) const {
  if (from <= times_[k] && to >= times_[k + 1]) return Nth(piece.hull, order);
  const Interval start = times_[k], h = Interval(times_[k + 1]) - start;
  const auto within = [&](double t) {
    const Interval u = (Interval(t) - start) / h;
    return Interval(std::clamp(u.lo, 0.0, 1.0), std::clamp(u.hi, 0.0, 1.0));
  };
  const Interval u0 = within(std::max(from, times_[k])), u1 = within(std::min(to, times_[k + 1]));
  // [u0, u1] is the part [u0/u1, 1] of [0, u1].
  Control control = Cut(Nth(piece.control, order), Interval(u1.hi), false);
  if (u1.hi > 0.0) {
    const double share = std::clamp(Below(u0.lo / u1.hi), 0.0, 1.0);
    control = Cut(std::move(control), Interval(share), true);
  }
  const Interval part = HullOf(control), whole = Nth(piece.hull, order);
  return {std::max(part.lo, whole.lo), std::min(part.hi, whole.hi)};
}

Interval Curves::Range(int joint, int order, double from, double to) const {
  const std::vector<Piece>& pieces = Nth(pieces_, joint);
  const auto piece_of = [&](double t) {  // the last one that begins at or before t
    const auto after = std::ranges::upper_bound(times_, t);
    const auto k = std::max<std::ptrdiff_t>(0, after - times_.begin() - 1);
    return std::min(static_cast<size_t>(k), pieces.size() - 1);
  };
  size_t first = piece_of(from);
  const size_t last = piece_of(to);
  if (first > 0 && from == times_[first]) --first;  // both sides of a knot
  Interval range = OfPart(pieces[first], order, from, to, first);
  if (last == first) return range;
  range = Hull(range, OfPart(pieces[last], order, from, to, last));
  // The pieces between, by the largest blocks.
  const auto& levels = Nth(hulls_, joint);
  for (size_t i = first + 1; i < last;) {
    size_t level = 0;
    while (level + 1 < levels.size() && i % (size_t{2} << level) == 0 &&
           i + (size_t{2} << level) <= last) {
      ++level;
    }
    range = Hull(range, Nth(levels[level][i >> level], order));
    i += size_t{1} << level;
  }
  return range;
}

Curve Curves::On(int joint, double from, double to) const {
  const double middle = 0.5 * from + 0.5 * to;
  Curve curve;
  curve.h = Interval(from, to).FarthestFrom(middle);
  for (int order = 0; order < 3; ++order)
    Nth(curve.at, order) = Range(joint, order, middle, middle);
  curve.over[3] = Range(joint, 3, from, to);
  return curve.Enclose();
}

Interval Curves::Jump(int joint, int knot) const {
  const std::vector<Piece>& pieces = Nth(pieces_, joint);
  if (!jumps_ || knot <= 0 || knot >= std::ssize(pieces)) return 0.0;
  return Nth(pieces, knot).control[1].front() - Nth(pieces, knot - 1).control[1].back();
}

}  // namespace halfstep::checker
