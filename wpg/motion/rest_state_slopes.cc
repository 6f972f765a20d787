#include "wpg/motion/rest_state_slopes.h"

namespace halfstep {
namespace {

// AtVia() is affine in the number, with coefficients 0 and ±1: exactly their difference.
WalkState Slope(HalfStep* half_step, double* number_of_it) {
  *number_of_it = 0.0;
  const WalkState none = half_step->AtVia();
  *number_of_it = 1.0;
  return half_step->AtVia() - none;
}

void MoveFoot(Side side, const SoleMove& by, WalkState* x) {
  x->segment<2>(FootIndex(side)) = by.head<2>();
  (*x)[FootIndex(side) + 3] = by.z();
}

}  // namespace

WalkState ViaSlope(HalfStep half_step, double HalfStep::*number) {
  return Slope(&half_step, &(half_step.*number));
}

WalkState ViaSlope(HalfStep half_step, double HalfStepShape::*number) {
  return Slope(&half_step, &(half_step.shape.*number));
}

RestStateSlopes SlopesOfStates(const HalfStep& half_step, const Foothold& X_WS,
                               const SoleMove& support, const SoleMove& swing) {
  RestStateSlopes slopes;
  // With both feet on the floor: CoM and ZMP between them, and the waist's yaw.
  const SoleMove middle = 0.5 * (support + swing);
  slopes.floor.segment<2>(kComX) = slopes.floor.segment<2>(kZmpX) = middle.head<2>();
  slopes.floor[kWaistYaw] = middle.z();
  MoveFoot(half_step.support, support, &slopes.floor);
  MoveFoot(half_step.swing(), swing, &slopes.floor);
  // At the via point everything goes with the support sole.
  const WalkState via_W = Turned(X_WS.Planar().rotation(), half_step.AtVia());
  for (const QuantityTraits& row : kQuantities) {
    const int q = row.quantity;
    if (row.component == Component::kYaw) slopes.via[q] = support.z();
    if (row.component != Component::kX) continue;
    slopes.via.segment<2>(q) =
        support.head<2>() + support.z() * Eigen::Vector2d(-via_W[q + 1], via_W[q]);
  }
  return slopes;
}

}  // namespace halfstep
