#include "experiments/checker/push.h"

#include "wpg/robot/gravity.h"

namespace halfstep::checker {
namespace {

VectorIn<Rate> Second(const VectorIn<Curve>& x) {
  return {x[0].Derivative<2, 1>(), x[1].Derivative<2, 1>(), x[2].Derivative<2, 1>()};
}

}  // namespace

// Of x = c + ρ with c the centre of mass and ρ = R ξ, ∫ ρ ρ̈ᵀ dm = R Σ R̈ᵀ, Σ = ½tr(I)·1 − I.
Push PushOf(const BodyMass& body, const FrameIn<Curve>& X_W, const Eigen::Vector3d& reference) {
  const VectorIn<Curve> center = X_W * VectorOf<Curve>(body.com);
  Push push;
  push.force = Second(center);
  push.force[2] = push.force[2] + Rate(kGravity);
  for (Rate& f : push.force) f = body.mass * f;
  push.moment = Cross(FirstOf(center) - VectorOf<Rate>(reference), push.force);
  const Eigen::Matrix3d& I = body.inertia;
  FrameIn<Rate> square;  // Σ
  const Interval half_trace = Interval(0.5) * (Interval(I(0, 0)) + I(1, 1) + I(2, 2));
  for (size_t i = 0; i < 3; ++i) {
    for (size_t k = 0; k < 3; ++k) {
      const Interval entry =
          -Interval(I(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)));
      square.R[i][k] = i == k ? half_trace + entry : entry;
    }
  }
  std::array<VectorIn<Rate>, 3> spread;  // rows of R Σ
  for (size_t i = 0; i < 3; ++i) spread[i] = square.TurnedBack(FirstOf(X_W.R[i]));
  for (size_t i = 0; i < 3; ++i) {
    const size_t k = (i + 1) % 3, l = (i + 2) % 3;
    push.moment[i] =
        push.moment[i] + Dot(spread[k], Second(X_W.R[l])) - Dot(spread[l], Second(X_W.R[k]));
  }
  return push;
}

}  // namespace halfstep::checker
