#include "tests/oracle/project_side.h"

#include <filesystem>
#include <fstream>

#include "tests/oracle/plain_files.h"
#include "tests/places.h"
#include "wpg/motion/lipm.h"

namespace halfstep::oracle {
namespace {

Foothold ToFoothold(const FloorPose& p) { return {{p.x, p.y, p.yaw}, p.z}; }

}  // namespace

HalfStepSequence ToSequence(const WalkPlan& plan) {
  std::vector<Footstep> footsteps;
  for (const PlannedStep& step : plan.steps) {
    footsteps.push_back({.side = step.foot == 0 ? Side::kLeft : Side::kRight,
                         .X_WF = ToFoothold(step.landing),
                         .via_height = step.via_height,
                         .duration = step.duration});
  }
  return MakeSequence({ToFoothold(plan.start[0]), ToFoothold(plan.start[1])}, footsteps,
                      plan.via_lateral,
                      {.shift = plan.shift,
                       .foot_delay = plan.foot_delay,
                       .bump_ramp = plan.bump_ramp,
                       .foot_ramp = plan.foot_ramp,
                       .lift_share = plan.lift_share,
                       .crouch = plan.crouch},
                      std::make_shared<Lipm>(plan.com_height));
}

HomotopyParameters ToParameters(const WalkPlan& plan) {
  HomotopyParameters parameters;
  parameters.overlaps = plan.overlaps;
  parameters.height_scales = plan.height_scales;
  parameters.durations = plan.durations;
  parameters.support_points = plan.support_points;
  for (size_t i = 0; i < plan.durations.size(); ++i) {
    if (i % 2 == 0) parameters.of(ParameterFamily::kViaLateral).push_back(plan.via_lateral_of(i));
    if (i % 2 == 0) parameters.of(ParameterFamily::kViaAlong).push_back(plan.via_along_of(i));
    parameters.zmp_shifts.push_back(plan.shift_of(i));
    parameters.of(ParameterFamily::kZmpBumpRamp).push_back(plan.bump_ramp_of(i));
    parameters.of(ParameterFamily::kFootRamp).push_back(plan.foot_ramp_of(i));
    parameters.of(ParameterFamily::kFootDelay).push_back(plan.foot_delay_of(i));
    parameters.of(ParameterFamily::kLiftShare).push_back(plan.lift_share_of(i));
    parameters.of(ParameterFamily::kRiseBegin).push_back(plan.rise_begin_of(i));
    parameters.of(ParameterFamily::kRiseEnd).push_back(plan.rise_end_of(i));
    if (i % 2 == 1) continue;
    const FloorPose move = plan.footsteps.empty() ? FloorPose{} : plan.footsteps[i / 2];
    parameters.footstep_xs.push_back(move.x);
    parameters.footstep_ys.push_back(move.y);
    parameters.footstep_yaws.push_back(move.yaw);
  }
  return parameters;
}

Demands ToDemands(const MarginLimits& limits, double friction) {
  Demands demands;
  for (const MarginFamily family : AllMarginFamilies()) {
    demands.margin[std::string(Name(family))] = limits.demanded_of(family);
  }
  demands.foot_speed = *limits.foot_speed;
  demands.foot_yaw_rate = *limits.foot_yaw_rate;
  demands.landing_speed = *limits.landing_speed;
  demands.joint_speed_scale = limits.joint_speed_scale;
  demands.friction = friction;
  return demands;
}

Tube ToTube(const PlainTube& tube) {
  return {.foot = tube.foot,
          .foot_turn = tube.foot_turn,
          .waist = tube.waist,
          .waist_turn = tube.waist_turn,
          .joint = tube.joint,
          .joint_speed = tube.joint_speed,
          .zmp = tube.zmp};
}

std::string WriteJudgedRobot(const std::string& name, const std::string& folder) {
  const std::filesystem::path robots = InSources("wpg/robots"), into = folder;
  for (const std::string& part : {name, name + ".urdf"}) {
    std::filesystem::create_symlink(robots / part, into / part);
  }
  std::string yaml = ReadPlainFile((robots / (name + ".yaml")).string());
  // HRP-2's efforts are not published: these are for the oracle.
  constexpr std::array<const char*, 6> kEfforts = {"70", "260", "220", "320", "170", "110"};
  for (size_t at = 0; (at = yaml.find("_JOINT", at)) != std::string::npos; ++at) {
    const size_t joint = static_cast<size_t>(yaml[at + 6] - '0');
    if (yaml.compare(at + 7, 6, ": none") == 0) yaml.replace(at + 9, 4, kEfforts.at(joint));
  }
  yaml += "\nacceleration_limits_rad_s2:\n";
  const PlainRobot robot((robots / (name + ".yaml")).string());
  for (const PlainRobot::Leg& leg : robot.legs) {
    for (size_t j = 0; j < leg.joints.size(); j += 2) {
      yaml += "  " + robot.joints[static_cast<size_t>(leg.joints[j])].name + ": 150\n";
    }
  }
  const std::string path = (into / (name + ".yaml")).string();
  std::ofstream(path) << yaml;
  return path;
}

}  // namespace halfstep::oracle
