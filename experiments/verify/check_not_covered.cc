#include "experiments/verify/check_not_covered.h"

#include <algorithm>
#include <string>

#include "experiments/verify/robot_numbers.h"
#include "wpg/files/text.h"
#include "wpg/robot/torque_limits.h"

namespace halfstep::verify {
namespace {

constexpr double kAssumedFriction = 0.7;  // of a scene that states none

// Why the robot's files do not let anything be demanded of a family; "": they do.
std::string WhyUnknown(Family family, const RobotModel& robot) {
  if (IsOfDynamics(family) && !robot.masses.known()) return robot.masses.fault;
  if (family == kTorque) return TorqueFault(robot);
  if (family != kJointAcceleration || LimitsAccelerations(robot)) return "";
  return "the robot file states no limits (`acceleration_limits_rad_s2`)";
}

bool HasNoLimit(Family family, const CertificateText& certificate) {
  return (family == kFootSpeed && !certificate.foot_speed) ||
         (family == kFootYawRate && !certificate.foot_yaw_rate);
}

}  // namespace

std::vector<NotCovered> FindNotCovered(const CertificateText& certificate, const RobotModel& robot,
                                       const Scene& scene) {
  std::vector<NotCovered> found;
  for (size_t f = 0; f < kNumFamilies; ++f) {
    const auto family = static_cast<Family>(f);
    // Where these are there something is demanded of them, or a limit is asked for.
    if (family == kOwn || family == kDoubleSupport || family == kLandingSpeed ||
        family == kFoothold) {
      continue;
    }
    const std::string unknown = WhyUnknown(family, robot);
    if (!unknown.empty() || certificate.demanded[f] == kNotDemanded) {
      found.push_back(
          NotDemandedFamily(kFamilyNames[f], unknown.empty() ? "the config says none" : unknown));
    } else if (HasNoLimit(family, certificate)) {
      found.push_back(UnlimitedFamily(kFamilyNames[f]));
    }
  }
  if (WhyUnknown(kFriction, robot).empty() && certificate.demanded[kFriction] != kNotDemanded &&
      scene.friction == kAssumedFriction) {
    found.push_back(AssumedFriction(scene.friction));
  }
  if (robot.assumed_acceleration && certificate.demanded[kJointAcceleration] != kNotDemanded) {
    found.push_back(AssumedAccelerations(*robot.assumed_acceleration));
  }
  const std::vector<NotCovered> of_robot = NotCoveredOf(robot);
  found.insert(found.end(), of_robot.begin(), of_robot.end());
  return found;
}

void CheckNotCovered(const std::string& file, const std::vector<NotCoveredItem>& listed,
                     const std::vector<NotCovered>& found, Findings* findings) {
  std::vector<NotCoveredItem> items;
  for (const NotCovered& one : found) {
    items.push_back({std::string(Name(one.kind)), one.subject, one.sentence});
  }
  findings->Say("what is not covered, against the list of " + file + ": " +
                Count(std::ssize(items)) + (items.size() == 1 ? " thing" : " things"));
  if (listed == items) return;
  size_t i = 0;
  while (i < std::min(listed.size(), items.size()) && listed[i] == items[i]) ++i;
  const auto at = [i](const std::vector<NotCoveredItem>& list) {
    return i < list.size() ? list[i].kind + " " + Quote(list[i].sentence)
                           : std::string("nothing more");
  };
  findings->Disagree("not_covered: " + file + " has " + at(listed) + ", found was " + at(items));
}

}  // namespace halfstep::verify
