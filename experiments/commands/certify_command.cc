#include <iostream>
#include <nlohmann/json.hpp>

#include "experiments/commands/commands.h"
#include "experiments/config/experiment.h"
#include "experiments/config/folder_name.h"
#include "experiments/report/report.h"
#include "experiments/run/complete_manifest.h"
#include "experiments/run/interrupt.h"
#include "experiments/tables/certificate_files.h"
#include "experiments/tables/csv_reader.h"
#include "experiments/tables/json_file.h"
#include "experiments/tables/result_tables.h"
#include "experiments/tables/run_folder.h"
#include "wpg/files/input_error.h"

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

// The homotopy's point that a method of a run ended at.
HomotopyParameters ParametersOf(const fs::path& folder, const HalfStepSequence& sequence) {
  HomotopyParameters parameters = PlannedMotion(sequence);
  const fs::path path = folder / "overlaps.csv";
  if (!fs::exists(path)) return parameters;  // the planned motion itself
  parameters.overlaps = ReadCsv(path.string()).Numbers("overlap_s");
  const CsvTable half_steps = ReadCsv((folder / "half_steps.csv").string());
  parameters.durations = half_steps.Numbers("duration_s");
  const std::vector<double> scales = half_steps.Numbers("height_scale");
  parameters.height_scales.clear();
  for (size_t i = 0; i < scales.size(); i += 2) parameters.height_scales.push_back(scales[i]);
  try {
    CheckParameters(sequence, parameters);
  } catch (const std::logic_error& error) {
    throw InputError({path.string() + ": does not fit the run's config: " + error.what()});
  }
  return parameters;
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
        CertifyWalk(test, experiment.sequence, ParametersOf(run / place, experiment.sequence),
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

}  // namespace halfstep
