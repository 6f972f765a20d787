#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "halfstep/experiments/commands/command_line.h"
#include "halfstep/experiments/commands/commands.h"
#include "halfstep/experiments/config/experiment.h"
#include "halfstep/experiments/config/folder_name.h"
#include "halfstep/experiments/report/report.h"
#include "halfstep/experiments/run/complete_manifest.h"
#include "halfstep/experiments/run/interrupt.h"
#include "halfstep/experiments/tables/certificate_files.h"
#include "halfstep/experiments/tables/csv_reader.h"
#include "halfstep/experiments/tables/json_file.h"
#include "halfstep/experiments/tables/parameter_tables.h"
#include "halfstep/experiments/tables/result_tables.h"
#include "halfstep/experiments/tables/run_folder.h"
#include "halfstep/wpg/files/input_error.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

// The methods of a run, from its manifest.
std::vector<std::string> MethodsOf(const fs::path& run) {
  const fs::path path = run / "manifest.json";
  std::vector<std::string> methods;
  try {
    const nlohmann::json manifest = ReadJsonObject(path);
    for (const auto& method : manifest.at("methods")) {
      methods.push_back(method.at("name").get<std::string>());
    }
  } catch (const nlohmann::json::exception& error) {
    throw InputError({path.string() + ": is not a run's manifest: " + error.what()});
  }
  return methods;
}

}  // namespace

ExitStatus Certify(const CertifyCommand& command) {
  InterruptGuard interrupt;
  const fs::path run(command.run);
  if (!fs::is_directory(run)) {
    throw InputError(
        {command.run + ": no such run folder (valid: a folder that `halfstep run` wrote)"});
  }
  ExperimentConfig config = LoadConfig((run / "config.yaml").string(), command.overrides);
  const Experiment experiment = Prepare(config);
  const MarginEvaluator evaluator(experiment.robot, experiment.scene, config.smoothing.limits);
  const CertifiedFeasibility test(evaluator, config.smoothing.certification);
  RunFolder folder(run, /*overwrite=*/true);
  folder.CopyOlder();
  bool all_certified = true;
  for (const std::string& method : MethodsOf(run)) {
    const std::string place = MethodFolder(method) + "/";
    const CertifiedWalk walk =
        CertifyWalk(test, experiment.sequence, ReadParameters(run / place, experiment.sequence),
                    interrupt.token());
    if (walk.answer.stopped) break;
    WriteCertificate(experiment, test, walk, ReadCsvText((run / place / "trajectory.csv").string()),
                     place, &folder);
    const bool certified = walk.answer.verdict == Verdict::kFeasible;
    all_certified = all_certified && certified;
    if (command.quiet) continue;
    std::cout << method << ": " << VerdictName(walk.answer.verdict);
    if (certified) {
      std::cout << ", " << walk.rows.size() << " rows for " << walk.duration << " s\n";
    } else {
      std::cout << ": " << evaluator.Describe(walk.answer.witness) << '\n';
    }
  }
  if (interrupt.requested()) {
    std::cerr << "halfstep: interrupted; the run is as it was\n";
    return kInterrupted;
  }
  WriteReport(experiment.robot, experiment.scene, &folder);
  CompleteManifest(experiment.robot, experiment.scene, &folder);
  folder.Publish();
  if (!command.quiet) std::cout << '\n' << kCertificateStatement << '\n';
  return all_certified ? kSuccess : kFailed;
}

CommandAction DeclareCertify(CLI::App* app) {
  const auto command = std::make_shared<CertifyCommand>();
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
