// Random walks.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/oracle/nasty_draws.h"

namespace halfstep::oracle {

double Draw::Logarithmic(double low, double high) {
  return low * std::pow(high / low, Uniform(0, 1));
}

double NaturalBound(const WalkPlan& plan, size_t i) {
  const double T = plan.durations[i], next = plan.durations[i + 1];
  if (i % 2 == 1) return std::min(T, next);
  const double sigma2 = 0.5 + 0.5 * plan.shift_of(i), sigma1 = 0.5 - 0.5 * plan.shift_of(i + 1);
  return std::min(T - sigma2 * T, sigma1 * next);
}

namespace {

// Every half-step in a form of its own; footsteps that are moved.
void DrawForms(double width, Draw* draw, WalkPlan* plan) {
  const size_t n = plan->durations.size();
  if (draw->Chance(0.6)) {
    for (size_t i = 0; i < n; ++i) {
      if (i % 2 == 0) plan->via_laterals.push_back(plan->via_lateral * draw->Uniform(0.95, 1.1));
      plan->foot_ramps.push_back(draw->Uniform(0.12, 0.5));
      plan->foot_delays.push_back(draw->Uniform(0.03, 0.2));
      plan->lift_shares.push_back(draw->Uniform(0.3, 1));
      if (i % 2 == 0) plan->via_alongs.push_back(draw->Uniform(-0.3, 0.3) * width);
      plan->zmp_shifts.push_back(draw->Logarithmic(0.01, 0.5));
      const double ramps[] = {1, draw->Uniform(0.1, 0.5), draw->Uniform(0.5, 1)};
      plan->zmp_bump_ramps.push_back(ramps[draw->Below(3)]);
    }
  }
  if (draw->Chance(0.5)) {
    for (size_t j = 0; j < n / 2; ++j) {
      plan->footsteps.push_back({draw->Uniform(-0.1, 0.1) * width,
                                 draw->Uniform(-0.05, 0.1) * width, draw->Uniform(-0.1, 0.1)});
    }
  }
}

}  // namespace

WalkPlan DrawPlan(const PlainRobot& robot, Draw* draw) {
  WalkPlan plan;
  FloorPose origin{draw->Uniform(-2, 2), draw->Uniform(-2, 2), draw->Uniform(-3, 3)};
  if (draw->Chance(0.2)) {
    origin.x = draw->Chance(0.5) ? 900 : -900;
    origin.y = draw->Uniform(-900, 900);
    origin.yaw += 2 * std::numbers::pi * (draw->Below(201) - 100);
  }
  const auto beside = [](const FloorPose& s, double x, double y, double yaw) {
    const double c = std::cos(s.yaw), sn = std::sin(s.yaw);
    return FloorPose{s.x + c * x - sn * y, s.y + sn * x + c * y, s.yaw + yaw};
  };
  const double width = robot.standing_width, size = robot.size();
  plan.start = {beside(origin, 0, 0.5 * width, 0), beside(origin, 0, -0.5 * width, 0)};
  std::array<FloorPose, 2> feet = plan.start;
  int foot = draw->Below(2);
  const double stride = draw->Chance(0.2) ? 1.0 : 0.7;  // of what such a robot can do
  for (int k = 1 + draw->Below(3); k > 0; --k, foot = 1 - foot) {
    const double side = foot == 0 ? 1 : -1;
    const double x = size * stride * draw->Uniform(-0.15, 0.25);
    const double y = side * (width + size * stride * draw->Uniform(-0.02, 0.08));
    feet[static_cast<size_t>(foot)] =
        beside(feet[static_cast<size_t>(1 - foot)], x, y, stride * draw->Uniform(-0.25, 0.25));
    const double height = size * draw->Uniform(0.04, 0.22);
    plan.steps.push_back({.foot = foot,
                          .landing = feet[static_cast<size_t>(foot)],
                          .via_height = height,
                          .duration = draw->Uniform(1.2, 2.3)});
  }
  plan.via_lateral = width * draw->Uniform(1.05, 1.25);
  plan.shift = draw->Uniform(0.03, 0.2);
  plan.foot_delay = draw->Uniform(0.02, 0.2);
  plan.com_height = robot.com_height;
  const bool varied = draw->Chance(0.75);
  for (const PlannedStep& step : plan.steps) {
    plan.height_scales.push_back(varied ? draw->Uniform(0.4, 1) : 1);
    for (int k = 0; k < 2; ++k) {
      plan.durations.push_back(step.duration * (varied ? draw->Uniform(0.9, 1.2) : 1));
    }
  }
  for (size_t j = 0; j < plan.steps.size(); ++j) {
    plan.support_points.push_back(varied ? draw->Uniform(-0.05, 0.1) * width : 0);
  }
  if (varied) {
    plan.bump_ramp = draw->Chance(0.5) ? 1 : draw->Uniform(0.15, 0.45);
    plan.foot_ramp = draw->Uniform(0.35, 0.5);
    plan.lift_share = draw->Uniform(0.85, 1);
  }
  if (varied) DrawForms(width, draw, &plan);
  const bool rests = varied && draw->Chance(0.2);
  for (size_t i = 0; i + 1 < plan.durations.size(); ++i) {
    plan.overlaps.push_back(rests && draw->Chance(0.4)
                                ? -draw->Logarithmic(1e-3, 1)
                                : NaturalBound(plan, i) * draw->Uniform(0.3, 1));
  }
  return plan;
}

void Calm(WalkPlan* plan) {
  const auto towards = [](double value, std::vector<double>* values) {
    for (double& v : *values) v = 0.5 * (v + value);
  };
  for (double& T : plan->durations) T *= 1.12;
  for (PlannedStep& step : plan->steps) step.via_height *= 1.15;
  plan->foot_delay = 0.5 * (plan->foot_delay + 0.18);
  towards(0, &plan->support_points);
  towards(plan->via_lateral, &plan->via_laterals);
  towards(0, &plan->via_alongs);
  towards(0.5, &plan->foot_ramps);
  towards(0.18, &plan->foot_delays);
  towards(1, &plan->height_scales);
  towards(1, &plan->lift_shares);
  towards(0.1, &plan->zmp_shifts);
  for (FloorPose& move : plan->footsteps) {
    move = {0.5 * move.x, 0.5 * move.y, 0.5 * move.yaw};
  }
}

}  // namespace halfstep::oracle
