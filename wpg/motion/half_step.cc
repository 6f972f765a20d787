#include "wpg/motion/half_step.h"

#include <algorithm>

namespace halfstep {
namespace {

void SetFoot(Side side, const Foothold& X_SF, WalkState* x) {
  x->segment<4>(FootIndex(side)) = Eigen::Vector4d(X_SF.x, X_SF.y, X_SF.height, X_SF.yaw);
}

}  // namespace

WalkState HalfStep::OnFloor() const {
  WalkState x = WalkState::Zero();
  x.segment<2>(kComX) = x.segment<2>(kZmpX) = 0.5 * X_SF.Planar().position();
  x[kWaistYaw] = 0.5 * X_SF.yaw;
  x[kWaistZ] = std::min(0.0, X_SF.height) - crouch_on_floor();
  SetFoot(swing(), X_SF, &x);
  return x;
}

WalkState HalfStep::AtVia() const {
  WalkState x = WalkState::Zero();
  x.segment<2>(kComX) = x.segment<2>(kZmpX) = support_point();
  x[kWaistZ] = 0.0 - shape.crouch;
  SetFoot(swing(), {via(), via_height}, &x);
  return x;
}

HalfStep HalfStep::Mirrored() const {
  HalfStep mirrored = *this;
  mirrored.support = Opposite(support);
  mirrored.X_SF = X_SF.Mirrored();
  return mirrored;
}

}  // namespace halfstep
