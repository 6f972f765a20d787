#include "tests/oracle/closed_form_walk.h"

#include <algorithm>

namespace halfstep::oracle {
namespace {

// 10x³ − 15x⁴ + 6x⁵ on [0, 1] and its slope.
Real Smooth(Real x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  return x * x * x * (10 + x * (6 * x - 15));
}
Real SmoothSlope(Real x) { return x <= 0 || x >= 1 ? Real(0) : 30 * x * x * (1 - x) * (1 - x); }
Real SmoothSecond(Real x) { return x <= 0 || x >= 1 ? Real(0) : 60 * x * (1 - x) * (1 - 2 * x); }

// The same with a constant speed between the fractions r and 1 − r; the ramps are stretched halves
// of it, so that their slopes meet that speed 15/(15 − 14r).
Real Ramped(Real x, Real r) {
  if (x > Real(0.5)) return 1 - Ramped(1 - x, r);
  if (x <= r) return 16 * r / (15 - 14 * r) * Smooth(x / (2 * r));
  return Real(0.5) + 15 / (15 - 14 * r) * (x - Real(0.5));
}
Real RampedSlope(Real x, Real r) {
  if (x > Real(0.5)) return RampedSlope(1 - x, r);
  return x <= r ? 8 / (15 - 14 * r) * SmoothSlope(x / (2 * r)) : 15 / (15 - 14 * r);
}

Real RampedSecond(Real x, Real r) {
  if (x > Real(0.5)) return -RampedSecond(1 - x, r);
  return x <= r ? 4 / (r * (15 - 14 * r)) * SmoothSecond(x / (2 * r)) : Real(0);
}

int FirstOf(int foot) { return 5 + 4 * foot; }

}  // namespace

ClosedFormWalk::ClosedFormWalk(const WalkPlan& plan, bool with_stretches) {
  const Real omega = Sqrt(Real(kGravity) / Real(plan.com_height));
  std::array<FloorPose, 2> feet = plan.start;
  // With both feet on the ground: the waist is over the lower one.
  const auto standing = [&feet, &plan] {
    const FloorPose &l = feet[0], &r = feet[1];
    const Real x = (Real(l.x) + r.x) / 2, y = (Real(l.y) + r.y) / 2;
    const Real waist = Real(std::min(l.z, r.z)) - Real(plan.crouch);
    return Quantities{x,   y,   x,     y,    (Real(l.yaw) + r.yaw) / 2, l.x, l.y, l.z, l.yaw, r.x,
                      r.y, r.z, r.yaw, waist};
  };
  Real begin = 0;
  for (size_t i = 0; i < 2 * plan.steps.size(); ++i) {
    const PlannedStep& step = plan.steps[i / 2];
    const FloorPose support = feet[static_cast<size_t>(1 - step.foot)];
    const bool up = i % 2 == 0;
    if (!up) feet[static_cast<size_t>(step.foot)] = plan.landing_of(i / 2);
    const Quantities on_floor = standing();
    Quantities via = on_floor;
    const Real inward = (step.foot == 0 ? 1 : -1) * Real(plan.support_points[i / 2]);
    via[0] = via[2] = support.x - Sin(Real(support.yaw)) * inward;
    via[1] = via[3] = support.y + Cos(Real(support.yaw)) * inward;
    via[4] = support.yaw;
    const size_t f = static_cast<size_t>(FirstOf(step.foot));
    const Real aside = (step.foot == 0 ? 1 : -1) * Real(plan.via_lateral_of(i));
    const Real ahead = plan.via_along_of(i);
    via[f] = support.x + Cos(Real(support.yaw)) * ahead - Sin(Real(support.yaw)) * aside;
    via[f + 1] = support.y + Sin(Real(support.yaw)) * ahead + Cos(Real(support.yaw)) * aside;
    via[f + 2] = support.z + Real(plan.height_scales[i / 2]) * Real(step.via_height);
    via[f + 3] = support.yaw;
    via[13] = Real(support.z) - Real(plan.crouch);
    const Real T = plan.durations[i];
    HalfStep half_step{
        .up = up,
        .swing = step.foot,
        .begin = begin,
        .end = begin + T,
        .T = T,
        .sigma1 = (1 - Real(plan.shift_of(i))) / 2,
        .sigma2 = (1 + Real(plan.shift_of(i))) / 2,
        .delay = plan.foot_delay_of(i),
        .ramp = plan.foot_ramp_of(i),
        .share = plan.lift_share_of(i),
        .bump_ramp = plan.bump_ramp_of(i),
        .rise_begin = up ? Real(plan.rise_begin_of(i)) : 1 - Real(plan.rise_end_of(i)),
        .rise_end = up ? Real(plan.rise_end_of(i)) : 1 - Real(plan.rise_begin_of(i)),
        .lands_at = plan.landing_of(i / 2).z,
        .profile = RestToRestClosedForm(omega * T, plan.shift_of(i), plan.bump_ramp_of(i))};
    half_step.from = up ? on_floor : via;
    const Quantities& to = up ? via : on_floor;
    for (size_t q = 0; q < to.size(); ++q) half_step.change[q] = to[q] - half_step.from[q];
    half_steps_.push_back(half_step);
    if (i < plan.overlaps.size()) begin += T - Real(plan.overlaps[i]);
  }
  if (with_stretches) CutIntoStretches();
}

void ClosedFormWalk::Fractionize(const HalfStep& h, Real tau, Jet* jet) const {
  const Real sigma = tau / h.T, TT = h.T * h.T;
  const ComZmp pair = h.profile.At(sigma);
  // Windows of the foot's horizontal motion and of its height.
  const Real foot_begin = h.up ? h.sigma2 + h.delay : Real(0);
  const Real foot_window = (h.up ? Real(1) : h.sigma1 - h.delay) - foot_begin;
  const Real flight = h.up ? 1 - h.sigma2 : h.sigma1;
  const Real height_begin = h.up ? h.sigma2 : h.sigma1 - h.share * flight;
  const Real height_window = h.share * flight;
  const Real foot = (sigma - foot_begin) / foot_window;
  const Real height = (sigma - height_begin) / height_window;
  const Real rise_window = h.rise_end - h.rise_begin, rise = (sigma - h.rise_begin) / rise_window;
  (*jet)[0] = {pair.c, pair.p, Smooth(sigma), Ramped(foot, h.ramp), Smooth(height), Smooth(rise)};
  (*jet)[1] = {pair.c_rate / h.T,
               pair.p_rate / h.T,
               SmoothSlope(sigma) / h.T,
               RampedSlope(foot, h.ramp) / (h.T * foot_window),
               SmoothSlope(height) / (h.T * height_window),
               SmoothSlope(rise) / (h.T * rise_window)};
  (*jet)[2] = {pair.c_second / TT,
               0,
               SmoothSecond(sigma) / TT,
               RampedSecond(foot, h.ramp) / (TT * foot_window * foot_window),
               SmoothSecond(height) / (TT * height_window * height_window),
               SmoothSecond(rise) / (TT * rise_window * rise_window)};
}

Real ClosedFormWalk::Of(const Fractions& fractions, int quantity) {
  if (quantity < 2) return fractions.com;
  if (quantity < 4) return fractions.zmp;
  if (quantity == 4) return fractions.waist;
  if (quantity == 13) return fractions.rise;
  return (quantity - 5) % 4 == 2 ? fractions.height : fractions.foot;
}

std::array<ClosedFormWalk::Quantities, 3> ClosedFormWalk::Exactly(Real t) const {
  std::array<Quantities, 3> walk{half_steps_.front().from};
  for (const HalfStep& h : half_steps_) {
    if (t <= h.begin) break;
    if (t >= h.end) {
      for (size_t k = 0; k < walk[0].size(); ++k) walk[0][k] += h.change[k];
      continue;
    }
    Jet jet;
    Fractionize(h, t - h.begin, &jet);
    for (size_t d = 0; d < 3; ++d) {
      for (int q = 0; q < 14; ++q) {
        const size_t k = static_cast<size_t>(q);
        walk[d][k] += h.change[k] * Of(jet[d], q);
      }
    }
  }
  return walk;
}

WalkState ClosedFormWalk::At(Real t) const {
  const std::array<Quantities, 3> walk = Exactly(t);
  const auto pack = [](const Quantities& x) {
    const auto d = [&x](size_t q) { return static_cast<double>(x[q]); };
    return WalkState::Values{
        {d(0), d(1)},
        {d(2), d(3)},
        d(4),
        d(13),
        {Eigen::Vector4d(d(5), d(6), d(7), d(8)), Eigen::Vector4d(d(9), d(10), d(11), d(12))}};
  };
  return {pack(walk[0]), pack(walk[1]), pack(walk[2])};
}

void ClosedFormWalk::CutIntoStretches() {
  struct Air {
    int foot;
    Real begin, end, moves_begin, moves_end;
    double lands_at;
  };
  std::vector<Air> flights;
  std::vector<double> knots;
  for (size_t i = 0; i + 1 < half_steps_.size(); i += 2) {
    const HalfStep &up = half_steps_[i], &down = half_steps_[i + 1];
    const Real up_moves = up.begin + (up.sigma2 + up.delay) * up.T;
    const Real down_moves_end = down.begin + (down.sigma1 - down.delay) * down.T;
    flights.push_back({up.swing, up.begin + up.sigma2 * up.T, down.begin + down.sigma1 * down.T,
                       std::min(up_moves, down.begin), std::max(down_moves_end, up.end),
                       up.lands_at});
    for (Real knot : {flights.back().begin, flights.back().end, up_moves, down_moves_end}) {
      knots.push_back(static_cast<double>(knot));
    }
  }
  for (const HalfStep& h : half_steps_) {
    // Where a profile changes its formula: the ZMP's shift and its bump's ramps, the foot's ramps
    // and its lift.
    const Real bump = std::min(h.bump_ramp, 1 - h.bump_ramp) * h.sigma1;
    const Real foot_begin = h.up ? h.sigma2 + h.delay : Real(0);
    const Real foot_end = h.up ? Real(1) : h.sigma1 - h.delay;
    const Real ramp = h.ramp * (foot_end - foot_begin);
    const Real lift = h.up ? h.sigma2 + h.share * (1 - h.sigma2) : h.sigma1 * (1 - h.share);
    for (Real knot :
         {Real(0), Real(1), h.sigma1, h.sigma2, bump, h.sigma1 - bump, h.sigma2 + bump, 1 - bump,
          foot_begin + ramp, foot_end - ramp, lift, h.rise_begin, h.rise_end}) {
      knots.push_back(static_cast<double>(h.begin + knot * h.T));
    }
  }
  std::sort(knots.begin(), knots.end());
  for (size_t k = 0; k + 1 < knots.size(); ++k) {
    if (knots[k + 1] - knots[k] < 1e-12) continue;
    Stretch stretch{.begin = knots[k], .end = knots[k + 1]};
    const Real middle = (Real(stretch.begin) + stretch.end) / 2;
    for (const Air& air : flights) {
      if (middle < air.begin || middle > air.end) continue;
      stretch.in_air = air.foot;
      stretch.moves = middle >= air.moves_begin && middle <= air.moves_end;
      stretch.lands_at = air.lands_at;
    }
    for (const HalfStep& h : half_steps_) {
      const Real sigma = (middle - h.begin) / h.T;
      if (sigma < h.sigma1 || sigma > h.sigma2) continue;
      stretch.shift = std::min(stretch.shift, static_cast<double>((h.sigma2 - h.sigma1) * h.T));
    }
    stretches_.push_back(stretch);
  }
}

}  // namespace halfstep::oracle
