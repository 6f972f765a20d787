#include "tests/oracle/rounding_draws.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "smoothing/walk/walk_rounding.h"
#include "tests/oracle/exact_leg.h"
#include "tests/oracle/nasty_draws.h"
#include "tests/oracle/project_side.h"
#include "wpg/motion/posture_rounding.h"
#include "wpg/motion/ramped_step.h"
#include "wpg/motion/rest_to_rest.h"
#include "wpg/nth.h"
#include "wpg/rounded.h"

namespace halfstep::oracle {
namespace {

double Difference(Real exact, double computed) {
  const Real d = exact - Real(computed);
  return static_cast<double>(d < 0 ? -d : d);
}

// x, y and the speed of a smoothstep.
std::array<Real, 3> Smooth(Real x) {
  if (x <= 0) return {0, 0, 0};
  if (x >= 1) return {1, 0, 0};
  return {x * x * x * (10 + x * (6 * x - 15)), 30 * x * x * (1 - x) * (1 - x),
          60 * x * (1 - x) * (1 - 2 * x)};
}

std::array<Real, 3> Ramped(Real x, Real r) {
  if (x > Real(0.5)) {
    const auto low = Ramped(1 - x, r);
    return {1 - low[0], low[1], -low[2]};
  }
  if (x > r) return {Real(0.5) + 15 / (15 - 14 * r) * (x - Real(0.5)), 15 / (15 - 14 * r), 0};
  const Real a = 16 * r / (15 - 14 * r);
  const auto s = Smooth(x / (2 * r));
  return {a * s[0], a * s[1] / (2 * r), a * s[2] / (4 * r * r)};
}

void Compare(const std::string& form, const std::array<Real, 3>& exact, const UnitJet& computed,
             const UnitAccuracy& accuracy, double sigma, RoundingTally* tally) {
  const double off = 2.0 * kRoundoff * sigma;  // σ itself is what a time over T is rounded to
  tally->Add(form, Difference(exact[0], computed.value),
             accuracy.error.value + accuracy.most.s * off);
  tally->Add(form + "'", Difference(exact[1], computed.s),
             accuracy.error.s + accuracy.most.ss * off);
  tally->Add(form + "''", Difference(exact[2], computed.ss),
             accuracy.error.ss + accuracy.most.sss * off);
}

}  // namespace

WalkJet DrawPose(const RobotModel& robot, double scale, Draw* draw) {
  WalkJet jet;
  const double far = draw->Chance(0.3) ? 900.0 : draw->Logarithmic(0.01, 100.0);
  const double turns = draw->Chance(0.3) ? std::floor(draw->Uniform(-100, 101)) : 0.0;
  jet.value[kComX] = draw->Uniform(-far, far);
  jet.value[kComY] = draw->Uniform(-far, far);
  jet.value[kWaistYaw] = 2 * std::numbers::pi * turns + draw->Uniform(-3, 3);
  const double c = std::cos(jet.value[kWaistYaw]), s = std::sin(jet.value[kWaistYaw]);
  for (int q = 0; q < kNumQuantities; ++q) {
    const bool yaw = Nth(kQuantities, q).component == Component::kYaw;
    jet.first[q] = draw->Uniform(-1, 1) * (yaw ? 1.0 : scale);
  }
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Leg& leg = Nth(robot.legs, Index(side));
    const double length = (leg.ankle_B - leg.hip_B).norm();
    const double bent = draw->Logarithmic(1e-12, 0.3);
    Eigen::Vector3d down(draw->Uniform(-0.4, 0.4), draw->Uniform(-0.25, 0.25), -1);
    const double yaw = draw->Uniform(-0.4, 0.4);
    const Eigen::Vector3d ankle = leg.hip_B + (1 - bent) * length * down.normalized();
    const Eigen::Vector3d sole = leg.X_BSole.translation() - leg.ankle_B;
    const double x = ankle.x() + std::cos(yaw) * sole.x() - std::sin(yaw) * sole.y();
    const double y = ankle.y() + std::sin(yaw) * sole.x() + std::cos(yaw) * sole.y();
    const int f = FootIndex(side);
    jet.value[f] = jet.value[kComX] + c * (x - robot.com_x_B) - s * y;
    jet.value[f + 1] = jet.value[kComY] + s * (x - robot.com_x_B) + c * y;
    jet.value[f + 2] = robot.waist_height + ankle.z() + sole.z();
    jet.value[f + 3] = jet.value[kWaistYaw] + yaw;
  }
  return jet;
}

void RoundingTally::Add(const std::string& part, double error, double bound) {
  Part& to = parts[part];
  if (!std::isfinite(bound)) {
    ++to.undecided;
    return;
  }
  ++to.draws;
  to.of_typical += std::log10(std::max(bound, 1e-300));
  to.largest = std::max(to.largest, bound > 0 ? error / bound : error > 0 ? HUGE_VAL : 0.0);
}

void RoundingTally::Add(const RoundingTally& other) {
  for (const auto& [name, part] : other.parts) {
    Part& to = parts[name];
    to.draws += part.draws;
    to.undecided += part.undecided;
    to.of_typical += part.of_typical;
    to.largest = std::max(to.largest, part.largest);
  }
}

void DrawForms(long draws, unsigned seed, RoundingTally* tally) {
  Draw draw(seed);
  while (draws > 0) {
    const double width = draw.Uniform(0.05, 1), begin = draw.Uniform(0, 1 - width);
    const RampedStep step{begin, begin + width, draw.Chance(0.3) ? 0.5 : draw.Uniform(0.1, 0.5)};
    const double theta = draw.Logarithmic(0.5, 60), shift = draw.Logarithmic(0.01, 0.5);
    const double ramps[] = {1, draw.Uniform(0.1, 0.5), draw.Uniform(0.5, 1)};
    const double ramp = ramps[draw.Below(3)];
    const RestToRest pair(theta, shift, ramp);
    const RestToRestClosedForm exact(theta, shift, ramp);
    for (int k = 0; k < 100 && draws > 0; ++k, --draws) {
      const double sigma = draw.Chance(0.5) ? draw.Uniform(0, 1) : draw.Uniform(begin, step.end);
      const Real w = Real(step.end) - Real(begin);
      std::array<Real, 3> of = Ramped((Real(sigma) - Real(begin)) / w, step.ramp);
      if (sigma <= begin) of = {0, 0, 0};
      if (sigma >= step.end) of = {1, 0, 0};
      Compare("step", {of[0], of[1] / w, of[2] / (w * w)}, step.At(sigma), step.Accuracy(), sigma,
              tally);
      const ComZmp at = exact.At(sigma);
      Compare("com", {at.c, at.c_rate, at.c_second}, pair.Com(sigma), pair.ComAccuracy(), sigma,
              tally);
      UnitJet zmp = pair.Zmp(sigma);
      zmp.ss = 0.0;
      Compare("zmp", {at.p, at.p_rate, 0}, zmp, pair.ZmpAccuracy(), sigma, tally);
    }
  }
}

void DrawWalks(const std::string& robot_file, long draws, int steps, unsigned seed,
               RoundingTally* tally) {
  const PlainRobot robot(robot_file);
  Draw draw(seed);
  while (draws > 0) {
    WalkPlan plan = DrawPlan(robot, &draw);
    if (steps > 0) {
      // On and on in place, so that times grow.
      plan.footsteps.clear();
      const WalkPlan short_one = plan;
      const size_t n = plan.steps.size();
      for (int j = static_cast<int>(n); j < steps; ++j) {
        const PlannedStep& before = plan.steps.back();
        const int foot = 1 - before.foot;
        FloorPose landing = Nth(plan.start, foot);
        for (const PlannedStep& step : plan.steps) {
          if (step.foot == foot) landing = step.landing;
        }
        const size_t like = static_cast<size_t>(j) % n;
        plan.steps.push_back(
            {foot, landing, short_one.steps[like].via_height, short_one.steps[like].duration});
        const auto repeat = [&](const std::vector<double>& from, size_t count,
                                std::vector<double>* to) {
          for (size_t k = 0; k < count && !from.empty(); ++k) to->push_back(from[count * like + k]);
        };
        for (auto number :
             {&WalkPlan::foot_ramps, &WalkPlan::foot_delays, &WalkPlan::lift_shares,
              &WalkPlan::zmp_shifts, &WalkPlan::zmp_bump_ramps, &WalkPlan::durations}) {
          repeat(short_one.*number, 2, &(plan.*number));
        }
        for (auto number : {&WalkPlan::height_scales, &WalkPlan::support_points,
                            &WalkPlan::via_laterals, &WalkPlan::via_alongs}) {
          repeat(short_one.*number, 1, &(plan.*number));
        }
      }
      plan.overlaps.clear();
      for (size_t i = 0; i + 1 < plan.durations.size(); ++i) {
        plan.overlaps.push_back(NaturalBound(plan, i) * draw.Uniform(0.3, 1));
      }
    }
    const ClosedFormWalk exact(plan, false);
    const SuperposedWalk walk(ToSequence(plan), ToParameters(plan));
    const std::string name = steps > 0 ? "long walk" : "walk";
    // An interval that ends where a half-step begins, or begins where one ends, and what is beyond.
    for (int i = 0; i < std::min(walk.num_half_steps(), 40); ++i) {
      const bool at_end = draw.Chance(0.5);
      const double t = at_end ? walk.start_of(i) : walk.end_of(i);
      const double begin = at_end ? t - 1e-3 : t, end = begin + 1e-3;
      if (begin < 0.0 || end > walk.duration()) continue;
      const halfstep::WalkState off = RoundingAt(walk, walk.Locate(begin + 0.5e-3)).second;
      const halfstep::WalkState known = walk.SecondBounds(begin, end) + off;
      const halfstep::WalkState most = known + SecondRounding(walk, begin, end);
      const LocalTime at{i, at_end ? 0.0 : walk.tracks(i).duration()};
      const double time = (at_end ? 0.5 : -0.5) * LocalTimeRounding(walk, at);
      const auto beyond = exact.Exactly(i, at.tau + time);
      for (int q = 0; q < kNumQuantities; ++q) {
        if (q == kZmpX || q == kZmpY) continue;
        const Real second = Nth(beyond[2], q);
        const double more = Difference(second < 0 ? -second : second, known[q]);
        if (second * second > Real(known[q]) * Real(known[q])) {
          tally->Add(name + " beyond''", more, most[q] - known[q]);
        }
      }
    }
    for (int k = 0; k < (steps > 0 ? 1000 : 40) && draws > 0; ++k, --draws) {
      LocalTime at = walk.Locate(draw.Uniform(0, walk.duration()));
      if (draw.Chance(0.2)) at.tau = draw.Chance(0.5) ? walk.tracks(at.half_step).t1() : 0.0;
      const WalkJet jet = walk.At(at), off = RoundingAt(walk, at);
      const auto of = exact.Exactly(at.half_step, at.tau);
      for (int q = 0; q < kNumQuantities; ++q) {
        const Component component = Nth(kQuantities, q).component;
        const std::string kind = name + (component == Component::kYaw ? " yaw"
                                         : component == Component::kZ ? " height"
                                                                      : " place");
        tally->Add(kind, Difference(Nth(of[0], q), jet.value[q]), off.value[q]);
        tally->Add(kind + "'", Difference(Nth(of[1], q), jet.first[q]), off.first[q]);
        if (q == kZmpX || q == kZmpY) continue;
        tally->Add(kind + "''", Difference(Nth(of[2], q), jet.second[q]), off.second[q]);
      }
    }
  }
}

void DrawLegs(const RobotModel& of, double scale, long draws, unsigned seed, RoundingTally* tally) {
  const RobotModel robot = ScaledRobot(of, scale);
  const RoundingOfPostures rounding(robot);
  Draw draw(seed);
  for (; draws > 0; --draws) {
    const WalkJet jet = DrawPose(robot, scale, &draw);
    WalkJet off;
    ClosedFormWalk::Quantities value{}, rate{};
    const bool moved = draw.Chance(0.5);
    for (int q = 0; q < kNumQuantities; ++q) {
      if (moved) off.value[q] = 1e-15 * std::abs(jet.value[q]);
      if (moved) off.first[q] = 1e-15;
      Nth(value, q) = Real(jet.value[q]) + Real(off.value[q]) * draw.Uniform(-1, 1);
      Nth(rate, q) = Real(jet.first[q]) + Real(off.first[q]) * draw.Uniform(-1, 1);
    }
    Posture posture = SolvePosture(robot, jet.value);
    if (!posture.reachable || !SolveJointSpeeds(robot, jet, &posture)) continue;
    const PostureRounding all = rounding.At(jet, off, posture);
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const size_t s = static_cast<size_t>(Index(side));
      const LegRounding& leg = all.legs[s];
      const ExactLeg exact = SolveExactLeg(robot, side, value, rate, posture.ik[s].q);
      if (!exact.found) {
        tally->Add("not found", 0.0, leg.q.maxCoeff());
        continue;
      }
      for (int j = 0; j < 6; ++j) {
        tally->Add("angle", Difference(Nth(exact.q, j), posture.ik[s].q[j]), leg.q[j]);
        tally->Add("speed", Difference(Nth(exact.speeds, j), posture.speeds[s][j]), leg.speeds[j]);
      }
      tally->Add("reach", Difference(ExactReach(robot, side, exact), posture.ik[s].reach_margin),
                 leg.reach);
      for (const RobotBody& body : robot.bodies) {
        if (body.leg != static_cast<int>(s)) continue;
        const Eigen::Vector3d p = posture.OfBody(body) * body.shape.center;
        const Real3 place =
            PointAt(robot, side, exact, static_cast<size_t>(body.link), body.shape.center, value);
        const Eigen::Vector3d error(Difference(place[0], p.x()), Difference(place[1], p.y()),
                                    Difference(place[2], p.z()));
        tally->Add("point", error.norm(), leg.points);
      }
    }
  }
}

}  // namespace halfstep::oracle
