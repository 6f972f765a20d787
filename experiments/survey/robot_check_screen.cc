#include "experiments/survey/robot_check_screen.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "experiments/tables/not_covered_json.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

constexpr size_t kMostReasons = 3;  // of why there is no walk

// The limits of one kind that are known of the legs' joints.
struct KnownLimits {
  int known = 0, all = 0;
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
};

KnownLimits KnownLimitsOf(const RobotModel& robot, double LegJoint::*limit) {
  KnownLimits limits;
  for (const Leg& leg : robot.legs) {
    for (const LegJoint& joint : leg.joints) {
      ++limits.all;
      const double value = joint.*limit;
      if (!std::isfinite(value)) continue;
      ++limits.known;
      limits.least = std::min(limits.least, value);
      limits.most = std::max(limits.most, value);
    }
  }
  return limits;
}

std::string KnownText(const KnownLimits& limits, const char* unit) {
  if (limits.known == 0) return "not known";
  const std::string of =
      limits.known == limits.all ? "" : Formatted("%d of %d joints, ", limits.known, limits.all);
  if (limits.least == limits.most) return of + Formatted("%.3g %s", limits.least, unit);
  return of + Formatted("%.3g to %.3g %s", limits.least, limits.most, unit);
}

double Degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

std::string WhatItDoes(const RobotModel& robot, const RobotCheck& check) {
  const SetReach& reach = check.reach;
  std::string text = Formatted(
      "can do, by half-steps of %.3g s whose foot rises %.3g m:\n"
      "  half-steps  %d of %d places of the swing foot keep every margin (sampled)\n",
      check.half_step.duration, check.half_step.via_height, check.half_steps, check.places);
  if (check.half_steps > 0 && !(reach.farthest > 0.0)) {
    text += "  they reach  nothing: none of those farthest out is certified\n";
  } else if (check.half_steps > 0) {
    text += Formatted(
        "  they reach  %.3g m forward, %.3g m backward, %.3g to %.3g m aside, toes %.3g deg in and "
        "%.3g deg out (certified)\n",
        reach.forward, reach.backward, reach.nearest, reach.farthest, Degrees(reach.inwards),
        Degrees(reach.outwards));
  }
  if (check.walk) {
    text += Formatted("  it walks    %.2f m/s: six steps of %.3g m in %.2f s, %s (certified)\n",
                      check.walk->speed(), check.walk->stride, check.walk->duration,
                      check.walk->method.c_str());
  } else {
    text += "  it walks    not: six steps straight ahead are not certified; worst first:\n";
    for (size_t i = 0; i < std::min(kMostReasons, check.why_no_walk.size()); ++i) {
      text += "                " + check.why_no_walk[i] + "\n";
    }
  }
  if (check.bar) {
    text += Formatted(
        "  it passes   a bar %.3g cm high and %.2g cm thick, by a step of %.3g m (certified)\n",
        100 * check.bar->height, 100 * check.bar->thickness, check.bar->stride);
  } else {
    text +=
        "  it passes   no bar: of those that were tried over its longest step none is certified\n";
  }
  if (check.stairs) {
    const Flight& flight = check.stairs->flight;
    text += Formatted(
        "  it climbs   stairs of %.3g cm at treads of %.3g cm, up and down, foot over foot "
        "(certified)\n",
        100 * flight.rise, 100 * flight.run);
  } else {
    text += Formatted(
        "  it climbs   no stairs at treads of %.3g cm, of the rises from %.2g cm that were tried\n",
        100.0 * UsualRun(robot), 100.0 * LeastRise(robot));
    if (check.reach.stride < UsualRun(robot)) {
      text +=
          Formatted("              (its longest step is %.3g cm)\n", 100.0 * check.reach.stride);
    }
  }
  return text + Formatted("  it lifts    a foot %.3g m, as far as the joints' limits let it\n",
                          check.measures.lift);
}

}  // namespace

std::string RobotCheckScreen(const RobotModel& robot, const RobotCheck& check) {
  const RobotMeasures& measures = check.measures;
  std::string text =
      robot.name +
      Formatted(": %.4g kg, leg %.3f m, stance %.3f m, CoM %.3f m high\n", robot.mass,
                measures.leg_length, measures.standing_width, robot.com_height) +
      "known:\n  legs        " +
      (robot.legs[0].closed_form() ? "hip axes through one point, ankle axes through one point"
                                   : robot.legs[0].offsets) +
      "\n  torques     " + KnownText(KnownLimitsOf(robot, &LegJoint::max_torque), "N m") +
      "\n  speeds      " + KnownText(KnownLimitsOf(robot, &LegJoint::max_speed), "rad/s") +
      "\n  accel.      " + KnownText(KnownLimitsOf(robot, &LegJoint::max_acceleration), "rad/s²") +
      "\n  masses      " + (robot.masses.known() ? "of every link" : robot.masses.fault) +
      Formatted("\n  bodies      %zu; %zu pairs of them are watched, %zu are not\n",
                robot.bodies.size(), robot.self_pairs.size(), robot.unwatched_pairs.size());
  text += NotCoveredText(check.not_covered, "--json");
  return text + WhatItDoes(robot, check);
}

std::string RobotCheckJson(const RobotModel& robot, const RobotCheck& check) {
  using Json = nlohmann::ordered_json;
  const auto limits = [&](double LegJoint::*limit) -> Json {
    const KnownLimits of = KnownLimitsOf(robot, limit);
    if (of.known == 0) return nullptr;
    return {{"joints", of.known}, {"of", of.all}, {"least", of.least}, {"most", of.most}};
  };
  Json json = {
      {"robot", robot.name},
      {"mass_kg", robot.mass},
      {"leg_m", check.measures.leg_length},
      {"stance_m", check.measures.standing_width},
      {"com_m", robot.com_height},
      {"known",
       {{"closed_form", robot.legs[0].closed_form()},
        {"offsets", robot.legs[0].offsets},
        {"torque_n_m", limits(&LegJoint::max_torque)},
        {"speed_rad_s", limits(&LegJoint::max_speed)},
        {"acceleration_rad_s2", limits(&LegJoint::max_acceleration)},
        {"masses", robot.masses.known()},
        {"bodies", robot.bodies.size()},
        {"pairs_watched", robot.self_pairs.size()},
        {"pairs_unwatched", robot.unwatched_pairs.size()}}},
      {"not_covered", NotCoveredJson(check.not_covered)},
      {"half_step",
       {{"duration_s", check.half_step.duration}, {"via_height_m", check.half_step.via_height}}},
      {"half_steps", {{"places", check.places}, {"keep_sampled", check.half_steps}}},
      {"reach",
       {{"forward_m", check.reach.forward},
        {"backward_m", check.reach.backward},
        {"nearest_m", check.reach.nearest},
        {"farthest_m", check.reach.farthest},
        {"toes_in_rad", check.reach.inwards},
        {"toes_out_rad", check.reach.outwards},
        {"stride_m", check.reach.stride}}},
      {"walk", nullptr},
      {"why_no_walk", check.why_no_walk},
      {"bar", nullptr},
      {"stairs", nullptr},
      {"lift_m", check.measures.lift}};
  if (check.walk) {
    json["walk"] = {{"speed_m_s", check.walk->speed()},
                    {"stride_m", check.walk->stride},
                    {"duration_s", check.walk->duration},
                    {"method", check.walk->method}};
  }
  if (check.bar) {
    json["bar"] = {{"height_m", check.bar->height},
                   {"thickness_m", check.bar->thickness},
                   {"stride_m", check.bar->stride}};
  }
  if (check.stairs) {
    const HalfStepConfig& form = check.stairs->half_step;
    json["stairs"] = {{"rise_m", check.stairs->flight.rise},
                      {"run_m", check.stairs->flight.run},
                      {"duration_s", form.duration},
                      {"via_height_m", form.via_height},
                      {"foot_delay", form.foot_delay},
                      {"crouch_m", form.crouch},
                      {"lift_share", form.lift_share},
                      {"rise_begin", form.rise_begin},
                      {"rise_end", form.rise_end}};
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace halfstep
