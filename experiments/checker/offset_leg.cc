#include "experiments/checker/offset_leg.h"

#include <Eigen/LU>
#include <algorithm>

#include "experiments/checker/cut_leg.h"
#include "experiments/checker/leg_motion.h"

namespace halfstep::checker {
namespace {

using Box = std::array<Interval, 6>;
using Angles = OffsetLeg::Angles;
using Lift = OffsetLeg::Lift;

constexpr double kShortest = 1e-6;  // part [s], or of the offsets

// About the inverse C of the Jacobian J, and 1 − C J.
struct Slopes {
  Eigen::Matrix<double, 6, 6> C;
  std::array<Box, 6> rest;

  double Of(size_t i, size_t k) const { return C.data()[6 * k + i]; }
};
// Of all postures path(t) + E.
template <int N>
Slopes SlopesAlong(const Leg& leg, const Given<Curve>& given, const Angles& path, const Box& E) {
  std::array<Taylor<N>, 6> q;
  for (size_t i = 0; i < 6; ++i) q[i] = path[i].Derivative<0, N>() + Taylor<N>(E[i]);
  const CutLeg<N> cut(leg, given, q);
  if (!(cut.Trace().over[0].lo > 0.0)) throw NotDefined();
  std::array<std::array<Taylor<N>, 6>, 6> J;  // columns
  Slopes slopes;
  for (size_t i = 0; i < 6; ++i) {
    J[i] = cut.Slope(i);
    for (size_t k = 0; k < 6; ++k) slopes.C.data()[6 * i + k] = J[i][k].at[0].Middle();
  }
  slopes.C = slopes.C.inverse().eval();
  if (!slopes.C.allFinite() || slopes.C.cwiseAbs().maxCoeff() > 1e9) throw NotDefined();
  for (size_t i = 0; i < 6; ++i) {
    for (size_t k = 0; k < 6; ++k) {
      Taylor<N> rest = i == k ? 1.0 : 0.0;
      for (size_t j = 0; j < 6; ++j) rest = rest - slopes.Of(i, j) * J[k][j];
      slopes.rest[i][k] = rest.over[0];
    }
  }
  return slopes;
}

// a + M x.
Box Affine(const Box& a, const std::array<Box, 6>& M, const Box& x) {
  Box sum = a;
  for (size_t i = 0; i < 6; ++i) {
    for (size_t k = 0; k < 6; ++k) sum[i] = sum[i] + M[i][k] * x[k];
  }
  return sum;
}
// The image of a box around what is given, where it lies in its inside: a continuous map has a
// fixed point there.
template <typename Map>
Box Contracted(Box box, const Map& map) {
  for (int round = 0; round < 8; ++round) {
    for (Interval& x : box) {
      const double more = 0.2 * (x.hi - x.lo) + 1e-12 * (1.0 + x.Magnitude());
      x = {x.lo - more, x.hi + more};
    }
    const Box image = map(box);
    bool inside = true;
    for (size_t i = 0; i < 6; ++i) {
      inside = inside && image[i].lo > box[i].lo && image[i].hi < box[i].hi;
      box[i] = Hull(box[i], image[i]);
    }
    if (inside) return image;
  }
  throw NotDefined();
}
// K(E) = −C f(path) + (1 − C J(path + E))E, 0 in E, holds every e in E with f(path + e) = 0, and
// there is just one where it lies in the inside of E: at every instant.
template <int N>
Box Around(const Leg& leg, const Given<Curve>& given, const Angles& path, Box E) {
  for (Interval& e : E) e = Hull(e, 0.0);
  std::array<Taylor<N>, 6> q;
  for (size_t i = 0; i < 6; ++i) q[i] = path[i].Derivative<0, N>();
  const std::array<Taylor<N>, 6> f = CutLeg<N>(leg, given, q).Mismatch();
  return Contracted(E, [&](const Box& box) {
    const Slopes slopes = SlopesAlong<N>(leg, given, path, box);
    Box step;
    for (size_t i = 0; i < 6; ++i) {
      Taylor<N> sum;
      for (size_t k = 0; k < 6; ++k) sum = sum + slopes.Of(i, k) * f[k];
      step[i] = -sum.over[0];
    }
    return Affine(step, slopes.rest, box);
  });
}

// Of f(q(t), t) = 0 the Nth derivative is J q⁽ᴺ⁾ and what it would be if q⁽ᴺ⁾ were 0. `given` is of
// one instant.
template <int N>
void AddDerivative(const Leg& leg, const Given<Curve>& given, const Slopes& slopes,
                   Angles* angles) {
  std::array<Taylor<N>, 6> q;
  for (size_t i = 0; i < 6; ++i) {
    q[i] = (*angles)[i].template Derivative<0, N>();
    q[i].over[N] = 0.0;
    q[i].Enclose();
  }
  const std::array<Taylor<N>, 6> f = CutLeg<N>(leg, given, q).Mismatch();
  Box right{};
  for (size_t i = 0; i < 6; ++i) {
    for (size_t k = 0; k < 6; ++k) right[i] = right[i] - slopes.Of(i, k) * f[k].over[N];
  }
  const auto solve = [&](const Box& y) { return Affine(right, slopes.rest, y); };
  const Box found = solve(Contracted(right, solve));
  for (size_t i = 0; i < 6; ++i) {
    if constexpr (N < 3) (*angles)[i].at[N] = found[i];
    if constexpr (N == 3) (*angles)[i].over[N] = found[i];
  }
}

Interval ValueAt(const Curve& f, const Interval& t) {
  const Interval half = Interval(0.5) * Square(t), sixth = half * (t / Interval(3.0));
  return f.at[0] + t * f.at[1] + half * f.at[2] + sixth * f.over[3];
}

// What both say of one number.
Interval Both(const Interval& a, const Interval& b) {
  return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
}

Box ValuesAt(const Lift& lift, const Interval& t) {
  Box q;
  for (size_t i = 0; i < 6; ++i) {
    q[i] = Both(ValueAt(lift.q[i], t), ValueAt(lift.path[i], t) + lift.E[i]);
  }
  return q;
}

// The angles on m ± h that are in the box q at the time m + t: around a numerical solution.
Lift Lifted(const Leg& leg, const Given<Curve>& given, double h, const Interval& t, const Box& q) {
  const Given<Curve> middle = AtOneInstant(given, false), anywhere = AtOneInstant(given, true);
  Lift lift;
  auto& [at, path, E] = lift;
  Angles jets;
  for (size_t i = 0; i < 6; ++i) at[i] = q[i].Middle();
  double largest = 1.0;  // of the last step
  for (int k = 0; k < 8 && largest > 1e-12; ++k) {
    std::array<Taylor<1>, 6> angles;
    for (size_t i = 0; i < 6; ++i) angles[i] = at[i].at[0];
    const std::array<Taylor<1>, 6> f = CutLeg<1>(leg, middle, angles).Mismatch();
    const Slopes slopes = SlopesAlong<1>(leg, middle, at, Box());
    largest = 0.0;
    for (size_t i = 0; i < 6; ++i) {
      Interval step = 0.0;
      for (size_t j = 0; j < 6; ++j) step = step + slopes.Of(i, j) * f[j].at[0];
      largest = std::max(largest, step.Magnitude());
      at[i] = (at[i].at[0] - step).Middle();
    }
  }
  const Box off = Around<1>(leg, middle, at, Box());
  const Slopes here = SlopesAlong<1>(leg, middle, at, off);
  for (size_t i = 0; i < 6; ++i) at[i].at[0] = at[i].at[0] + off[i];
  AddDerivative<1>(leg, middle, here, &at);
  AddDerivative<2>(leg, middle, here, &at);
  for (size_t i = 0; i < 6; ++i) {
    for (size_t k = 0; k < 3; ++k) path[i].at[k] = at[i].at[k].Middle();
    path[i].h = h;
    path[i].Enclose();
    E[i] = Hull(q[i] - ValueAt(path[i], t), at[i].at[0] - path[i].at[0]);
  }
  E = Around<3>(leg, given, path, E);
  const Slopes along = SlopesAlong<3>(leg, given, path, E);
  for (size_t i = 0; i < 6; ++i) jets[i].at[0] = path[i].over[0] + E[i];
  AddDerivative<1>(leg, anywhere, along, &jets);
  AddDerivative<2>(leg, anywhere, along, &jets);
  // What follows of lower derivatives from those at m is narrower, and the third is then, too.
  for (int round = 0; round < (h > 0.0 ? 3 : 1); ++round) {
    AddDerivative<3>(leg, anywhere, along, &jets);
    for (size_t i = 0; i < 6; ++i) {
      at[i].h = h;
      at[i].over[3] = jets[i].over[3];
      at[i].Enclose();
      for (size_t k = 0; k < 3; ++k) jets[i].at[k] = Both(jets[i].at[k], at[i].over[k]);
    }
  }
  return lift;
}

double HalfOf(double from, double to) {
  return Interval(from, to).FarthestFrom(0.5 * from + 0.5 * to);
}
Given<Curve> Own(const Leg& leg, const FrameIn<Curve>& foot) {
  Given<Curve> given{.points = {}, .foot = foot};
  for (size_t i = 0; i < 6; ++i) given.points[i] = VectorOf<Curve>(leg.joints[i].point_B);
  return given;
}

}  // namespace

template <typename Way>
bool OffsetLeg::Extend(const Way& way, double from, double to, Box* q,
                       std::vector<Part>* parts) const {
  const double middle = 0.5 * from + 0.5 * to;
  try {
    const Lift lift =
        Lifted(leg_, way(from, to), HalfOf(from, to), Interval(from) - Interval(middle), *q);
    // Made narrow where it ends, so that the next one contracts.
    const Lift end = Lifted(leg_, way(to, to), HalfOf(to, to), 0.0,
                            ValuesAt(lift, Interval(to) - Interval(middle)));
    for (size_t i = 0; i < 6; ++i) (*q)[i] = end.q[i].at[0];
    parts->push_back({from, to, lift});
    return true;
  } catch (const NotDefined&) {
  }
  return to - from > kShortest && Extend(way, from, middle, q, parts) &&
         Extend(way, middle, to, q, parts);
}

void OffsetLeg::Follow(const std::vector<double>& knots, const Foot& foot) {
  parts_.clear();
  if (knots.size() < 2) return;
  const FrameIn<Curve> begin =
      AtOneInstant({.points = {}, .foot = foot(knots[0], knots[0])}, true).foot;
  const Eigen::Vector3d &own = leg_.X_BSole.translation(), &met = met_.X_BSole.translation();
  // With a share of the offsets.
  const auto shared = [&](double from, double to) {
    Curve share;
    share.h = HalfOf(from, to);
    share.at = {0.5 * from + 0.5 * to, 1.0, 0.0};
    share.Enclose();
    const auto between = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      const VectorIn<Curve> way = VectorOf<Curve>(b) - VectorOf<Curve>(a);
      return VectorOf<Curve>(a) + VectorIn<Curve>{share * way[0], share * way[1], share * way[2]};
    };
    Given<Curve> given{.points = {}, .foot = begin};
    for (size_t i = 0; i < 6; ++i) {
      given.points[i] = between(met_.joints[i].point_B, leg_.joints[i].point_B);
    }
    // The frame that this sole carries, in that which the leg's own does.
    given.foot.p = begin * (VectorOf<Curve>(own) - between(met, own));
    return given;
  };
  Box q;
  std::vector<Part> shares;
  try {
    FrameIn<Curve> carried = begin;
    carried.p = begin * (VectorOf<Curve>(own) - VectorOf<Curve>(met));
    const LegPosture closed = LegSolver(met_).At({}, carried, 0.0, 0.0);
    for (size_t i = 0; i < 6; ++i) q[i] = closed.q[i].over[0];
  } catch (const NotDefined&) {
    return;
  }
  if (!Extend(shared, 0.0, 1.0, &q, &shares)) return;
  const auto walked = [&](double from, double to) { return Own(leg_, foot(from, to)); };
  for (size_t i = 0; i + 1 < knots.size(); ++i) {
    if (!Extend(walked, knots[i], knots[i + 1], &q, &parts_)) return;
  }
}

OffsetLeg::Angles OffsetLeg::On(double from, double to, const FrameIn<Curve>& foot) const {
  const auto after = std::ranges::upper_bound(parts_, from, {}, &Part::from);
  if (after == parts_.begin()) throw NotDefined();
  const Part& part = *std::prev(after);
  if (to > part.to) throw NotDefined();
  if (from == part.from && to == part.to) return part.lift.q;
  const Interval t = Interval(0.5 * from + 0.5 * to) - Interval(0.5 * part.from + 0.5 * part.to);
  return Lifted(leg_, Own(leg_, foot), HalfOf(from, to), 0.0, ValuesAt(part.lift, t)).q;
}

}  // namespace halfstep::checker
