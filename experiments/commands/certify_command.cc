#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/config/experiment.h"
#include "experiments/config/folder_name.h"
#include "experiments/report/report.h"
#include "experiments/run/complete_manifest.h"
#include "experiments/run/interrupt.h"
#include "experiments/run/smoothing_of.h"
#include "experiments/tables/answer_words.h"
#include "experiments/tables/certificate_files.h"
#include "experiments/tables/csv_reader.h"
#include "experiments/tables/given_walk_file.h"
#include "experiments/tables/json_file.h"
#include "experiments/tables/result_tables.h"
#include "experiments/tables/run_folder.h"
#include "experiments/tables/trajectory_match.h"
#include "smoothing/margins/not_covered_by.h"
#include "wpg/files/input_error.h"
#include "wpg/files/sha256.h"
#include "wpg/files/suggestion.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

// The methods of a run, from its manifest.
std::vector<std::string> MethodsOf(const fs::path& path, const nlohmann::json& manifest) {
  std::vector<std::string> methods;
  try {
    for (const auto& method : manifest.at("methods")) {
      methods.push_back(method.at("name").get<std::string>());
    }
  } catch (const nlohmann::json::exception& error) {
    throw InputError({path.string() + ": is not a run's manifest: " + error.what()});
  }
  return methods;
}

// Complains about tables of a method's walk that are not as the run wrote them, by the manifest.
void CheckUnchanged(const fs::path& run, const nlohmann::json& manifest, const std::string& place,
                    Complaints* complaints) {
  if (!manifest.contains("files") || !manifest["files"].is_object()) return;
  for (const std::string table : {"overlaps.csv", "half_steps.csv", "trajectory.csv"}) {
    const auto listed = manifest["files"].find(place + table);
    if (listed == manifest["files"].end() || !listed->is_object()) continue;
    const std::string path = (run / place / table).string();
    if (listed->value("sha256", "") == Sha256(ReadCsvText(path))) continue;
    complaints->Add(path, 0, 0, "certify",
                    "is not as the run wrote it, and the run's other tables would not be those of "
                    "its walk (valid: as it was; `halfstep smooth " +
                        run.string() +
                        " --given OVERLAPS.csv --given HALF_STEPS.csv` certifies a walk of your "
                        "own, in a run of its own)");
  }
}

// Refuses a walk that the trajectory beside it is not of, as another config may make it.
void CheckTrajectoryIsOf(const CertifyCommand& command, const RobotModel& robot,
                         const SuperposedWalk& walk, const CsvTable& trajectory) {
  const std::string mismatch = TrajectoryMismatch(robot, walk, trajectory);
  if (mismatch.empty()) return;
  throw InputError({trajectory.path + ": is of another walk than config and tables make" +
                    (command.overrides.empty() ? "" : " with --set") + ": " + mismatch +
                    " (valid: what does not change the walk; `halfstep smooth " + command.run +
                    " --given OVERLAPS.csv --given HALF_STEPS.csv` makes a run of another walk)"});
}

}  // namespace

ExitStatus Certify(const CertifyCommand& command) {
  InterruptGuard interrupt;
  const fs::path run(command.run);
  if (!fs::is_directory(run)) {
    throw InputError({command.run + ": no such run folder (" + DidYouMeanRun(command.run) +
                      "valid: a folder that `halfstep run` wrote)"});
  }
  ExperimentConfig config =
      LoadConfig((run / "config.yaml").string(), command.overrides, command.tools);
  const Experiment experiment = Prepare(config);
  const MarginEvaluator evaluator(experiment.robot, experiment.scene, config.smoothing.limits);
  const CertifiedFeasibility test(evaluator, config.smoothing.certification);
  const nlohmann::json manifest = ReadJsonObject(run / "manifest.json");
  const std::vector<std::string> methods = MethodsOf(run / "manifest.json", manifest);
  Complaints complaints;
  for (const std::string& method : methods) {
    CheckUnchanged(run, manifest, MethodFolder(method) + "/", &complaints);
  }
  complaints.ThrowIfAny();
  RunFolder folder(run, /*overwrite=*/true);
  folder.CopyOlder();
  const std::shared_ptr<Workers> workers = WorkersOf(config);
  bool all_certified = true;
  for (const std::string& method : methods) {
    const std::string place = MethodFolder(method) + "/";
    const HomotopyParameters parameters = ReadParameters(run / place, experiment.sequence);
    const std::string path = (run / place / "trajectory.csv").string();
    const std::string trajectory = ReadCsvText(path);
    CheckTrajectoryIsOf(command, experiment.robot, SuperposedWalk(experiment.sequence, parameters),
                        ParseCsv(trajectory, path));
    const CertifiedWalk walk =
        CertifyWalk(test, experiment.sequence, parameters, interrupt.token(), workers.get());
    if (walk.answer.stopped) break;
    WriteCertificate(experiment, test, walk, config, trajectory, place, &folder);
    const bool certified = walk.answer.verdict == Verdict::kFeasible;
    all_certified = all_certified && certified;
    if (command.quiet) continue;
    std::cout << method << ": " << VerdictName(walk.answer.verdict);
    if (certified) {
      std::cout << ", " << walk.rows.size() << " rows for " << walk.duration << " s\n";
    } else {
      std::cout << ": " << AnswerWords(evaluator, test.options(), walk.answer) << '\n';
    }
  }
  if (interrupt.requested()) {
    std::cerr << "halfstep: interrupted; the run is as it was\n";
    return kInterrupted;
  }
  WriteReport(experiment.robot, experiment.scene, &folder, command.tools);
  CompleteManifest(experiment.robot, experiment.scene, &folder);
  folder.Publish();
  if (!command.quiet) {
    std::cout << '\n'
              << CertificateStatement(experiment.robot, evaluator.limits(),
                                      *experiment.scene.ground)
              << "\n\n"
              << NotCoveredText(
                     NotCoveredBy(experiment.robot, experiment.scene, evaluator.limits()),
                     "not_covered in certificate.json");
  }
  return all_certified ? kSuccess : kFailed;
}

CommandAction DeclareCertify(CLI::App* app, const Toolbox& tools) {
  const auto command = std::make_shared<CertifyCommand>();
  command->tools = tools;
  const auto sets = std::make_shared<std::vector<std::string>>();
  app->add_option("RUN", command->run, "run folder")->required();
  DeclareOverrides(app, "the run's config", sets.get());
  app->add_flag("--quiet", command->quiet, "print nothing but errors");
  return [command, sets] {
    command->overrides = ParseOverrides(*sets);
    return Certify(*command);
  };
}

}  // namespace halfstep
