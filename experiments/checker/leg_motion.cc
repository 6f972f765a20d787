#include "experiments/checker/leg_motion.h"

#include "experiments/checker/offset_leg.h"
#include "wpg/geometry/rotation.h"

namespace halfstep::checker {
namespace {

using Eigen::Vector3d;
using Curves3 = VectorIn<Curve>;

// The turn about a unit axis that brings p to t, which are equally far along it. `across`: the
// square of what is across.
Turn TurnFromTo(const Vector3d& axis, const Curves3& p, const Curves3& t, const Curve& across) {
  const Curve scale = Inverse(across);
  return {Dot(axis, Cross(p, t)) * scale, (Dot(p, t) - Dot(axis, p) * Dot(axis, t)) * scale};
}

// c = R(v) p where R(u) R(v) p = t, |p|² = square, on the side of u×v that `sign` says.
Curves3 Between(const Vector3d& u, const Vector3d& v, const Curves3& p, const Curves3& t,
                const Curve& square, double sign) {
  const Vector uv = VectorOf(u), vv = VectorOf(v), n = Cross(uv, vv);
  const Interval d = Dot(uv, vv), nn = Interval(1.0) - Square(d), scale = Interval(1.0) / nn;
  const Curve ut = Dot(u, t), vp = Dot(v, p);
  const Curve alpha = scale * (ut - d * vp), beta = scale * (vp - d * ut);
  const Curve rest = square - alpha * alpha - beta * beta - Interval(2.0) * (d * (alpha * beta));
  const Curve gamma = sign * Sqrt(scale * rest);
  Curves3 c;
  for (size_t i = 0; i < 3; ++i) c[i] = uv[i] * alpha + vv[i] * beta + n[i] * gamma;
  return c;
}

Vector Across(const Vector& x, const Vector& axis) {
  const Interval along = Dot(axis, x);
  return {x[0] - along * axis[0], x[1] - along * axis[1], x[2] - along * axis[2]};
}

Vector3d Rotated(const LegJoint& joint, double q, const Vector3d& v) {
  return AxisRotation(q, joint.axis_B) * v;
}

Curves3 Constant(const Vector3d& v) { return VectorOf<Curve>(v); }

// The turn about an axis through a point.
FrameIn<Curve> TurnThrough(const LegJoint& joint, const Vector3d& point, const Turn& turn) {
  FrameIn<Curve> frame = TurnAbout(joint.axis_B, turn.sin, turn.cos);
  frame.p = Constant(point) - frame.Turned(Constant(point));
  return frame;
}

// Links 0 to 2 hang on the waist, 3 to 5 on the sole.
LegPosture Placed(const Leg& leg, const FrameIn<Curve>& X_WB, const FrameIn<Curve>& carried,
                  const std::array<Turn, 6>& turns) {
  LegPosture posture;
  FrameIn<Curve> moved = X_WB;
  for (size_t i = 0; i < 3; ++i) {
    moved = moved * TurnThrough(leg.joints[i], leg.AxisPoint(i), turns[i]);
    posture.X_WLink[i] = moved * FrameOf<Curve>(leg.joints[i].X_BLink);
  }
  moved = carried;
  for (size_t i = 6; i-- > 3;) {
    posture.X_WLink[i] = moved * FrameOf<Curve>(leg.joints[i].X_BLink);
    if (i > 3) moved = moved * TurnThrough(leg.joints[i], leg.AxisPoint(i), turns[i].Back());
  }
  return posture;
}

}  // namespace

LegSolver::LegSolver(const Leg& leg) : leg_(leg), X_SoleB_(FrameOf<Curve>(leg.X_BSole).Inverse()) {
  const auto& j = leg.joints;
  if (!leg.closed_form()) offset_ = std::make_shared<OffsetLeg>(leg, leg.met.front());
  const Vector axis = VectorOf(j[3].axis_B), point = VectorOf(j[3].point_B);
  hip_ = VectorOf(leg.hip_B) - point;
  ankle_ = VectorOf(leg.ankle_B) - point;
  const Vector h = Across(hip_, axis), a = Across(ankle_, axis);
  along_ = Dot(axis, ankle_ - hip_);
  levers_ = Sqrt(Dot(h, h) * Dot(a, a));
  squares_ = Square(along_) + Dot(h, h) + Dot(a, a);
  cos_zero_ = Dot(h, a) / levers_;
  sin_zero_ = Dot(axis, Cross(h, a)) / levers_;
  // The branch: signs of three functions at the standing posture.
  const Vector6d& q = leg.standing_q;
  const auto sign = [](double x) { return x >= 0.0 ? 1.0 : -1.0; };
  const auto [s, c] = SinCos(q[3]);
  knee_ = sign(s * cos_zero_.Middle() + c * sin_zero_.Middle());
  const Vector3d seen = Rotated(j[3], -q[3], leg.hip_B - j[3].point_B) + j[3].point_B - leg.ankle_B;
  ankle_side_ = sign(j[5].axis_B.cross(j[4].axis_B).dot(Rotated(j[4], -q[4], seen)));
  hip_side_ = sign(j[0].axis_B.cross(j[1].axis_B).dot(Rotated(j[1], q[1], j[2].axis_B)));
}

Curve LegSolver::Reach(const FrameIn<Curve>& X_WB, const FrameIn<Curve>& carried) const {
  const Curves3 between = carried * Constant(leg_.ankle_B) - X_WB * Constant(leg_.hip_B);
  return Curve(Sqrt(squares_ + Interval(2.0) * levers_)) - Sqrt(Dot(between, between));
}

Curve LegSolver::Reach(const Curve& knee) const {
  const auto [s, c] = SinCosOf(knee);
  const Curve cos_psi = cos_zero_ * c - sin_zero_ * s;
  const Interval twice = Interval(2.0) * levers_;
  return Curve(Sqrt(squares_ + twice)) - Sqrt(Curve(squares_) - twice * cos_psi);
}

void LegSolver::Follow(const std::vector<double>& knots,
                       const std::function<FrameIn<Curve>(double from, double to)>& foot) {
  if (offset_ != nullptr) offset_->Follow(knots, foot);
}

LegPosture LegSolver::At(const FrameIn<Curve>& X_WB, const FrameIn<Curve>& carried, double from,
                         double to) const {
  std::array<Turn, 6> turns;
  if (offset_ != nullptr) {
    const std::array<Curve, 6> q = offset_->On(from, to, X_WB.Inverse() * carried);
    for (size_t i = 0; i < 6; ++i) {
      const auto [s, c] = SinCosOf(q[i]);
      turns[i] = {s, c};
    }
    LegPosture posture = Placed(leg_, X_WB, carried, turns);
    posture.q = q;
    return posture;
  }
  const auto& j = leg_.joints;
  const Curves3 hip_W = X_WB * Constant(leg_.hip_B), ankle_W = carried * Constant(leg_.ankle_B);
  const Curves3 between = ankle_W - hip_W;
  const Curve square = Dot(between, between);  // D²

  const Curve cos_psi = (Interval(0.5) / levers_) * (Curve(squares_) - square);
  const Curve sin_psi = knee_ * Sqrt((Curve(1.0) - cos_psi) * (Curve(1.0) + cos_psi));
  turns[3] = {cos_zero_ * sin_psi - sin_zero_ * cos_psi, cos_zero_ * cos_psi + sin_zero_ * sin_psi};

  // About the ankle: e_3⁻¹h, and the hip seen from the foot.
  const Curves3 p = turns[3].Back().About(j[3].axis_B, VectorIn<Curve>{hip_[0], hip_[1], hip_[2]}) -
                    VectorIn<Curve>{ankle_[0], ankle_[1], ankle_[2]};
  const Curves3 t = carried.TurnedBack(-between);
  const Curves3 c = Between(j[5].axis_B, j[4].axis_B, p, t, square, ankle_side_);
  const auto across = [&](const Curve& of, const Curve& along) { return of - along * along; };
  turns[4] = TurnFromTo(j[4].axis_B, p, c, across(square, Dot(j[4].axis_B, p))).Back();
  turns[5] = TurnFromTo(j[5].axis_B, c, t, across(square, Dot(j[5].axis_B, t))).Back();

  // R = R_0 R_1 R_2 is what the foot's turn, seen from the waist, is more than that of the rest.
  Curves3 last = Constant(j[2].axis_B);
  for (size_t i = 3; i < 6; ++i) last = turns[i].Back().About(j[i].axis_B, last);
  last = X_WB.TurnedBack(carried.Turned(last));
  const Curves3 middle =
      Between(j[0].axis_B, j[1].axis_B, Constant(j[2].axis_B), last, Curve(1.0), hip_side_);
  turns[1] = TurnFromTo(j[1].axis_B, Constant(j[2].axis_B), middle,
                        across(1.0, Curve(Dot(j[1].axis_B, VectorOf(j[2].axis_B)))));
  turns[0] = TurnFromTo(j[0].axis_B, middle, last, across(1.0, Dot(j[0].axis_B, last)));
  Curves3 second = turns[0].About(j[0].axis_B, Constant(j[1].axis_B));
  second = carried.TurnedBack(X_WB.Turned(second));
  for (size_t i = 6; i-- > 3;) second = turns[i].About(j[i].axis_B, second);
  turns[2] = TurnFromTo(j[2].axis_B, second, Constant(j[1].axis_B),
                        across(1.0, Curve(Dot(j[2].axis_B, VectorOf(j[1].axis_B)))));

  LegPosture posture = Placed(leg_, X_WB, carried, turns);
  for (size_t i = 0; i < 6; ++i) posture.q[i] = turns[i].Angle();
  return posture;
}

}  // namespace halfstep::checker
