#pragma once

#include <array>

#include "experiments/checker/taylor.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::checker {

/// What a leg is given: a point of each axis at q = 0, and the foot (OffsetLeg::Foot).
template <typename T>
struct Given {
  std::array<VectorIn<T>, 6> points;  ///< [m]
  FrameIn<T> foot;                    ///< seen from the waist

  /// The same with of(x) for each number x.
  template <typename To, typename Of>
  Given<To> Each(const Of& of) const {
    Given<To> each;
    for (size_t i = 0; i < 3; ++i) {
      for (size_t k = 0; k < 6; ++k) each.points[k][i] = of(points[k][i]);
      for (size_t k = 0; k < 3; ++k) each.foot.R[i][k] = of(foot.R[i][k]);
      each.foot.p[i] = of(foot.p[i]);
    }
    return each;
  }
};

/// A function of one instant that takes what f does at m, or anywhere: what is found of it holds
/// there.
inline Curve AtOneInstant(const Curve& f, bool anywhere) {
  Curve at;
  for (size_t k = 0; k < 3; ++k) at.at[k] = anywhere ? f.over[k] : f.at[k];
  at.over[3] = f.over[3];
  return at.Enclose();
}
/// The same of all.
inline Given<Curve> AtOneInstant(const Given<Curve>& given, bool anywhere) {
  return given.Each<Curve>([&](const Curve& f) { return AtOneInstant(f, anywhere); });
}

/// A posture of a leg that is cut at its knee, seen from the waist: what is above hangs on the
/// waist, what is below stands on the sole, and both say where the thigh is.
template <int N>
struct CutLeg {
  using T = Taylor<N>;              ///< numbers that are functions of time
  std::array<VectorIn<T>, 6> axes;  ///< of the joints, of length 1
  std::array<VectorIn<T>, 6>
      points;          ///< one of each axis [m]; of the knee as the part below has it
  VectorIn<T> knee;    ///< as the part above has it [m]
  FrameIn<T> between;  ///< the thigh's rotation by the part above times the inverse of the other's

  /// At joint angles q [rad].
  CutLeg(const Leg& leg, const Given<Curve>& of, const std::array<T, 6>& q) {
    const Given<T> given = of.Each<T>([](const Curve& f) { return f.template Derivative<0, N>(); });
    FrameIn<T> above, below = given.foot;
    const auto add = [&](size_t i, double sign, FrameIn<T>* thigh) {
      const auto [s, c] = SinCosOf(q[i]);
      axes[i] = thigh->Turned(VectorOf<T>(leg.joints[i].axis_B));
      points[i] = *thigh * given.points[i];
      FrameIn<T> turn = TurnAbout<T>(leg.joints[i].axis_B, sign * s, c);
      turn.p = given.points[i] - turn.Turned(given.points[i]);
      *thigh = *thigh * turn;
    };
    for (size_t i = 0; i < 3; ++i) add(i, 1.0, &above);
    for (size_t i = 6; i-- > 3;) add(i, -1.0, &below);
    knee = above * given.points[3];
    for (size_t i = 0; i < 3; ++i) {
      for (size_t k = 0; k < 3; ++k) between.R[i][k] = Dot(above.R[i], below.R[k]);
    }
  }
  /// Of `between`; where it is above −1, f = 0 only where both thighs are one.
  T Trace() const { return between.R[0][0] + between.R[1][1] + between.R[2][2]; }
  /// f (6): of the turn between both thighs 2 sin θ times its axis, and the way between both knees
  /// [m].
  std::array<T, 6> Mismatch() const {
    const auto& R = between.R;
    const VectorIn<T> way = knee - points[3];
    return {R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1], way[0], way[1], way[2]};
  }
  /// Of f by joint i (6). A turn about an axis a before the rotation R changes 2 sin θ times its
  /// axis by (tr R − R)a, one after it by (tr R − Rᵀ)a.
  std::array<T, 6> Slope(size_t i) const {
    const VectorIn<T>& a = axes[i];
    const VectorIn<T> turned = i < 3 ? between.Turned(a) : between.TurnedBack(a);
    const VectorIn<T> moved = Cross(a, (i < 3 ? knee : points[3]) - points[i]);
    const T trace = Trace();
    return {trace * a[0] - turned[0],
            trace * a[1] - turned[1],
            trace * a[2] - turned[2],
            moved[0],
            moved[1],
            moved[2]};
  }
};

}  // namespace halfstep::checker
