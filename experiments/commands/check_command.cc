#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "experiments/checker/check_place.h"
#include "experiments/checker/check_report.h"
#include "experiments/checker/proof_file.h"
#include "experiments/checker/walk_run.h"
#include "experiments/commands/command_line.h"
#include "experiments/commands/command_mistake.h"
#include "experiments/commands/commands.h"
#include "experiments/run/interrupt.h"
#include "experiments/run/progress_bar.h"
#include "experiments/verify/csv_text.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/files/whole_file.h"
#include "wpg/robot/robot_fields.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

// LINK, or LINK:FROM..TO in seconds.
checker::TrajectoryDemands::Contact ContactOf(const std::string& text) {
  const size_t colon = text.rfind(':'), dots = text.rfind("..");
  if (colon == std::string::npos) return {text};
  const auto number = [&](size_t begin, size_t end) {
    const NumberText read =
        begin < end ? ParseNumber(text.substr(begin, end - begin)) : NumberText();
    if (dots == std::string::npos || dots < colon || read.kind != NumberText::Kind::kNumber) {
      throw InputError({"--contact: " + Quote(text) + " (valid: LINK or LINK:FROM..TO, seconds)"});
    }
    return read.value;
  };
  return {text.substr(0, colon), number(colon + 1, dots), number(dots + 2, text.size())};
}

// Of a run's walk, or of one that a proof's file has; shows what was found.
checker::TrajectoryCheck CheckOne(const CheckCommand& command, const std::string& method,
                                  const checker::WalkRun& walk, checker::ProofHints* hints) {
  const std::string& from = command.trajectory;
  InterruptGuard interrupt;
  std::optional<ProgressBar> bar(std::in_place, "check " + (method.empty() ? "episode" : method),
                                 command.quiet);
  checker::TrajectoryCheck check;
  try {
    check = checker::CheckRun(
        walk,
        [&](double done) {
          bar->Update(done);
          return !interrupt.token().stop_requested();
        },
        hints);
  } catch (const InputError& error) {
    std::vector<std::string> told = error.complaints();
    for (std::string& line : told) line.insert(0, from + ": ");
    throw InputError(told);
  }
  bar.reset();
  if (!command.json && !command.quiet) {
    const bool empty = walk.scene.obstacles.empty() && walk.scene.no_step.empty() &&
                       walk.scene.ground->OnlyLevel();
    std::string title = from + (method.empty() ? "" : ", " + method) +
                        Formatted(": %zu half-steps of ", walk.tables.half_steps.size()) +
                        walk.robot.name + " in " + (empty ? "an empty room" : walk.scene.name);
    if (!walk.branches.empty()) title += Formatted(", %zu stop branches", walk.branches.size());
    std::cout << checker::CheckScreen(title, check)
              << Formatted("\n%td intervals of time\n\n", check.intervals);
  }
  return check;
}

// The walks of a run's methods; `proof_file`: where the proof is written, or "".
ExitStatus CheckWalks(const CheckCommand& command, const std::string& proof_file) {
  const std::string& run = command.trajectory;
  bool proved = true;
  std::vector<std::pair<std::string, checker::TrajectoryCheck>> checks;
  const std::vector<std::string> methods = checker::CertifiedMethods(run, command.method);
  if (!proof_file.empty() && methods.size() > 1) {
    throw InputError({"--proof: is of one walk (valid with --method: " + Joined(methods) + ")"});
  }
  for (const std::string& method : methods) {
    if (!proof_file.empty() && method.empty()) {
      throw InputError({"--proof: is of runs (valid: the folder of a run)"});
    }
    checker::ProofFile proof;
    proof.walk = checker::ReadWalkRun(run, method, command.robot, command.scene);
    proof.run = fs::path(run).lexically_normal().filename().string();
    proof.method = method;
    checker::TrajectoryCheck check = CheckOne(command, method, proof.walk, &proof.hints);
    if (check.stopped) return kInterrupted;
    proved = proved && check.proved();
    if (!proof_file.empty() && proved) {
      std::vector<std::string> not_covered = check.not_covered;
      if (!proof.walk.branches.empty()) {
        not_covered.emplace_back("stop branches, which config.yaml demands");
      }
      WriteWhole(proof_file, {checker::ProofText(proof, not_covered)});
    }
    checks.emplace_back(method, std::move(check));
  }
  if (command.json) std::cout << checker::CheckJson(run, checks);
  return proved ? kSuccess : kFailed;
}

// The walk of a proof's file.
ExitStatus CheckProof(const CheckCommand& command) {
  const std::string& file = command.trajectory;
  if (!command.robot.empty() || !command.scene.empty()) {
    throw InputError({file + ": has robot and scene (valid without --robot and --scene)"});
  }
  checker::ProofFile proof = checker::ReadProof(file, verify::ReadBytes(file));
  checker::TrajectoryCheck check = CheckOne(command, proof.method, proof.walk, &proof.hints);
  if (check.stopped) return kInterrupted;
  const bool proved = check.proved();
  if (command.json) std::cout << checker::CheckJson(file, {{proof.method, std::move(check)}});
  return proved ? kSuccess : kFailed;
}

ExitStatus CheckAny(const CheckCommand& command, const std::string& proof_file) {
  if (fs::is_directory(command.trajectory)) return CheckWalks(command, proof_file);
  if (!fs::exists(command.trajectory)) {
    throw InputError({command.trajectory + ": does not exist (" +
                      DidYouMeanRun(command.trajectory) +
                      "valid: a trajectory, a run or a proof)"});
  }
  if (!proof_file.empty()) throw InputError({"--proof: is of runs (valid: the folder of a run)"});
  if (command.method) throw InputError({"--method: is of runs (valid: the folder of a run)"});
  if (fs::path(command.trajectory).extension() == ".json") return CheckProof(command);
  if (command.robot.empty()) {
    throw InputError({"--robot: is missing (valid: URDF, robot file or shipped robot's name)"});
  }
  const checker::CheckPlace place =
      checker::ReadCheckPlace(command.robot, command.scene, command.packages);
  const UrdfTree& urdf = place.robot.urdf();
  if (!urdf.warnings.empty()) TellUnder("warnings of the URDF", urdf.warnings);
  const checker::Trajectory trajectory =
      checker::ReadTrajectory(command.trajectory, command.interpolation, checker::NamesOf(urdf));
  InterruptGuard interrupt;
  std::optional<ProgressBar> bar(std::in_place, "check", command.quiet);
  checker::TrajectoryCheck check =
      checker::CheckIn(place, trajectory, command.demands, [&](double done) {
        bar->Update(done);
        return !interrupt.token().stop_requested();
      });
  bar.reset();
  if (command.json) {
    std::cout << checker::CheckJson(trajectory, check);
  } else if (!command.quiet) {
    std::cout << checker::CheckScreen(checker::TitleOf(trajectory), check);
  }
  return check.stopped ? kInterrupted : check.proved() ? kSuccess : kFailed;
}

}  // namespace

ExitStatus CheckMotion(const CheckCommand& command) { return CheckAny(command, ""); }

CommandAction DeclareCheck(CLI::App* app, const Toolbox&) {
  const auto command = std::make_shared<CheckCommand>();
  struct Texts {
    std::string interpolation, proof;
    std::vector<std::string> packages, ignored, contacts;
  };
  const auto texts = std::make_shared<Texts>();
  app->add_option("TRAJECTORY", command->trajectory,
                  "joint trajectory: .csv, or trajectory_msgs/JointTrajectory in .yaml; or the "
                  "folder of a run or an episode, of whose walks is proved what is demanded of "
                  "them; or the file that --proof wrote of such a walk")
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
  app->add_option("--ground", command->demands.ground,
                  "no body lower below the floor z = 0 than this [m] (default: not asked)")
      ->check(CLI::Range(0.0, 10.0));
  app->add_option("--contact", texts->contacts,
                  "LINK or LINK:FROM..TO [s], which stands still there; repeatable")
      ->allow_extra_args(false);
  app->add_option(
         "--contact-distance", command->demands.contact_distance,
         "by which a contact may move from where it begins, and points of its sole be higher "
         "than the lowest one [m] (default: 0.001)")
      ->check(CLI::Range(0.0, 10.0));
  app->add_option("--contact-angle", command->demands.contact_angle,
                  "by which a contact may turn from where it begins [rad] (default: 0.01)")
      ->check(CLI::Range(0.0, 3.0));
  app->add_option("--zmp", command->demands.zmp,
                  "the ZMP is inside of the soles that are claimed to stand by this [m] (default: "
                  "not asked)")
      ->check(CLI::Range(0.0, 1.0));
  app->add_option("--friction", command->demands.friction,
                  "coefficient that suffices under these soles (default: not asked)")
      ->check(CLI::Range(0.0, 100.0));
  app->add_option("--ignore", texts->ignored,
                  "LINK=LINK of which no clearance is asked; repeatable")
      ->allow_extra_args(false);
  app->add_option("--package", texts->packages, "NAME=FOLDER of package:// names; repeatable")
      ->allow_extra_args(false);
  app->add_option("--proof", texts->proof,
                  "of a run: file to write for who has neither its robot nor its scene (.json)");
  app->add_flag("--quiet", command->quiet, "print nothing but errors");
  app->add_flag("--json", command->json, "print JSON");
  return [app, command, texts] {
    for (const char* const option :
         {"--interpolation", "--self-clearance", "--clearance", "--acceleration", "--ground",
          "--contact", "--contact-distance", "--contact-angle", "--zmp", "--friction", "--ignore",
          "--package"}) {
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
    for (const std::string& text : texts->contacts) {
      command->demands.contacts.push_back(ContactOf(text));
    }
    using checker::Interpolation;
    for (const auto one :
         {Interpolation::kLinear, Interpolation::kCubic, Interpolation::kQuintic}) {
      if (texts->interpolation == checker::Name(one)) command->interpolation = one;
    }
    return CheckAny(*command, texts->proof);
  };
}

}  // namespace halfstep
