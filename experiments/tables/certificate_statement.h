#pragma once

#include <string>
#include <string_view>

#include "smoothing/margins/margin.h"
#include "wpg/ground/ground.h"
#include "wpg/robot/acceleration_limits.h"

namespace halfstep {

/// What a certificate guarantees, for which file, with which δ, and what not; the same words in
/// smoothing/README.md, "The statement". `halfstep verify` accepts no others.
inline constexpr char kCertificateStatement[] =
    "Guaranteed for every instant of the walk whose overlaps stand in overlaps.csv, not only for "
    "sampled ones: every margin of certificate.json (height of the moving sole, speed and yaw "
    "rate of the swing foot, ZMP of the linear inverted pendulum inside the support polygon, leg "
    "reach, joint limits, joint speeds, clearance between the robot's own bodies, clearance to the "
    "obstacles of the scene, "
    "height above the floor of every body, which a foot may touch, distance of the soles that "
    "stand from the no-step areas of the scene, ZMP of the whole robot, with the masses and "
    "inertias of all links, inside the support polygon, torque of each leg joint whose limit is "
    "known, where two feet that stand share the load as wpg/README.md says, friction coefficient "
    "of the scene beyond what the soles need) is at least the delta demanded there; "
    "where that is null, nothing is said of this margin. What is not covered, each with the "
    "reason, "
    "stands in not_covered: families of which nothing is demanded, limits that are not known or "
    "placeholders, values that are assumed, mass without bodies, pairs of bodies that are not "
    "watched. "
    "trajectory.csv samples that walk; `halfstep verify` checks, without the smoothing code, the "
    "motion that interpolates its rows linearly, with the same deltas less its tolerance. Not "
    "guaranteed: what is listed under not_covered, that robot and "
    "scene are as their files describe them, that a controller tracks the motion, and any "
    "dynamics beyond these two ZMPs, torques and friction.";

/// What it says more where motions within a tube are certified, too.
inline constexpr char kTubeStatement[] =
    "The same holds, with what was demanded before `tube` raised it, of every motion that at every "
    "instant stays within that tube of the walk (the centre of each sole within foot_m of its "
    "place, turned by at most foot_rad; the waist within waist_m, turned by at most waist_rad; "
    "each "
    "joint of the legs within joint_rad), with all other joints and the instants of contact as "
    "planned, in floor, joint, self_clearance, clearance, ground, no_step, where the speeds of the "
    "legs' joints are within joint_speed_rad_s in joint_speed, and where the ZMP of the whole "
    "robot "
    "is within zmp_m in zmp_robot: of all other "
    "margins (those of the pendulum, reach, foot speeds, torques, friction, joint accelerations) "
    "nothing is said beyond the walk itself. Margins of self_clearance and clearance are less by "
    "what the tube can take from that pair or body. ";

/// What the pendulum's ZMP is inside of, in place of the support polygon, where soles may stand at
/// different heights.
inline constexpr char kPendulumOnLevels[] =
    "hull of the soles that stand as it is seen from above, which is said of the plan alone";
/// What the robot's is inside of.
inline constexpr char kRobotOnLevels[] =
    "hull of the shadows that the soles that stand cast along the floor's force";

/// What a statement speaks of only where a config asks for it, or the ground is not flat.
struct StatedOnRequest {
  bool double_support = false;  ///< whether it is demanded
  bool landing_speed = false;   ///< whether there is a limit
  bool tube = false;            ///< whether it holds in a tube
  bool levels = false;          ///< whether the ground has more levels than one, or borders
};

/// The same for a robot and what is demanded of its walks: where its joint accelerations have
/// limits, these are named, too, and so is what a config has to ask for.
inline std::string CertificateStatement(const RobotModel& robot, const StatedOnRequest& stated) {
  std::string statement = kCertificateStatement;
  const auto insert = [&statement](const char* before, const char* words) {
    statement.insert(statement.find(before), words);
  };
  if (HasAccelerationLimits(robot)) {
    insert("clearance between", robot.assumed_acceleration
                                    ? "joint accelerations, whose limits are assumed where the "
                                      "robot file states none, "
                                    : "joint accelerations where the robot file limits them, ");
  }
  if (stated.levels) {
    constexpr std::string_view kPolygon = "support polygon";
    for (const char* words : {kPendulumOnLevels, kRobotOnLevels}) {
      statement.replace(statement.find(kPolygon), kPolygon.size(), words);
    }
  }
  if (stated.tube) insert("What is not covered", kTubeStatement);
  if (stated.landing_speed) {
    insert("ZMP of the linear", "how fast the swing foot sinks in its last centimetre, ");
  }
  if (stated.levels) {
    insert("ZMP of the whole robot, with",
           "how far inside one level of the ground the outline of every sole that stands lies, ");
  }
  if (stated.double_support) {
    insert(") is at least", ", how long the ZMP of each half-step goes from foot to foot");
  }
  return statement;
}
/// By its limits and demands, and where it walks.
inline std::string CertificateStatement(const RobotModel& robot, const MarginLimits& limits,
                                        const Ground& ground) {
  return CertificateStatement(
      robot, {.double_support = limits.demanded_of(MarginFamily::kDoubleSupport) != kNotDemanded,
              .landing_speed = limits.landing_speed.has_value(),
              .tube = limits.tube != Tube{},
              .levels = !ground.OnlyLevel()});
}

}  // namespace halfstep
