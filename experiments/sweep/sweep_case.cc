#include "experiments/sweep/sweep_case.h"

#include <chrono>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <utility>

#include "experiments/report/report.h"
#include "experiments/run/complete_manifest.h"
#include "experiments/run/experiment_run.h"
#include "experiments/sweep/sweep_tables.h"
#include "experiments/tables/csv_columns.h"
#include "experiments/tables/not_covered_json.h"
#include "experiments/tables/run_folder.h"
#include "smoothing/margins/not_covered_by.h"

namespace halfstep {
namespace {

ExperimentConfig ConfigOf(const SweepFolder& folder, const SweepCase& one) {
  ExperimentConfig config = LoadCase(folder.sweep(), one);
  config.name += "-" + one.id;  // a scenario of its own for `halfstep compare`
  config.output_directory.clear();
  return config;
}

// Text of a case's not_covered.json: what its certificates do not speak of.
std::string NotCoveredFile(const ExperimentRun& run) {
  const Experiment& experiment = run.experiment();
  const nlohmann::ordered_json list = NotCoveredJson(
      NotCoveredBy(experiment.robot, experiment.scene, experiment.config.smoothing.limits));
  return nlohmann::ordered_json({{"not_covered", list}})
             .dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) +
         "\n";
}

// Writes a case's folder in place of a damaged one. `run` is null where there is no walk.
void Publish(const SweepFolder& folder, const SweepCase& one, const ExperimentConfig& config,
             const SweepTables& tables, const ExperimentRun* run) {
  if (folder.IsDone(one)) return;  // another process did it meanwhile
  const std::filesystem::path path = folder.CasePath(one);
  if (!std::filesystem::is_symlink(path)) std::filesystem::remove_all(path);
  // Collect() tidies once for all: here it would be a look at every case for each case.
  RunFolder place(folder.CasePath(one), /*overwrite=*/false, /*tidy=*/false);
  const ExperimentRun* const kept = folder.sweep().keep == "all" ? run : nullptr;
  if (run != nullptr) place.Write("not_covered.json", NotCoveredFile(*run));
  if (kept != nullptr) {
    kept->Write(&place);
  } else {
    place.Write("config.yaml", ResolvedConfig(place.path(), config));
  }
  WriteCsv("timings", tables.timings, &place);
  WriteCsv("runs", tables.runs, &place);
  if (kept != nullptr) {
    WriteReport(kept->experiment().robot, kept->experiment().scene, &place, folder.sweep().tools);
    CompleteManifest(kept->experiment().robot, kept->experiment().scene, &place);
  }
  try {
    place.Publish();
  } catch (const std::runtime_error&) {
    if (!folder.IsDone(one)) throw;  // else another process did the same case meanwhile
  }
}

}  // namespace

ExitStatus DoSweepCase(const SweepFolder& folder, const SweepCase& one, std::stop_token stop,
                       const ReplayerOf& replayer_of) {
  if (folder.IsDone(one)) return kSuccess;
  const auto begin = std::chrono::steady_clock::now();
  const auto wall = [begin] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  const ExperimentConfig config = ConfigOf(folder, one);
  const RunHooks hooks{
      .progress = [](const std::string&, double) {}, .stop = stop, .replay = replayer_of(config)};
  std::optional<ExperimentRun> run;
  SweepTables tables;
  bool smoothed = false;
  try {
    run.emplace(config, hooks);
    if (run->refusal()) {
      tables = TablesOfFailure(folder.sweep(), one, run->refusal()->status,
                               run->refusal()->sentence, wall());
    } else {
      run->Smooth(hooks);
      if (stop.stop_requested()) return kInterrupted;
      run->Certify(stop);
      run->Replay(hooks);
      smoothed = true;
    }
  } catch (const std::logic_error& error) {  // a mistake of ours: the other cases go on
    tables = TablesOfFailure(folder.sweep(), one, "error", error.what(), wall());
  }
  if (stop.stop_requested()) return kInterrupted;
  if (smoothed) tables = TablesOf(folder.sweep(), one, *run, wall());
  Publish(folder, one, smoothed ? run->config() : config, tables, smoothed ? &*run : nullptr);
  return kSuccess;
}

void WriteSweepFailure(const SweepFolder& folder, const SweepCase& one, const std::string& status,
                       const std::string& message, double wall) {
  Publish(folder, one, ConfigOf(folder, one),
          TablesOfFailure(folder.sweep(), one, status, message, wall), nullptr);
}

}  // namespace halfstep
