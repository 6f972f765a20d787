#include "experiments/checker/offset_leg.h"

#include <Eigen/LU>
#include <algorithm>

namespace halfstep::checker {
namespace {

using Box = std::array<Interval, 6>;

constexpr double kShortest = 1.0 / 256;  // step, as a share of the offsets

// A function of one instant that takes what f does at m, or anywhere: what is found of it holds
// there.
Curve AtOneInstant(const Curve& f, bool anywhere) {
  Curve at;
  for (size_t k = 0; k < 3; ++k) at.at[k] = anywhere ? f.over[k] : f.at[k];
  at.over[3] = f.over[3];
  return at.Enclose();
}

template <typename To, typename Of>
FrameIn<To> EachOf(const FrameIn<Curve>& X, const Of& of) {
  FrameIn<To> each;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t k = 0; k < 3; ++k) each.R[i][k] = of(X.R[i][k]);
    each.p[i] = of(X.p[i]);
  }
  return each;
}

// A posture of a leg that is cut at its knee, seen from the waist: what is above hangs on the
// waist, what is below stands on the sole, and both say where the thigh is.
template <typename T>
struct CutLeg {
  std::array<VectorIn<T>, 6> axes, points;
  VectorIn<T> knee;    // as the part above has it; points[3]: as the part below does
  FrameIn<T> between;  // the thigh's rotation by the one times the inverse of that by the other

  template <typename Turns>  // sine and cosine of each joint
  CutLeg(const Leg& leg, const std::array<Vector, 6>& points_B, FrameIn<T> below,
         const Turns& turns) {
    FrameIn<T> above;
    const auto add = [&](size_t i, double sign, FrameIn<T>* thigh) {
      const auto& [s, c] = turns[i];
      const VectorIn<T> point = {points_B[i][0], points_B[i][1], points_B[i][2]};
      axes[i] = thigh->Turned(VectorOf<T>(leg.joints[i].axis_B));
      points[i] = *thigh * point;
      FrameIn<T> turn = TurnAbout<T>(leg.joints[i].axis_B, sign * T(s), T(c));
      turn.p = point - turn.Turned(point);
      *thigh = *thigh * turn;
    };
    for (size_t i = 0; i < 3; ++i) add(i, 1.0, &above);
    for (size_t i = 6; i-- > 3;) add(i, -1.0, &below);
    knee = above * VectorIn<T>{points_B[3][0], points_B[3][1], points_B[3][2]};
    for (size_t i = 0; i < 3; ++i) {
      for (size_t k = 0; k < 3; ++k) between.R[i][k] = Dot(above.R[i], below.R[k]);
    }
  }
  T Trace() const { return between.R[0][0] + between.R[1][1] + between.R[2][2]; }
  // Of the turn between both thighs 2 sin θ times its axis, and the way between both knees: where
  // the trace is above −1, all is 0 only where both are one.
  std::array<T, 6> Mismatch() const {
    const auto& R = between.R;
    const VectorIn<T> way = knee - points[3];
    return {R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1], way[0], way[1], way[2]};
  }
};

// a + M x.
Box Affine(const Box& a, const std::array<Box, 6>& M, const Box& x) {
  Box sum = a;
  for (size_t i = 0; i < 6; ++i) {
    for (size_t k = 0; k < 6; ++k) sum[i] = sum[i] + M[i][k] * x[k];
  }
  return sum;
}
Box Common(const Box& a, const Box& b) {
  Box common;
  for (size_t i = 0; i < 6; ++i) {
    common[i] = {std::max(a[i].lo, b[i].lo), std::min(a[i].hi, b[i].hi)};
  }
  return common;
}
// The image of a box around what is given, where it lies in its inside: a continuous map has a
// fixed point there.
template <typename Map>
Box Contracted(Box box, const Map& map) {
  for (int round = 0; round < 12; ++round) {
    for (Interval& x : box) {
      const double more = 0.1 * (x.hi - x.lo) + 1e-12 * (1.0 + x.Magnitude());
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

}  // namespace

OffsetLeg::OffsetLeg(const Leg& leg, const Leg& met) : leg_(leg), met_leg_(met), met_(met) {}

OffsetLeg::Parts OffsetLeg::PartsAt(const Interval& share, const FrameIn<Curve>& foot) const {
  const Interval rest = Interval(1.0) - share;
  const auto at = [&](const Eigen::Vector3d& met, const Eigen::Vector3d& own) {
    if (share == Interval(1.0)) return VectorOf(own);
    Vector at;
    for (size_t i = 0; i < 3; ++i) at[i] = rest * VectorOf(met)[i] + share * VectorOf(own)[i];
    return at;
  };
  Parts parts{.points = {}, .foot = foot};
  for (size_t i = 0; i < 6; ++i) {
    parts.points[i] = at(met_leg_.joints[i].point_B, leg_.joints[i].point_B);
  }
  // The frame that this sole carries, in that which the leg's own does.
  const Vector shift = VectorOf(leg_.X_BSole.translation()) -
                       at(met_leg_.X_BSole.translation(), leg_.X_BSole.translation());
  parts.foot.p = foot * VectorIn<Curve>{shift[0], shift[1], shift[2]};
  return parts;
}

// A turn about an axis a before the rotation R changes 2 sin θ by (tr R − R)a, one after it by
// (tr R − Rᵀ)a.
OffsetLeg::Slopes OffsetLeg::SlopesWithin(const Parts& parts, const Box& q) const {
  std::array<SineCosineInterval, 6> turns;
  for (size_t i = 0; i < 6; ++i) turns[i] = SinCosOf(q[i]);
  const auto over = [](const Curve& x) { return x.over[0]; };
  const CutLeg<Interval> at(leg_, parts.points, EachOf<Interval>(parts.foot, over), turns);
  const Interval trace = at.Trace();
  if (!(trace.lo > 0.0)) throw NotDefined();
  std::array<Box, 6> J;  // columns
  Slopes slopes;
  for (size_t i = 0; i < 6; ++i) {
    const Vector& a = at.axes[i];
    const Vector turned = i < 3 ? at.between.Turned(a) : at.between.TurnedBack(a);
    const Vector moved = Cross(a, (i < 3 ? at.knee : at.points[3]) - at.points[i]);
    for (size_t k = 0; k < 3; ++k) {
      J[i][k] = trace * a[k] - turned[k];
      J[i][k + 3] = moved[k];
    }
    for (size_t k = 0; k < 6; ++k) slopes.inverse.data()[6 * i + k] = J[i][k].Middle();
  }
  slopes.inverse = slopes.inverse.inverse().eval();
  const auto& C = slopes.inverse;
  if (!C.allFinite() || C.cwiseAbs().maxCoeff() > 1e9) throw NotDefined();
  for (size_t i = 0; i < 6; ++i) {
    for (size_t k = 0; k < 6; ++k) {
      Interval& rest = slopes.rest[i][k] = i == k ? 1.0 : 0.0;
      for (size_t j = 0; j < 6; ++j) rest = rest - Interval(C.data()[6 * j + i]) * J[k][j];
    }
  }
  return slopes;
}

// K(Q) = q − C f(q) + (1 − C J(Q))(Q − q) holds every zero of f in Q, and there is just one where
// it lies inside of Q.
OffsetLeg::Box OffsetLeg::Krawczyk(const Parts& parts, const Box& q) const {
  const Slopes slopes = SlopesWithin(parts, q);
  std::array<SineCosineInterval, 6> turns;
  Box middle, off;
  for (size_t i = 0; i < 6; ++i) {
    middle[i] = q[i].Middle();
    off[i] = q[i] - middle[i];
    turns[i] = SinCosOf(middle[i]);
  }
  const auto rate = [](const Curve& x) { return x.Derivative<0, 1>(); };
  const std::array<Taylor<1>, 6> f =
      CutLeg<Taylor<1>>(leg_, parts.points, EachOf<Taylor<1>>(parts.foot, rate), turns).Mismatch();
  for (size_t i = 0; i < 6; ++i) {
    Taylor<1> step;
    for (size_t k = 0; k < 6; ++k) step = step + slopes.inverse.data()[6 * k + i] * f[k];
    middle[i] = middle[i] - step.over[0];
  }
  return Affine(middle, slopes.rest, off);
}

std::optional<OffsetLeg::Box> OffsetLeg::Continued(const FrameIn<Curve>& foot, double from,
                                                   double to, const Box& q) const {
  try {
    const Parts between = PartsAt({from, to}, foot);
    const Box all = Contracted(q, [&](const Box& box) { return Krawczyk(between, box); });
    return Common(all, Krawczyk(PartsAt(to, foot), all));
  } catch (const NotDefined&) {
    return std::nullopt;
  }
}

// Of f(q(t), t) = 0 the Nth derivative is J q⁽ᴺ⁾ and what it would be if q⁽ᴺ⁾ were 0.
template <int N>
void OffsetLeg::AddDerivative(const Parts& parts, const Slopes& slopes,
                              std::array<Curve, 6>* q) const {
  std::array<std::array<Taylor<N>, 2>, 6> turns;
  for (size_t i = 0; i < 6; ++i) {
    Taylor<N> angle = (*q)[i].Derivative<0, N>();
    angle.over[N] = 0.0;
    turns[i] = SinCosOf(angle.Enclose());
  }
  const auto some = [](const Curve& x) { return x.Derivative<0, N>(); };
  const std::array<Taylor<N>, 6> f =
      CutLeg<Taylor<N>>(leg_, parts.points, EachOf<Taylor<N>>(parts.foot, some), turns).Mismatch();
  Box right{};
  for (size_t i = 0; i < 6; ++i) {
    for (size_t k = 0; k < 6; ++k) {
      right[i] = right[i] - Interval(slopes.inverse.data()[6 * k + i]) * f[k].over[N];
    }
  }
  const Box found = Contracted(right, [&](const Box& y) { return Affine(right, slopes.rest, y); });
  for (size_t i = 0; i < 6; ++i) {
    if constexpr (N < 3) {
      (*q)[i].at[N] = found[i];
    } else {
      (*q)[i].over[N] = found[i];
    }
  }
}

std::array<Curve, 6> OffsetLeg::At(const FrameIn<Curve>& X_WB,
                                   const FrameIn<Curve>& carried) const {
  const FrameIn<Curve> foot = X_WB.Inverse() * carried;
  const LegPosture closed = met_.At({}, PartsAt(0.0, foot).foot);
  Box box;
  for (size_t i = 0; i < 6; ++i) box[i] = closed.q[i].over[0];
  for (double share = 0.0, step = 1.0; share < 1.0;) {
    const double to = std::min(1.0, share + step);
    if (const auto next = Continued(foot, share, to, box)) {
      box = *next;
      share = to;
    } else if ((step *= 0.5) < kShortest) {
      throw NotDefined();
    }
  }
  const Parts moving = PartsAt(1.0, foot);
  std::array<Curve, 6> q;
  for (const bool anywhere : {true, false}) {
    const Parts instant = PartsAt(
        1.0, EachOf<Curve>(foot, [&](const Curve& x) { return AtOneInstant(x, anywhere); }));
    Box here = box;
    for (int k = 0; k < 3; ++k) here = Common(here, Krawczyk(anywhere ? moving : instant, here));
    const Slopes slopes = SlopesWithin(instant, here);
    std::array<Curve, 6> jets;
    for (size_t i = 0; i < 6; ++i) jets[i].at[0] = here[i];
    AddDerivative<1>(instant, slopes, &jets);
    AddDerivative<2>(instant, slopes, &jets);
    if (anywhere) AddDerivative<3>(instant, slopes, &jets);
    for (size_t i = 0; i < 6; ++i) {
      if (!anywhere) q[i].at = jets[i].at;
      if (anywhere) q[i].over[3] = jets[i].over[3];
    }
  }
  for (Curve& angle : q) {
    for (const Curve& x : foot.p) angle.h = std::max(angle.h, x.h);
    for (const Curve& x : foot.R[0]) angle.h = std::max(angle.h, x.h);
    angle.Enclose();
  }
  return q;
}

}  // namespace halfstep::checker
