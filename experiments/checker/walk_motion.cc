#include "experiments/checker/walk_motion.h"

#include <algorithm>
#include <cmath>

#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/robot/gravity.h"

namespace halfstep::checker {
namespace {

// A sole seen from above.
struct Place {
  Interval x, y, yaw;

  // The point (ahead, aside) of it.
  std::array<Interval, 2> Of(const Interval& ahead, const Interval& aside) const {
    const auto [s, c] = SinCosOf(yaw);
    return {x + c * ahead - s * aside, y + s * ahead + c * aside};
  }
};

[[noreturn]] void Refuse(size_t row, const std::string& what) {
  throw InputError({Formatted("half_steps.csv: half-step %zu: ", row + 1) + what});
}

Interval Mean(const Interval& a, const Interval& b) { return Interval(0.5) * (a + b); }

}  // namespace

WalkMotion::WalkMotion(const WalkTables& tables) {
  const auto& [footsteps, rows, starts, planned, com_height] = tables;
  if (footsteps.size() < 3 || rows.size() != 2 * (footsteps.size() - 2) ||
      starts.size() != rows.size()) {
    throw InputError({"half_steps.csv: has not two half-steps for each row of footsteps.csv"});
  }
  const Interval omega_squared = Interval(kGravity) / com_height;
  std::array<Place, 2> soles;
  for (const verify::FootstepRow& row : footsteps) {
    if (row.z != 0.0) throw InputError({"footsteps.csv: heights (valid here: a level floor)"});
    if (row.footstep == 0)
      soles[row.foot == "left" ? 0 : 1] = {row.X_WF.x, row.X_WF.y, row.X_WF.yaw};
  }
  const auto add_rest = [&](const std::array<Interval, 2>& com, const Interval& yaw) {
    Rest& rest = rests_.emplace_back();
    for (size_t i = 0; i < 2; ++i) rest[kCom + i] = rest[kZmp + i] = com[i];
    rest[kYaw] = yaw;
    for (size_t side = 0; side < 2; ++side) {
      const size_t at = kSole + 4 * side;
      rest[at] = soles[side].x, rest[at + 1] = soles[side].y, rest[at + 3] = soles[side].yaw;
    }
    return &rest;
  };
  const auto add_standing = [&] {
    add_rest({Mean(soles[0].x, soles[1].x), Mean(soles[0].y, soles[1].y)},
             Mean(soles[0].yaw, soles[1].yaw));
  };
  add_standing();
  for (size_t i = 0; i < rows.size(); ++i) {
    const verify::HalfStepRow& row = rows[i];
    const bool up = i % 2 == 0;
    const size_t support = row.support == "left" ? 0 : 1, swing = 1 - support;
    const verify::FootstepRow& footstep = footsteps[i / 2 + 2];
    const verify::FormColumns form = row.form.value_or(planned);
    if (row.kind != (up ? "up" : "down") || footstep.foot == row.support) {
      Refuse(i, "is not of its footstep");
    }
    const verify::HalfStepRow& other = rows[up ? i + 1 : i - 1];
    const verify::FormColumns of_other = other.form.value_or(planned);
    if (other.support_point != row.support_point || other.height_scale != row.height_scale ||
        of_other.via_lateral != form.via_lateral || of_other.via_along != form.via_along) {
      Refuse(i, "the other one of its step is elsewhere where they meet");
    }
    if (!(row.duration > 0.0 && form.zmp_shift > 0.0 && form.zmp_shift <= 0.5 &&
          form.zmp_bump_ramp >= 0.1 && form.zmp_bump_ramp <= 1.0 && form.foot_ramp >= 0.1 &&
          form.foot_ramp <= 0.5 && form.lift_share > 0.0 && form.lift_share <= 1.0 &&
          form.foot_delay >= 0.0 && form.foot_delay < 0.45 * (1.0 - form.zmp_shift))) {
      Refuse(i, "is none that there can be");
    }
    const Interval duration = row.duration, start = starts[i], shift = form.zmp_shift;
    const Interval first = Interval(0.5) - Interval(0.5) * shift, second = Interval(1.0) - first;
    const Interval lift = Interval(form.lift_share) * first, delay = form.foot_delay;
    steps_.push_back(
        {start, duration, start + duration, shift * duration, swing, Profile::Step(0.0, 1.0),
         up ? Profile::RampedStep(second + delay, 1.0, form.foot_ramp)
            : Profile::RampedStep(0.0, first - delay, form.foot_ramp),
         up ? Profile::Step(second, second + lift) : Profile::Step(first - lift, first),
         Pendulum::Of(omega_squared * Square(duration), shift, form.zmp_bump_ramp)});
    const auto later = [](const Interval& a, const Interval& b) { return a.lo > b.lo + 1e-9; };
    if (i > 0 && (later(steps_[i - 1].start, start) || later(steps_[i - 1].end, steps_[i].end))) {
      Refuse(i, "begins or ends before the one before it");
    }
    if (up) {
      const double aside = swing == 0 ? 1.0 : -1.0;
      const Place& on = soles[support];
      const auto via = on.Of(form.via_along, Interval(aside) * Interval(form.via_lateral));
      soles[swing] = {via[0], via[1], on.yaw};
      (*add_rest(on.Of(0.0, Interval(aside) * Interval(row.support_point)),
                 on.yaw))[kSole + 4 * swing + 2] =
          Interval(row.height_scale) * Interval(footstep.via_height);
      continue;
    }
    const Pose2 &X_WF = footstep.X_WF, &move = form.footstep;
    const Place at{X_WF.x, X_WF.y, X_WF.yaw};
    const auto [x, y] = at.Of(move.x, move.y);
    soles[swing] = {x, y, at.yaw + Interval(move.yaw)};
    add_standing();

    const HalfStep& rise = steps_[i - 1];
    const HalfStep& sink = steps_[i];
    const auto time = [](const HalfStep& of, const Interval& sigma) {
      return of.start + sigma * of.duration;
    };
    const Interval moves = time(rise, rise.way.span().first);
    flights_.push_back({swing, time(rise, rise.height.span().first).lo,
                        time(sink, sink.height.span().second).hi, std::min(moves.lo, sink.start.lo),
                        std::max(time(sink, sink.way.span().second).hi, rise.end.hi)});
  }
  knots_ = {0.0, end()};
  for (const HalfStep& step : steps_) {
    for (const Profile* profile : {&step.yaw, &step.way, &step.height}) {
      for (const Interval& sigma : {profile->span().first, profile->span().second}) {
        knots_.push_back((step.start + sigma * step.duration).Middle());
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

std::array<Interval, 2> WalkMotion::StartAndShift(size_t half_step) const {
  return {steps_[half_step].start, steps_[half_step].shift};
}

WalkNumbers WalkMotion::On(double from, double to) const {
  const double m = 0.5 * from + 0.5 * to;
  const double h = Interval(from, to).FarthestFrom(m);
  // Those that have ended have brought everything to where the next one begins.
  size_t first = 0;
  while (first < steps_.size() && steps_[first].end.hi < from) ++first;
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
    add(kSole + 4 * step.swing + 2, curve(of(step.height)));
    add(kSole + 4 * step.swing + 3, way);
  }
  return numbers;
}

}  // namespace halfstep::checker
