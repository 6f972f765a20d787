#include "experiments/checker/walk_motion.h"

#include <algorithm>
#include <cmath>

#include "wpg/check.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/robot/gravity.h"

namespace halfstep::checker {
namespace {

constexpr double kTogether = 1e-9;  // times that are no farther apart are the same [s]

// A sole.
struct Place {
  Interval x, y, z, yaw;

  // The point (ahead, aside) of it, seen from above.
  std::array<Interval, 2> Of(const Interval& ahead, const Interval& aside) const {
    const auto [s, c] = SinCosOf(yaw);
    return {x + c * ahead - s * aside, y + s * ahead + c * aside};
  }
};

[[noreturn]] void Refuse(size_t row, const std::string& what) {
  throw InputError({Formatted("half_steps.csv: half-step %zu: ", row + 1) + what});
}

Interval Mean(const Interval& a, const Interval& b) { return Interval(0.5) * (a + b); }

// Of a row, or of the plan where it has none.
verify::FormColumns FormOf(const verify::HalfStepRow& row, const verify::FormColumns& planned) {
  verify::FormColumns form = row.form.value_or(planned);
  for (const verify::FormColumn& one : verify::kRiseColumns) {
    if (!row.has_rise) form.*one.value = planned.*one.value;
  }
  return form;
}

// A form of which profiles are known.
bool CanBe(const verify::FormColumns& form) {
  return form.zmp_shift > 0.0 && form.zmp_shift <= 0.5 && form.zmp_bump_ramp >= 0.1 &&
         form.zmp_bump_ramp <= 1.0 && form.foot_ramp >= 0.1 && form.foot_ramp <= 0.5 &&
         form.lift_share > 0.0 && form.lift_share <= 1.0 && form.foot_delay >= 0.0 &&
         form.foot_delay < 0.45 * (1.0 - form.zmp_shift) && form.rise_begin >= 0.0 &&
         form.rise_begin < form.rise_end && form.rise_end <= 1.0;
}

}  // namespace

WalkMotion::WalkMotion(const WalkTables& tables) {
  const auto& [footsteps, rows, starts, planned, com_height, crouch] = tables;
  if (footsteps.size() < 3 || (rows.size() + 1) / 2 != footsteps.size() - 2 ||
      starts.size() != rows.size()) {
    throw InputError({"half_steps.csv: has not two half-steps for each row of footsteps.csv"});
  }
  const Interval omega_squared = Interval(kGravity) / com_height;
  std::array<Place, 2> soles;
  for (const verify::FootstepRow& row : footsteps) {
    if (row.footstep != 0) continue;
    soles[row.foot == "left" ? 0 : 1] = {row.X_WF.x, row.X_WF.y, row.z, row.X_WF.yaw};
  }
  // How much higher the waist is kept than at the start.
  const auto higher = [&crouch = crouch](const verify::FootstepRow& row) {
    const bool other = row.crouch && *row.crouch != crouch;
    if (other && !(*row.crouch >= 0.0 && *row.crouch <= 0.5)) {
      throw InputError({"footsteps.csv: crouch_m is none that there can be (valid: 0 … 0.5)"});
    }
    return other ? Interval(crouch) - Interval(*row.crouch) : Interval(0.0);
  };
  const auto raised = [](const Interval& z, const Interval& rise) {
    return rise.lo == 0.0 && rise.hi == 0.0 ? z : z + rise;
  };
  for (size_t i = 0; i < 2; ++i) {
    const std::optional<double>& at_start = footsteps[i].crouch;
    if (!at_start || *at_start == crouch) continue;
    throw InputError({"footsteps.csv: crouch_m at the start is not that of config.yaml"});
  }
  const auto add_rest = [&](const std::array<Interval, 2>& com, const Interval& yaw,
                            const Interval& waist_z) {
    Rest& rest = rests_.emplace_back();
    for (size_t i = 0; i < 2; ++i) rest[kCom + i] = rest[kZmp + i] = com[i];
    rest[kYaw] = yaw;
    rest[kWaistZ] = waist_z;
    for (size_t side = 0; side < 2; ++side) {
      const Place& sole = soles[side];
      std::ranges::copy(std::array{sole.x, sole.y, sole.z, sole.yaw},
                        rest.begin() + kSole + 4 * side);
    }
  };
  const auto add_standing = [&](const Interval& rise) {
    const Interval &z = soles[0].z, &w = soles[1].z;  // over the lower one
    add_rest({Mean(soles[0].x, soles[1].x), Mean(soles[0].y, soles[1].y)},
             Mean(soles[0].yaw, soles[1].yaw),
             raised({std::min(z.lo, w.lo), std::min(z.hi, w.hi)}, rise));
  };
  add_standing(0.0);
  for (size_t i = 0; i < rows.size(); ++i) {
    const verify::HalfStepRow& row = rows[i];
    const bool up = i % 2 == 0;
    const size_t support = row.support == "left" ? 0 : 1, swing = 1 - support;
    const verify::FootstepRow& footstep = footsteps[i / 2 + 2];
    const verify::FormColumns form = FormOf(row, planned);
    if (row.kind != (up ? "up" : "down") || footstep.foot == row.support) {
      Refuse(i, "is not of its footstep");
    }
    const verify::HalfStepRow& other = rows[up ? std::min(i + 1, rows.size() - 1) : i - 1];
    const verify::FormColumns of_other = FormOf(other, planned);
    if (other.support_point != row.support_point || other.height_scale != row.height_scale ||
        of_other.via_lateral != form.via_lateral || of_other.via_along != form.via_along) {
      Refuse(i, "the other one of its step is elsewhere where they meet");
    }
    if (!(row.duration > 0.0) || !CanBe(form)) Refuse(i, "is none that there can be");
    const Interval duration = row.duration, start = starts[i], shift = form.zmp_shift;
    const Interval first = Interval(0.5) - Interval(0.5) * shift, second = Interval(1.0) - first;
    const Interval lift = Interval(form.lift_share) * first, delay = form.foot_delay;
    const Interval rise_begin = form.rise_begin, rise_end = form.rise_end;
    steps_.push_back(
        {start, duration, start + duration, shift * duration, swing, Profile::Step(0.0, 1.0),
         up ? Profile::RampedStep(second + delay, 1.0, form.foot_ramp)
            : Profile::RampedStep(0.0, first - delay, form.foot_ramp),
         up ? Profile::Step(second, second + lift) : Profile::Step(first - lift, first),
         up ? Profile::Step(rise_begin, rise_end)
            : Profile::Step(Interval(1.0) - rise_end, Interval(1.0) - rise_begin),
         Pendulum::Of(omega_squared * Square(duration), shift, form.zmp_bump_ramp)});
    const auto later = [](const Interval& a, const Interval& b) { return a.lo > b.lo + kTogether; };
    if (i > 0 && (later(steps_[i - 1].start, start) || later(steps_[i - 1].end, steps_[i].end))) {
      Refuse(i, "begins or ends before the one before it");
    }
    if (up) {
      const Interval aside = swing == 0 ? 1.0 : -1.0;
      const Place& on = soles[support];
      const auto [x, y] = on.Of(form.via_along, aside * Interval(form.via_lateral));
      soles[swing] = {x, y, on.z + Interval(row.height_scale) * Interval(footstep.via_height),
                      on.yaw};
      add_rest(on.Of(0.0, aside * Interval(row.support_point)), on.yaw,
               raised(on.z, higher(footstep)));
      flights_.push_back(FlightOf(steps_.back(), rests_[i]));
      continue;
    }
    const Pose2 &X_WF = footstep.X_WF, &move = form.footstep;
    const Place at{X_WF.x, X_WF.y, footstep.z, X_WF.yaw};
    const auto [x, y] = at.Of(move.x, move.y);
    soles[swing] = {x, y, at.z, at.yaw + Interval(move.yaw)};
    add_standing(higher(footstep));
    WalkMotion::Flight& flight = flights_.back();
    const HalfStep& now = steps_.back();
    flight.end = now.At(now.height.span().second).hi;
    flight.moves_from = std::min(flight.moves_from, start.lo);
    flight.moves_to = std::max(now.At(now.way.span().second).hi, flight.moves_to);
    flight.landing = footstep.z;
    flight.lands = true;
    // Else the foot would move where it stands.
    if (flight.moves_from < flight.begin - kTogether || flight.moves_to > flight.end + kTogether) {
      Refuse(i, "begins before the foot is raised, or lands before it is");
    }
  }
  double ended = 0.0;
  for (const HalfStep& step : steps_) ended_.push_back(ended = std::max(ended, step.end.hi));
  since_.emplace_back();
  for (const Flight& flight : flights_) {
    since_.push_back(since_.back());
    since_.back()[flight.side] = std::min(flight.end, end());
  }
  FindKnots();
}

void WalkMotion::FindKnots() {
  knots_ = {0.0, end()};
  for (const HalfStep& step : steps_) {
    for (const Profile* profile : {&step.yaw, &step.way, &step.height, &step.rise}) {
      for (const Interval& sigma : {profile->span().first, profile->span().second}) {
        knots_.push_back(step.At(sigma).Middle());
      }
    }
  }
  for (const Flight& flight : flights_) {
    knots_.insert(knots_.end(), {flight.begin, flight.end, flight.moves_from, flight.moves_to});
  }
  std::ranges::sort(knots_);
  std::erase_if(knots_, [&](double t) { return t < 0.0 || t > end(); });
  knots_.erase(std::unique(knots_.begin(), knots_.end()), knots_.end());
}

WalkMotion::Flight WalkMotion::FlightOf(const HalfStep& up, const Rest& before) {
  return {up.swing,  up.At(up.height.span().first).lo,
          up.end.hi, up.At(up.way.span().first).lo,
          up.end.hi, before[kSole + 4 * up.swing + 2].Middle(),
          false};
}

WalkMotion WalkMotion::CutAfter(size_t last, double from) const {
  HALFSTEP_CHECK(first_ == 0 && last < size(), "half-step " << last << " of " << size());
  const auto lasts = std::ranges::lower_bound(ended_, from) - ended_.begin();
  const size_t step = static_cast<size_t>(lasts) / 2, begin = step > 0 ? step - 1 : 0;
  HALFSTEP_CHECK(2 * begin <= last, "half-step " << last << " ends before " << from);
  const auto part = [](const auto& of, size_t i, size_t end) {
    return std::vector(of.begin() + static_cast<std::ptrdiff_t>(i),
                       of.begin() + static_cast<std::ptrdiff_t>(end));
  };
  WalkMotion cut;
  cut.first_ = 2 * begin;
  cut.steps_ = part(steps_, cut.first_, last + 1);
  cut.ended_ = part(ended_, cut.first_, last + 1);
  cut.rests_ = part(rests_, cut.first_, last + 2);
  cut.flights_ = part(flights_, begin, last / 2 + 1);
  cut.since_ = {since_[begin]};
  if (last % 2 == 0) cut.flights_.back() = FlightOf(steps_[last], rests_[last]);
  cut.FindKnots();
  return cut;
}

const WalkMotion::Flight* WalkMotion::FlightAt(double t) const {
  const auto after = std::ranges::upper_bound(flights_, t, {}, &Flight::begin);
  if (after == flights_.begin() || std::prev(after)->end < t) return nullptr;
  return &*std::prev(after);
}

std::array<Interval, 2> WalkMotion::StartAndShift(size_t half_step) const {
  const HalfStep& of = steps_[half_step - first_];
  return {of.start, of.shift};
}

WalkNumbers WalkMotion::On(double from, double to) const {
  const double m = 0.5 * from + 0.5 * to;
  const double h = Interval(from, to).FarthestFrom(m);
  // Those that have ended have brought everything to where the next one begins.
  const auto lasts = std::ranges::lower_bound(ended_, from) - ended_.begin();
  const auto first = static_cast<size_t>(lasts);
  WalkNumbers numbers;
  for (size_t k = 0; k < kNumWalkNumbers; ++k) numbers[k] = rests_[first][k];
  // Starts are in order but for rounding.
  for (size_t i = first; i < steps_.size() && steps_[i].start.lo <= to + 1e-3; ++i) {
    const HalfStep& step = steps_[i];
    if (step.start.lo > to) continue;
    const Interval at = (Interval(m) - step.start) / step.duration;
    const Interval over = (Interval(from, to) - step.start) / step.duration;
    // Of a profile, as a function of time.
    const auto curve = [&](const auto& of) {
      const std::array<Interval, 4> f = of(at), g = of(over);
      const Interval rate = Interval(1.0) / step.duration;
      Curve curve;
      curve.h = h;
      curve.at = {f[0], f[1] * rate, f[2] * Square(rate)};
      curve.over[3] = g[3] * (rate * Square(rate));
      return curve.Enclose();
    };
    const auto of = [](const Profile& profile) {
      return [&profile](const Interval& sigma) { return profile.At(sigma); };
    };
    const auto add = [&](size_t number, const Curve& shape) {
      numbers[number] = numbers[number] + (rests_[i + 1][number] - rests_[i][number]) * shape;
    };
    const Curve com = curve([&](const Interval& x) { return step.pendulum.ComAt(x); });
    const Curve zmp = curve(of(step.pendulum.zmp)), way = curve(of(step.way));
    for (size_t k = 0; k < 2; ++k) {
      add(kCom + k, com);
      add(kZmp + k, zmp);
      add(kSole + 4 * step.swing + k, way);
    }
    add(kYaw, curve(of(step.yaw)));
    add(kWaistZ, curve(of(step.rise)));
    add(kSole + 4 * step.swing + 2, curve(of(step.height)));
    add(kSole + 4 * step.swing + 3, way);
  }
  return numbers;
}

}  // namespace halfstep::checker
