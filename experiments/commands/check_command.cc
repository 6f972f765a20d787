#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "experiments/checker/check_report.h"
#include "experiments/checker/check_trajectory.h"
#include "experiments/checker/check_walk.h"
#include "experiments/checker/walk_run.h"
#include "experiments/commands/command_line.h"
#include "experiments/commands/command_mistake.h"
#include "experiments/commands/commands.h"
#include "experiments/config/data_folder.h"
#include "experiments/config/experiment.h"
#include "experiments/run/interrupt.h"
#include "experiments/run/progress_bar.h"
#include "wpg/files/input_error.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/robot/robot_fields.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

// A URDF with what a robot file says beside it.
struct GivenRobot {
  UrdfTree urdf;
  std::map<std::string, std::string> packages = {};
  bool dae_up_axis = false;
  std::vector<std::pair<std::string, std::string>> excluded = {};  // links
};

GivenRobot Given(const std::string& robot) {
  if (fs::path(robot).extension() == ".urdf") return {ReadUrdf(robot)};
  ExperimentConfig config;
  config.robot = robot;
  const std::string path = RobotPath(config).string();
  if (!fs::exists(path)) throw InputError({"--robot: " + UnknownRobot(robot)});
  RobotFile file = ReadRobotFile(path, ReadYamlFile(path));
  GivenRobot given{.urdf = std::move(*file.urdf),
                   .packages = std::move(file.packages),
                   .dae_up_axis = file.dae_up_axis == "applied"};
  for (const ExcludedPair& pair : file.excluded) {
    given.excluded.emplace_back(pair.links[0], pair.links[1]);
  }
  return given;
}

checker::JointNames NamesOf(const UrdfTree& urdf) {
  checker::JointNames names;
  for (const UrdfJoint& joint : urdf.joints) {
    if (joint.kind == UrdfJoint::Kind::kRevolute) {
      names.turning.push_back(joint.name);
    } else if (joint.kind == UrdfJoint::Kind::kOther || !joint.faults.empty()) {
      names.others.push_back(joint.name);
    }
  }
  return names;
}

// Sentences on what is not in the statements.
std::vector<std::string> NotLookedAt(const checker::Trajectory& trajectory, const UrdfTree& urdf,
                                     bool has_scene) {
  std::vector<std::string> told;
  std::vector<std::string> still;
  for (const UrdfJoint& joint : urdf.joints) {
    if (joint.kind == UrdfJoint::Kind::kFixed && joint.faults.empty()) continue;
    if (std::ranges::find(trajectory.joints, joint.name) == trajectory.joints.end()) {
      still.push_back(joint.name);
    }
  }
  if (!still.empty())
    told.push_back("joints that stay at 0, for they are not told: " + Joined(still));
  if (!trajectory.unread.empty()) {
    told.push_back("columns that name no joint: " + Joined(trajectory.unread));
  }
  told.push_back("neighbours: links that one joint joins, or fixed ones");
  told.push_back(std::string("that the root moves: it is fixed in the world") +
                 (has_scene ? "" : "; obstacles: there is no --scene"));
  told.push_back("torques, contacts, the floor");
  return told;
}

// The walks of a run's methods.
ExitStatus CheckWalks(const CheckCommand& command) {
  const std::string& run = command.trajectory;
  bool proved = true;
  std::vector<std::pair<std::string, checker::TrajectoryCheck>> checks;
  for (const std::string& method : checker::CertifiedMethods(run, command.method)) {
    const checker::WalkRun walk = checker::ReadWalkRun(run, method, command.robot, command.scene);
    InterruptGuard interrupt;
    std::optional<ProgressBar> bar(std::in_place, "check " + (method.empty() ? "episode" : method),
                                   command.quiet);
    checker::TrajectoryCheck check;
    try {
      check = checker::CheckRun(walk, [&](double done) {
        bar->Update(done);
        return !interrupt.token().stop_requested();
      });
    } catch (const InputError& error) {
      std::vector<std::string> told = error.complaints();
      for (std::string& line : told) line.insert(0, run + ": ");
      throw InputError(told);
    }
    bar.reset();
    if (!command.json && !command.quiet) {
      const std::string place = walk.scene.name == "none" ? "an empty room" : walk.scene.name;
      std::string title = run + (method.empty() ? "" : ", " + method) +
                          Formatted(": %zu half-steps of ", walk.tables.half_steps.size()) +
                          walk.robot.name + " in " + place;
      if (!walk.branches.empty()) {
        title += Formatted(", %zu stop branches", walk.branches.size());
      }
      std::cout << checker::CheckScreen(title, check)
                << Formatted("\n%td intervals of time\n\n", check.intervals);
    }
    if (check.stopped) return kInterrupted;
    proved = proved && check.proved();
    checks.emplace_back(method, std::move(check));
  }
  if (command.json) std::cout << checker::CheckJson(run, checks);
  return proved ? kSuccess : kFailed;
}

}  // namespace

ExitStatus CheckMotion(const CheckCommand& command) {
  if (fs::is_directory(command.trajectory)) return CheckWalks(command);
  if (!fs::exists(command.trajectory)) {
    throw InputError({command.trajectory + ": does not exist (valid: a trajectory, or a run)"});
  }
  if (command.method) throw InputError({"--method: is of runs (valid: the folder of a run)"});
  if (command.robot.empty()) {
    throw InputError({"--robot: is missing (valid: URDF, robot file or shipped robot's name)"});
  }
  GivenRobot given = Given(command.robot);
  const UrdfTree& urdf = given.urdf;
  if (!urdf.warnings.empty()) TellUnder("warnings of the URDF", urdf.warnings);
  const checker::Trajectory trajectory =
      checker::ReadTrajectory(command.trajectory, command.interpolation, NamesOf(urdf));
  Scene scene;
  if (!command.scene.empty()) {
    scene = LoadScene(FileOrShipped(command.scene, "scenes").string());
  }
  for (const auto& [name, folder] : command.packages) given.packages[name] = folder;
  const checker::JointedRobot robot(urdf, given.packages, given.dae_up_axis);
  checker::TrajectoryDemands demands = command.demands;
  demands.ignored.insert(demands.ignored.end(), given.excluded.begin(), given.excluded.end());
  InterruptGuard interrupt;
  std::optional<ProgressBar> bar(std::in_place, "check", command.quiet);
  checker::TrajectoryCheck check =
      checker::CheckTrajectory(trajectory, robot, scene, demands, [&](double done) {
        bar->Update(done);
        return !interrupt.token().stop_requested();
      });
  bar.reset();
  std::vector<std::string> told = NotLookedAt(trajectory, urdf, !command.scene.empty());
  if (!given.excluded.empty()) {
    told.push_back(
        Formatted("%zu pairs of links that the robot file excludes", given.excluded.size()));
  }
  check.not_covered.insert(check.not_covered.end(), told.begin(), told.end());
  if (command.json) {
    std::cout << checker::CheckJson(trajectory, check);
  } else if (!command.quiet) {
    std::cout << checker::CheckScreen(checker::TitleOf(trajectory), check);
  }
  return check.stopped ? kInterrupted : check.proved() ? kSuccess : kFailed;
}

CommandAction DeclareCheck(CLI::App* app, const Toolbox&) {
  const auto command = std::make_shared<CheckCommand>();
  struct Texts {
    std::string interpolation;
    std::vector<std::string> packages, ignored;
  };
  const auto texts = std::make_shared<Texts>();
  app->add_option(
         "TRAJECTORY", command->trajectory,
         "joint trajectory: .csv, or trajectory_msgs/JointTrajectory in .yaml; or the "
         "folder of a run or an episode, of whose walks is proved what is demanded of them")
      ->required();
  app->add_option("--method", command->method,
                  "of a run: its method (default: all that are certified)");
  app->add_option("--robot", command->robot,
                  "of a trajectory: URDF, robot file or shipped robot's name; of a run: where its "
                  "robot file is now");
  app->add_option("--scene", command->scene, "scene file or a shipped scene's name");
  app->add_option("--interpolation", texts->interpolation,
                  "between knots: linear, cubic, quintic (default: by what the file has)")
      ->check(OneOf({"linear", "cubic", "quintic"}));
  app->add_option("--self-clearance", command->demands.self_clearance,
                  "between bodies of the robot [m] (default: 0)")
      ->check(CLI::Range(0.0, 1.0));
  app->add_option("--clearance", command->demands.clearance, "from obstacles [m] (default: 0)")
      ->check(CLI::Range(0.0, 1.0));
  app->add_option("--acceleration", command->demands.acceleration,
                  "of every joint, at most [rad/s²] (default: not asked)")
      ->check(CLI::Range(1e-3, 1e6));
  app->add_option("--ignore", texts->ignored,
                  "LINK=LINK of which no clearance is asked; repeatable")
      ->allow_extra_args(false);
  app->add_option("--package", texts->packages, "NAME=FOLDER of package:// names; repeatable")
      ->allow_extra_args(false);
  app->add_flag("--quiet", command->quiet, "print nothing but errors");
  app->add_flag("--json", command->json, "print JSON");
  return [app, command, texts] {
    for (const char* const option : {"--interpolation", "--self-clearance", "--clearance",
                                     "--acceleration", "--ignore", "--package"}) {
      if (app->count(option) == 0 || !fs::is_directory(command->trajectory)) continue;
      throw InputError({std::string(option) +
                        ": is of trajectories (valid for a run: --method, --robot, --scene)"});
    }
    for (const YamlOverride& package : ParseOverrides(texts->packages, "--package")) {
      command->packages[package.key] = fs::absolute(package.value).lexically_normal().string();
    }
    for (const YamlOverride& pair : ParseOverrides(texts->ignored, "--ignore")) {
      command->demands.ignored.emplace_back(pair.key, pair.value);
    }
    using checker::Interpolation;
    for (const auto one :
         {Interpolation::kLinear, Interpolation::kCubic, Interpolation::kQuintic}) {
      if (texts->interpolation == checker::Name(one)) command->interpolation = one;
    }
    return CheckMotion(*command);
  };
}

}  // namespace halfstep
