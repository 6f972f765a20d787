#include "experiments/checker/check_place.h"

#include <algorithm>
#include <filesystem>

#include "experiments/config/data_folder.h"
#include "experiments/config/experiment.h"
#include "wpg/files/input_error.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/robot/robot_fields.h"

namespace halfstep::checker {
namespace {

namespace fs = std::filesystem;

// Sentences on what is not in the statements.
std::vector<std::string> NotLookedAt(const CheckPlace& place, const Trajectory& trajectory) {
  std::vector<std::string> told, still;
  for (const UrdfJoint& joint : place.robot.urdf().joints) {
    if (joint.kind == UrdfJoint::Kind::kFixed && joint.faults.empty()) continue;
    if (std::ranges::find(trajectory.joints, joint.name) == trajectory.joints.end()) {
      still.push_back(joint.name);
    }
  }
  if (!still.empty()) {
    told.push_back("joints that stay at 0, for they are not told: " + Joined(still));
  }
  if (!trajectory.unread.empty()) {
    told.push_back("columns that name no joint: " + Joined(trajectory.unread));
  }
  told.push_back("neighbours: links that one joint joins, or fixed ones");
  if (trajectory.base.size() == 0) told.push_back("that the root moves: it is fixed in the world");
  if (!place.has_scene) told.push_back("obstacles: there is no --scene");
  if (!place.excluded.empty()) {
    told.push_back(
        Formatted("%zu pairs of links that the robot file excludes", place.excluded.size()));
  }
  return told;
}

}  // namespace

CheckPlace ReadCheckPlace(const std::string& robot, const std::string& scene,
                          const std::map<std::string, std::string>& packages) {
  std::vector<std::pair<std::string, std::string>> excluded;
  const auto read = [&] {
    if (fs::path(robot).extension() == ".urdf") return JointedRobot(ReadUrdf(robot), packages);
    ExperimentConfig config;
    config.robot = robot;
    const std::string path = RobotPath(config).string();
    if (!fs::exists(path)) throw InputError({"--robot: " + UnknownRobot(robot)});
    RobotFile file = ReadRobotFile(path, ReadYamlFile(path));
    for (const ExcludedPair& pair : file.excluded) {
      excluded.emplace_back(pair.links[0], pair.links[1]);
    }
    for (const auto& [name, folder] : packages) file.packages[name] = folder;
    return JointedRobot(std::move(*file.urdf), file.packages, file.dae_up_axis == "applied");
  };
  CheckPlace place{.robot = read(), .has_scene = !scene.empty(), .excluded = {}};
  place.excluded = std::move(excluded);
  if (place.has_scene) place.scene = LoadScene(FileOrShipped(scene, "scenes").string());
  return place;
}

TrajectoryCheck CheckIn(const CheckPlace& place, const Trajectory& trajectory,
                        TrajectoryDemands demands,
                        const std::function<bool(double done)>& progress) {
  demands.ignored.insert(demands.ignored.end(), place.excluded.begin(), place.excluded.end());
  TrajectoryCheck check = CheckTrajectory(trajectory, place.robot, place.scene, demands, progress);
  for (std::string& line : NotLookedAt(place, trajectory)) {
    check.not_covered.push_back(std::move(line));
  }
  return check;
}

}  // namespace halfstep::checker
