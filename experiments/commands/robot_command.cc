#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/run/experiment_run.h"
#include "experiments/run/infeasible_plan.h"
#include "experiments/run/interrupt.h"
#include "experiments/run/progress_bar.h"
#include "experiments/run/run_screen.h"
#include "experiments/survey/rest_torques.h"
#include "experiments/survey/robot_picture.h"
#include "experiments/survey/robot_survey.h"
#include "experiments/survey/starter_config.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/files/whole_file.h"
#include "wpg/nth.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

// The files that the command writes.
struct RobotFiles {
  fs::path robot, picture, walk;
};

RobotFiles FilesOf(const RobotCommand& command) {
  fs::path robot = command.out.value_or(
      (command.survey.name.empty() ? command.survey.urdf.stem().string() : command.survey.name) +
      ".yaml");
  if (robot.extension() != ".yaml") {
    throw InputError({"--out " + robot.string() + ": no robot file (valid: a name in .yaml)"});
  }
  RobotFiles files{robot, robot, robot};
  files.picture.replace_extension(".svg");
  files.walk.replace_filename(robot.stem().string() + "_six_steps.yaml");
  if (command.overwrite) return files;
  for (const fs::path& path : {files.robot, files.picture, files.walk}) {
    if (fs::exists(path)) {
      throw InputError({path.string() + ": is there already (--overwrite replaces it)"});
    }
  }
  return files;
}

void Tell(const RobotDraft& draft, const RobotModel& robot) {
  const RobotMeasures measures = MeasuresOf(robot);
  const Leg& leg = robot.legs[0];
  std::cout << robot.name << ": six revolute joints a leg, "
            << (leg.closed_form()
                    ? "hip axes through one point, ankle axes through one point"
                    : leg.offsets + "; joint angles by continuation from a closed form")
            << '\n'
            << Formatted(
                   "  leg %.3f m, stance %.3f m, CoM %.3f m high, %.2f kg, sole %.3f x %.3f m, "
                   "%zu bodies, %zu pairs watched, %zu not\n",
                   measures.leg_length, measures.standing_width, robot.com_height, robot.mass,
                   robot.sole_size.x(), robot.sole_size.y(), robot.bodies.size(),
                   robot.self_pairs.size(), robot.unwatched_pairs.size());
  for (const std::string& joint : draft.legs.beyond) {
    std::cout << "  " << joint << " is beyond the sixth joint: it is held still\n";
  }
  for (const auto& [joint, why] : draft.why_posture) {
    std::cout << "  " << Nth(draft.urdf.joints, joint).name << ": " << why << '\n';
  }
  for (const ExcludedPair& pair : draft.excluded) {
    std::cout << "  " << pair.links[0] << " - " << pair.links[1] << " is not watched: " << pair.why
              << '\n';
  }
}

void WriteWalk(const RobotModel& robot, const RobotFiles& files, const std::string& why_search) {
  WriteWhole(files.walk, {StarterConfigText(robot, {.robot_file = files.robot.filename().string(),
                                                    .why_search = why_search})});
}

// Runs the config of six steps, with proofs.
std::unique_ptr<ExperimentRun> WalkSixSteps(const RobotFiles& files, bool quiet,
                                            const InterruptGuard& interrupt) {
  ProgressBar bar("six steps", quiet);
  const RunHooks hooks{.progress = [&bar](const std::string&, double done) { bar.Update(done); },
                       .stop = interrupt.token()};
  auto run = std::make_unique<ExperimentRun>(LoadConfig(files.walk.string(), {}), hooks);
  run->Smooth(hooks);
  run->Explain(interrupt.token());
  run->Certify(interrupt.token());
  return run;
}

// What the robot cannot do, where half-steps from rest to rest are not feasible, as a sentence
// without its subject; "": they are, or it is not known.
std::string WhyNoRest(const ExperimentRun& run) {
  if (run.runs().front().result.feasible || run.infeasible().empty()) return "";
  const std::vector<MissedDemand>& demands = run.infeasible().front().missed.demands;
  if (demands.empty()) return "";
  const Margin& worst = demands.front().worst;
  if (worst.family != MarginFamily::kTorque) {
    return "cannot make one half-step after the other: " +
           run.problem().evaluator().Describe(worst);
  }
  const Leg& leg = Nth(run.experiment().robot.legs, worst.subject / 6);
  const LegJoint& joint = Nth(leg.joints, worst.subject % 6);
  return Formatted(
      "is too weak for one half-step after the other: %s would need %.3g of its %.3g N m",
      joint.name.c_str(), joint.max_torque - worst.value, joint.max_torque);
}

// Walks, proves and tells; whether the walk is certified.
bool Walk(const RobotModel& robot, const RobotFiles& files, bool quiet,
          const InterruptGuard& interrupt) {
  auto run = WalkSixSteps(files, quiet, interrupt);
  const std::string why = interrupt.requested() ? "" : WhyNoRest(*run);
  if (!why.empty()) {
    std::cerr << "halfstep: " << robot.name << " " << why << "; a search looks for another walk\n";
    WriteWalk(robot, files, why);
    run = WalkSixSteps(files, quiet, interrupt);
  }
  const MethodRun& last = run->runs().back();
  const bool certified = last.certified.answer.verdict == Verdict::kFeasible;
  if (interrupt.requested() && !certified) {
    std::cerr << "halfstep: stopped before its six steps were certified or refused; "
              << files.robot.string() << " stands\n";
    return false;
  }
  if (!quiet) {
    std::cout << '\n'
              << RunTable(run->experiment(), run->problem(), run->runs(),
                          {files.robot.string() + ", " + files.picture.string() + ", " +
                               files.walk.string(),
                           "`halfstep run " + files.walk.string() + " --json`"});
  }
  if (certified) return true;
  std::vector<std::string> lines;
  for (const InfeasibleWalk& walk : run->infeasible()) {
    lines = InfeasibleText(run->problem(), walk);
  }
  if (!why.empty()) {
    lines.push_back(last.method + ": " + last.result.message);
    if (const auto rest = WeakestAtRest(robot)) {
      const auto text = RestText(*rest, robot.standing_width, files.robot.string());
      lines.insert(lines.begin(), text.begin(), text.end());
    }
  }
  TellUnder("the robot file stands, but its six steps are not certified; worst first:", lines);
  return false;
}

// Writes what was found of a robot that is refused, and throws.
[[noreturn]] void Refuse(const RobotDraft& draft, std::vector<std::string> complaints,
                         const fs::path& file) {
  WriteWhole(file, {RefusedYamlOf(draft, complaints)});
  complaints.push_back("written: " + file.string() +
                       ", what was found, marked as refused; --overwrite replaces it");
  throw InputError(std::move(complaints));
}

RobotModel ModelOrRefusal(const RobotDraft& draft, const fs::path& file) {
  try {
    return ModelOf(draft);
  } catch (const InputError& error) {
    Refuse(draft, error.complaints(), file);
  }
}

// The soles of `--sole`; none without it.
std::optional<StatedSoles> SolesOf(const std::vector<double>& numbers) {
  if (numbers.empty()) return std::nullopt;
  if (numbers.size() == 3 || !(std::min(numbers[0], numbers[1]) >= 0.005) ||
      !(std::max(numbers[0], numbers[1]) <= 1.0)) {
    throw InputError(
        {"--sole: no sole (valid: LENGTH WIDTH, each 0.005 … 1 m, or LENGTH WIDTH AHEAD "
         "OUTWARDS)"});
  }
  StatedSoles soles{.size = {numbers[0], numbers[1]}, .centre = std::nullopt};
  if (numbers.size() == 4) soles.centre = Eigen::Vector2d(numbers[2], numbers[3]);
  return soles;
}

// Options that make a robot file, which --check does not.
void AskForNoSurvey(const CLI::App& app) {
  for (const char* option : {"--out", "--name", "--waist", "--feet", "--package", "--bend",
                             "--width", "--sole", "--overwrite"}) {
    if (app.get_option(option)->count() == 0) continue;
    throw InputError(
        {std::string(option) + ": --check makes no robot file (valid: --json, --quiet)"});
  }
}

}  // namespace

ExitStatus SurveyRobotFile(const RobotCommand& command) {
  const RobotFiles files = FilesOf(command);
  InterruptGuard interrupt;
  SurveyRequest request = command.survey;
  request.out = files.robot;
  const auto [draft, refused] = SurveyRobot(request);
  if (!refused.empty()) Refuse(draft, refused, files.robot);
  const RobotModel robot = ModelOrRefusal(draft, files.robot);
  WriteWhole(files.robot, {YamlOf(draft)});
  WriteWhole(files.picture, {RobotPicture(robot)});
  WriteWalk(robot, files, "");
  TellWarnings(robot);
  if (!command.quiet) Tell(draft, robot);
  if (Walk(robot, files, command.quiet, interrupt)) return kSuccess;
  return interrupt.requested() ? kInterrupted : kFailed;
}

CommandAction DeclareRobot(CLI::App* app, const Toolbox&) {
  const auto command = std::make_shared<RobotCommand>();
  struct Texts {
    std::string urdf;
    std::vector<std::string> feet, packages;
    std::vector<double> sole;
    bool check = false;
  };
  const auto texts = std::make_shared<Texts>();
  SurveyRequest* const survey = &command->survey;
  app->add_option("URDF", texts->urdf,
                  "the robot, as its maker describes it; of --check a robot file or a shipped "
                  "robot's name")
      ->required();
  app->add_option("--out", command->out,
                  "the robot file (default: that of the URDF, or NAME, in .yaml)");
  app->add_option("--name", survey->name, "of the robot (default: that of <robot>)");
  app->add_option("--waist", survey->legs.waist, "link on which both legs hang");
  app->add_option("--feet", texts->feet, "links of the left and of the right foot")->expected(2);
  app->add_option("--package", texts->packages, "NAME=FOLDER of package:// names; repeatable")
      ->allow_extra_args(false);
  app->add_option("--bend", survey->stance.bend,
                  "distance of hip and ankle when standing, over the stretched leg (default: 0.9, "
                  "or what the limits need)")
      ->check(CLI::Range(0.5, 0.99));
  app->add_option("--width", survey->stance.width,
                  "of the stance [m] (default: as narrow as feet allow)")
      ->check(CLI::Range(0.01, 2.0));
  app->add_option(
         "--sole", texts->sole,
         "length and width of either sole [m]; and its centre ahead of the foot's origin and "
         "outwards of it, all joints at zero (default: found from the feet's bodies)")
      ->expected(2, 4);
  app->add_flag("--overwrite", command->overwrite, "replace older files");
  app->add_flag("--quiet", command->quiet, "print nothing but errors");
  const auto check = std::make_shared<RobotCheckCommand>();
  app->add_flag("--check", texts->check,
                "tell what is known of a robot, what is missing, and what it can do");
  app->add_flag("--json", check->json, "of --check: print JSON");
  return [app, command, texts, check] {
    if (texts->check) {
      AskForNoSurvey(*app);
      check->robot = texts->urdf;
      check->quiet = command->quiet;
      return CheckRobotFile(*check);
    }
    if (check->json) throw InputError({"--json: of --check only"});
    SurveyRequest& request = command->survey;
    request.urdf = texts->urdf;
    if (request.urdf.extension() == ".yaml") {
      throw InputError({texts->urdf + ": is a robot file already (valid: a URDF)"});
    }
    for (size_t i = 0; i < texts->feet.size(); ++i) request.legs.feet[i] = texts->feet[i];
    request.soles = SolesOf(texts->sole);
    for (const YamlOverride& package : ParseOverrides(texts->packages, "--package")) {
      request.packages[package.key] = fs::absolute(package.value).lexically_normal().string();
    }
    return SurveyRobotFile(*command);
  };
}

}  // namespace halfstep
