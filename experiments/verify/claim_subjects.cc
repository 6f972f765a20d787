#include "experiments/verify/claim_subjects.h"

#include <charconv>
#include <string_view>

#include "wpg/nth.h"

namespace halfstep::verify {
namespace {

// "half-step 3": 2.
std::optional<ClaimSubject> HalfStepNamed(const std::string& name) {
  constexpr std::string_view kBefore = "half-step ";
  if (!name.starts_with(kBefore)) return std::nullopt;
  int number = 0;
  const char* const end = name.data() + name.size();
  const auto [rest, error] = std::from_chars(name.data() + kBefore.size(), end, number);
  if (error != std::errc() || rest != end || number < 1) return std::nullopt;
  return ClaimSubject{number - 1, -1};
}

}  // namespace

ClaimSubjects::ClaimSubjects(const RobotModel& robot, const Distances& distances) {
  auto& subjects = subjects_;
  for (int s = 0; s < 2; ++s) {
    const std::string side = s == 0 ? "left" : "right";
    for (Family f : {kFloor, kFootSpeed, kFootYawRate, kLandingSpeed, kFoothold}) {
      subjects[f][side + " foot"] = {s, -1};
    }
    subjects[kReach][side + " leg"] = {s, 0};
    for (int j = 0; j < 6; ++j) {
      const std::string& name = Nth(Nth(robot.legs, s).joints, j).name;
      subjects[kJoint][name] = subjects[kJointSpeed][name] = subjects[kTorque][name] = {s, j};
      subjects[kJointAcceleration][name] = {s, j};
    }
    subjects[kNoStep][side + " foot"] = {s, -1};
    for (size_t a = 0; a < distances.scene().no_step.size(); ++a) {
      subjects[kNoStep][side + " foot - no_step[" + std::to_string(a) + "]"] = {
          s, static_cast<int>(a)};
    }
  }
  for (Family f : {kFloor, kFootSpeed, kFootYawRate, kLandingSpeed}) {
    subjects[f]["both feet"] = {};
  }
  subjects[kDoubleSupport]["no half-step"] = {};
  subjects[kGround]["robot"] = {};
  for (Family f : {kZmp, kZmpRobot, kFriction}) {
    subjects[f]["both soles"] = subjects[f]["support sole"] = {};
  }
  for (size_t b = 0; b < distances.num_bodies(); ++b) {
    const int body = static_cast<int>(b);
    subjects[kClearance][robot.bodies[b].name] = {body, -1};
    subjects[kGround][robot.bodies[b].name] = {body, 0};
    bodies_.push_back(robot.bodies[b].name);
  }
  num_of_scene_ = static_cast<int>(distances.scene().obstacles.size());
  for (int i = 0; i < static_cast<int>(distances.num_obstacles()); ++i) {
    obstacles_[distances.scene().NameOf(i)] = i;
  }
  for (const auto& [a, b] : robot.self_pairs) {
    subjects[kSelfClearance][distances.NameOfPair(static_cast<size_t>(a), static_cast<size_t>(b))] =
        {a, b};
  }
}

std::optional<ClaimSubject> ClaimSubjects::Find(Family family, const std::string& name) const {
  const auto found = subjects_[family].find(name);
  if (found != subjects_[family].end()) return found->second;
  if (family == kDoubleSupport) return HalfStepNamed(name);
  const bool of_foot = family == kFloor || family == kFoothold;
  if (family != kClearance && !of_foot) return std::nullopt;
  const std::vector<std::string> feet = {"left foot", "right foot"};
  const std::vector<std::string>& firsts = of_foot ? feet : bodies_;
  for (size_t b = 0; b < firsts.size(); ++b) {
    const std::string before = firsts[b] + " - ";
    if (!name.starts_with(before)) continue;
    const auto obstacle = obstacles_.find(name.substr(before.size()));
    if (obstacle == obstacles_.end() || (of_foot && obstacle->second < num_of_scene_)) continue;
    return ClaimSubject{static_cast<int>(b), obstacle->second};
  }
  return std::nullopt;
}

}  // namespace halfstep::verify
