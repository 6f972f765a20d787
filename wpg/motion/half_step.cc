#include "wpg/motion/half_step.h"

#include <algorithm>
#include <utility>

#include "wpg/check.h"

namespace halfstep {
namespace {

void SetFoot(Side side, const Foothold& X_SF, WalkState* x) {
  x->segment<4>(FootIndex(side)) = Eigen::Vector4d(X_SF.x, X_SF.y, X_SF.height, X_SF.yaw);
}

// Horizontal motion of the foot: inside its flight by `foot_delay` at the floor's end.
RampedStep FootWindow(HalfStepKind kind, const HalfStepShape& shape) {
  return kind == HalfStepKind::kUp
             ? RampedStep{shape.t2() + shape.foot_delay, 1.0, shape.foot_ramp}
             : RampedStep{0.0, shape.t1() - shape.foot_delay, shape.foot_ramp};
}

// Its motion up or down: the part of the flight next to the floor.
Smoothstep LiftWindow(HalfStepKind kind, const HalfStepShape& shape) {
  return kind == HalfStepKind::kUp
             ? Smoothstep{shape.t2(), shape.t2() + shape.lift_share * (1.0 - shape.t2())}
             : Smoothstep{shape.t1() - shape.lift_share * shape.t1(), shape.t1()};
}

// The unit times of [a, b] without what the rounding of absolute times may have added at its ends:
// there knots lie, mostly of this half-step, and beyond one a derivative may be much larger.
std::pair<double, double> WithoutRounding(double a, double b) {
  constexpr double kRounding = 2e-13;
  return b - a > 2.0 * kRounding ? std::pair{a + kRounding, b - kRounding} : std::pair{a, b};
}

// The derivative of a profile along a parameter, from f, its derivative along a number that changes
// by `rate` per unit of that parameter; time derivatives per second of the duration [s].
ProfileJet InTime(const UnitJet& f, double rate, double duration) {
  const double r = 1.0 / duration;
  return {.value = rate * f.value, .first = rate * r * f.s, .second = rate * r * r * f.ss};
}

}  // namespace

WalkState HalfStep::OnFloor() const {
  WalkState x = WalkState::Zero();
  x.segment<2>(kComX) = x.segment<2>(kZmpX) = 0.5 * X_SF.Planar().position();
  x[kWaistYaw] = 0.5 * X_SF.yaw;
  SetFoot(swing(), X_SF, &x);
  return x;
}

WalkState HalfStep::AtVia() const {
  WalkState x = WalkState::Zero();
  x.segment<2>(kComX) = x.segment<2>(kZmpX) = support_point();
  SetFoot(swing(), {via(), via_height}, &x);
  return x;
}

HalfStep HalfStep::Mirrored() const {
  HalfStep mirrored = *this;
  mirrored.support = Opposite(support);
  mirrored.X_SF = X_SF.Mirrored();
  return mirrored;
}

const ProfileJet& HalfStepJet::of(int quantity) const {
  switch (quantity) {
    case kComX:
    case kComY:
      return com;
    case kZmpX:
    case kZmpY:
      return zmp;
    case kWaistYaw:
      return yaw;
    case kLeftZ:
    case kRightZ:
      return height;
    default:
      return foot;
  }
}

HalfStepProfiles::HalfStepProfiles(HalfStepKind kind, const HalfStepShape& shape, double duration,
                                   const Lipm& lipm)
    : shape_(shape),
      duration_(duration),
      omega_(lipm.omega()),
      foot_(FootWindow(kind, shape)),
      height_(LiftWindow(kind, shape)),
      shift_(omega_ * duration, shape.shift, shape.bump_ramp) {
  // Of the flight, t1 long, a tenth at least must be left to move in.
  HALFSTEP_CHECK(
      shape.foot_delay >= 0.0 && shape.foot_delay <= 0.3 && shape.foot_delay <= 0.9 * shape.t1(),
      "foot_delay = " << shape.foot_delay << ", t1 = " << shape.t1());
  HALFSTEP_CHECK(shape.foot_ramp >= 0.1 && shape.foot_ramp <= 0.5,
                 "foot_ramp = " << shape.foot_ramp);
  HALFSTEP_CHECK(shape.lift_share >= 0.2 && shape.lift_share <= 1.0,
                 "lift_share = " << shape.lift_share);
}

std::vector<double> HalfStepProfiles::Knots() const {
  std::vector<double> knots = {t1(),
                               t2(),
                               horizontal_begin(),
                               horizontal_end(),
                               foot_.steady_begin() * duration_,
                               foot_.steady_end() * duration_,
                               lift_begin(),
                               lift_end(),
                               0.5 * duration_,
                               duration_};
  if (shape_.bump_ramp < 1.0) {
    const double ramp = std::min(shape_.bump_ramp, 0.5);
    for (const double sigma : {ramp * shape_.t1(), (1.0 - ramp) * shape_.t1()}) {
      knots.push_back(sigma * duration_);
      knots.push_back((1.0 - sigma) * duration_);
    }
  }
  return knots;
}

HalfStepJet HalfStepProfiles::At(double tau) const {
  const double sigma = tau / duration_;
  const auto to_time = [&](const UnitJet& f) { return ToTime(f, sigma, duration_, omega_); };
  return {.com = to_time(shift_.Com(sigma)),
          .zmp = to_time(shift_.Zmp(sigma)),
          .yaw = to_time(Smoothstep{}.At(sigma)),
          .foot = to_time(foot_.At(sigma)),
          .height = to_time(height_.At(sigma))};
}

HalfStepJet HalfStepProfiles::ByShape(double HalfStepShape::*number, double tau) const {
  const double sigma = tau / duration_;
  if (number == &HalfStepShape::shift) return ByShift(sigma);
  const bool up = foot_.end == 1.0;
  const auto in_time = [this](const UnitJet& f, double rate) { return InTime(f, rate, duration_); };
  HalfStepJet jet;
  if (number == &HalfStepShape::bump_ramp) {
    jet.com = in_time(shift_.ComByBumpRamp(sigma), 1.0);
    jet.zmp = in_time(shift_.ZmpByBumpRamp(sigma), 1.0);
  } else if (number == &HalfStepShape::foot_ramp) {
    jet.foot = in_time(foot_.ByRamp(sigma), 1.0);
  } else if (number == &HalfStepShape::foot_delay) {
    jet.foot = up ? in_time(foot_.ByBegin(sigma), 1.0) : in_time(foot_.ByEnd(sigma), -1.0);
  } else {
    HALFSTEP_CHECK(number == &HalfStepShape::lift_share, "this number of the shape is not offered");
    jet.height = up ? in_time(height_.ByEnd(sigma), 1.0 - shape_.t2())
                    : in_time(height_.ByBegin(sigma), -shape_.t1());
  }
  return jet;
}

// t1 and t2, between which the ZMP shifts, move by ∓½, and with them the flight.
HalfStepJet HalfStepProfiles::ByShift(double sigma) const {
  const bool up = foot_.end == 1.0;
  const double far_end = 0.5 - 0.5 * shape_.lift_share;
  const ProfileJet low = InTime(height_.ByBegin(sigma), up ? 0.5 : -far_end, duration_);
  const ProfileJet high = InTime(height_.ByEnd(sigma), up ? far_end : -0.5, duration_);
  HalfStepJet jet;
  jet.com = InTime(shift_.ComByShift(sigma), 1.0, duration_);
  jet.zmp = InTime(shift_.ZmpByShift(sigma), 1.0, duration_);
  jet.foot = up ? InTime(foot_.ByBegin(sigma), 0.5, duration_)
                : InTime(foot_.ByEnd(sigma), -0.5, duration_);
  jet.height = {.value = low.value + high.value,
                .first = low.first + high.first,
                .second = low.second + high.second};
  return jet;
}

HalfStepJet HalfStepProfiles::SecondBounds(double from, double to) const {
  const double a = from / duration_, b = to / duration_;
  const double r = 1.0 / (duration_ * duration_);
  HalfStepJet bounds;
  if (b <= 0.0 || a >= 1.0) return bounds;
  bounds.com.second = r * shift_.ComSecondBound();
  bounds.zmp.second = r * shift_.ZmpSecondBound(a, b);
  bounds.yaw.second = r * Smoothstep{}.SecondBound(a, b);
  bounds.foot.second = r * foot_.SecondBound(a, b);
  bounds.height.second = r * height_.SecondBound(a, b);
  return bounds;
}

HalfStepThirds HalfStepProfiles::ThirdRanges(double from, double to) const {
  const auto [a, b] = WithoutRounding(from / duration_, to / duration_);
  const double r = 1.0 / (duration_ * duration_ * duration_);
  const auto to_time = [r](const Range& x) { return Range{r * x.center, r * x.radius}; };
  return {.com = to_time(shift_.ComThirdRange(a, b)),
          .yaw = to_time(Smoothstep{}.ThirdRange(a, b)),
          .foot = to_time(foot_.ThirdRange(a, b)),
          .height = to_time(height_.ThirdRange(a, b))};
}

WalkJet Evaluate(const HalfStep& half_step, const HalfStepProfiles& profiles, double tau) {
  const WalkState start = half_step.Start();
  const WalkState delta = half_step.End() - start;
  const HalfStepJet jet = profiles.At(tau);
  WalkJet x;
  for (int q = 0; q < kNumQuantities; ++q) {
    x.value[q] = start[q] + jet.of(q).value * delta[q];
    x.first[q] = jet.of(q).first * delta[q];
    x.second[q] = jet.of(q).second * delta[q];
  }
  return x;
}

}  // namespace halfstep
