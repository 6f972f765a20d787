#include "experiments/verify/half_step_motion.h"

#include <algorithm>

#include "wpg/check.h"

namespace halfstep::verify {
namespace {

// CoM and ZMP at p_S, the waist turned by `yaw` and `z` above where it stands on the support sole's
// plane, the swing foot at X_SF; all of it in W.
WalkNumbers AtRest(const PlacedHalfStep& placed, const Eigen::Vector2d& p_S, double yaw, double z,
                   const Foothold& X_SF) {
  const auto& [half_step, X_WS, rest] = placed;
  const Foothold swing = X_WS * X_SF;
  WalkNumbers x;
  x.segment<2>(kComX) = x.segment<2>(kZmpX) = X_WS.Planar() * p_S;
  x[kWaistYaw] = X_WS.yaw + yaw;
  x[kWaistZ] = X_WS.height + z;
  x.segment<4>(SoleX(Index(half_step.support))) << X_WS.x, X_WS.y, X_WS.height, X_WS.yaw;
  x.segment<4>(SoleX(Index(half_step.swing()))) << swing.x, swing.y, swing.height, swing.yaw;
  return x;
}

}  // namespace

HalfStepMotion::HalfStepMotion(const PlacedHalfStep& placed, double omega)
    : half_step_(placed.half_step),
      shift_(omega * duration(), form().zmp_shift, form().zmp_bump_ramp),
      footstep_height_((placed.X_WS * placed.half_step.X_SF).height) {
  HALFSTEP_CHECK(form().foot_delay >= 0 && form().foot_delay <= 0.3 &&
                     form().foot_delay * duration() <= 0.9 * t1(),
                 "foot delay = " << form().foot_delay << " of T, t1 = " << t1() << " s");
  HALFSTEP_CHECK(form().foot_ramp >= 0.1 && form().foot_ramp <= 0.5,
                 "foot ramp = " << form().foot_ramp);
  HALFSTEP_CHECK(form().lift_share >= 0.2 && form().lift_share <= 1,
                 "lift share = " << form().lift_share);
  HALFSTEP_CHECK(form().rise_begin >= 0 && form().rise_begin <= 0.75 && form().rise_end >= 0.85 &&
                     form().rise_end <= 1,
                 "rise on " << form().rise_begin << " … " << form().rise_end);
  const double aside = Sign(half_step_.swing());
  const Foothold& X_SF = half_step_.X_SF;
  const double crouch = half_step_.crouch,
               standing_crouch = half_step_.standing_crouch.value_or(crouch);
  const WalkNumbers standing = AtRest(placed, X_SF.Planar().position() / 2, X_SF.yaw / 2,
                                      std::min(0.0, X_SF.height) - standing_crouch, X_SF);
  const WalkNumbers at_via =
      AtRest(placed, {0, aside * half_step_.support_point}, 0, -crouch,
             {{form().via_along, aside * form().via_lateral, 0}, half_step_.via_height});
  start_ = half_step_.up ? standing : at_via;
  delta_ = (half_step_.up ? at_via : standing) - start_;
}

// Its speed rises as that of S for the fraction r of the way's time, is constant, and falls.
Jet HalfStepMotion::FootAt(double sigma) const {
  const double begin = foot_begin() / duration(), end = foot_end() / duration();
  const double middle = (begin + end) / 2, r = form().foot_ramp;
  const double from_end = std::max(std::min(sigma - begin, end - sigma), 0.0),
               ramp = r * (end - begin);
  const double speed = 15 / ((15 - 14 * r) * (end - begin));
  if (from_end > ramp) return {0.5 + speed * (sigma - middle), speed, 0};
  const Jet rise = StepAt(from_end, 0, 2 * ramp);
  const double a = 16 * r / (15 - 14 * r);
  return sigma < middle ? Jet{a * rise.value, a * rise.first, a * rise.second}
                        : Jet{1 - a * rise.value, a * rise.first, -a * rise.second};
}

// Up: S from take-off on; down: until landing; in the share of the flight that it takes.
Jet HalfStepMotion::HeightAt(double sigma) const {
  const double t1 = (1 - form().zmp_shift) / 2, lift = form().lift_share * t1;
  return half_step_.up ? StepAt(sigma, 1 - t1, 1 - t1 + lift) : StepAt(sigma, t1 - lift, t1);
}

// Of the waist's way up, or mirrored in time down.
Jet HalfStepMotion::RiseAt(double sigma) const {
  const double begin = form().rise_begin, end = form().rise_end;
  return half_step_.up ? StepAt(sigma, begin, end) : StepAt(sigma, 1 - end, 1 - begin);
}

void HalfStepMotion::AddAt(double tau, WalkInstant* at) const {
  if (tau <= 0) return;
  if (tau >= duration()) {
    at->value += delta_;
    return;
  }
  const double sigma = tau / duration();
  const auto add = [&](int number, int count, const Jet& f) {
    const auto delta = delta_.segment(number, count);
    at->value.segment(number, count) += f.value * delta;
    at->first.segment(number, count) += f.first / duration() * delta;
    at->second.segment(number, count) += f.second / (duration() * duration()) * delta;
  };
  add(kComX, 2, shift_.Com(sigma));
  add(kZmpX, 2, shift_.Zmp(sigma));
  add(kWaistYaw, 1, StepAt(sigma, 0, 1));
  if (delta_[kWaistZ] != 0) add(kWaistZ, 1, RiseAt(sigma));
  const int foot = SoleX(Index(half_step_.swing()));
  const Jet way = FootAt(sigma);
  add(foot, 2, way);
  add(foot + 3, 1, way);
  add(foot + 2, 1, HeightAt(sigma));
}

Eigen::Vector2d HalfStepMotion::SecondBounds(double from, double to) const {
  const double T = duration();
  if (to <= 0 || from >= T) return {0, 0};
  return (shift_.ComSecondBound() * delta_.segment<2>(kComX).cwiseAbs() +
          shift_.ZmpSecondBound(from / T, to / T) * delta_.segment<2>(kZmpX).cwiseAbs()) /
         (T * T);
}

}  // namespace halfstep::verify
