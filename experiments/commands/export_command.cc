#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "halfstep/experiments/build_info.h"
#include "halfstep/experiments/commands/command_line.h"
#include "halfstep/experiments/commands/commands.h"
#include "halfstep/experiments/config/experiment.h"
#include "halfstep/experiments/config/folder_name.h"
#include "halfstep/experiments/export/hrpsys_files.h"
#include "halfstep/experiments/export/ompl_log.h"
#include "halfstep/experiments/tables/certificate_files.h"
#include "halfstep/experiments/tables/csv_subset.h"
#include "halfstep/experiments/tables/result_tables.h"
#include "halfstep/experiments/tables/run_folder.h"
#include "halfstep/wpg/files/input_error.h"
#include "halfstep/wpg/files/number_text.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

void Refuse(const std::string& what) { throw InputError({what}); }

// Options that the format would ignore are mistakes.
void CheckOptions(const ExportCommand& command) {
  const bool ompl = command.format == "ompl";
  if (!ompl && command.runs.size() != 1) Refuse("RUN: --format " + command.format + " takes one");
  if (ompl && command.method) Refuse("--method: --format ompl exports all methods");
  if (ompl && command.period) Refuse("--period: not of --format ompl (valid: csv, hrpsys)");
  if (command.format != "csv" && !command.columns.empty()) {
    Refuse("--columns: not of --format " + command.format + " (valid: csv)");
  }
  if (command.format != "hrpsys" && !command.joints.empty()) {
    Refuse("--joints: not of --format " + command.format + " (valid: hrpsys)");
  }
  if (command.out && command.out->empty()) Refuse("--out: no folder is named (valid: a path)");
}

fs::path OutputFolder(const ExportCommand& command) {
  if (command.out) return *command.out;
  fs::path run = fs::path(command.runs.front()).lexically_normal();
  if (!run.has_filename()) run = run.parent_path();
  return run += "-" + command.format;
}

// How many rows of trajectory.csv make a period.
size_t Stride(const ExperimentConfig& config, const std::optional<double>& period) {
  if (!period) return 1;
  const double rows = *period / config.output_period;
  if (!(rows > 0.5) || std::abs(rows - std::round(rows)) > 1e-6) {
    const std::string one = ShortestText(config.output_period);
    Refuse("--period " + ShortestText(*period) +
           ": is no multiple of the run's output.period_s (valid: " + one + ", " +
           ShortestText(2 * config.output_period) + ", ...)");
  }
  return static_cast<size_t>(std::lround(rows));
}

// Exports of one run, method by method.
void ExportWalks(const ExportCommand& command, RunFolder* folder) {
  const fs::path run(command.runs.front());
  const std::vector<std::string> methods = MethodsOfRun(run.string(), command.method);
  const ExperimentConfig config = LoadConfig((run / "config.yaml").string(), {});
  const auto [robot, tree] = LoadWholeRobot(RobotPath(config).string());
  const size_t stride = Stride(config, command.period);
  const double period = static_cast<double>(stride) * config.output_period;
  const std::vector<int> joints = OrderedJoints(tree, command.joints);
  for (const std::string& method : methods) {
    const std::string name = MethodFolder(method);
    const fs::path trajectory = run / name / "trajectory.csv";
    if (command.format == "csv") {
      WriteCsv(name,
               CsvSubset(ReadCsv(trajectory.string()), TrajectoryColumns(robot), command.columns,
                         stride),
               folder);
      continue;
    }
    const HrpsysFiles files =
        WriteHrpsys(robot, tree, joints, ReadTrajectory(trajectory, robot), stride, period);
    folder->Write(name + ".pos", files.pos);
    folder->Write(name + ".zmp", files.zmp);
    folder->Write(name + ".waist", files.waist);
    folder->Write(name + ".joints", files.joints);
  }
}

}  // namespace

ExitStatus Export(const ExportCommand& command) {
  CheckOptions(command);
  for (const std::string& run : command.runs) MethodsOfRun(run, std::nullopt);
  RunFolder folder(OutputFolder(command), command.overwrite);
  if (command.format == "ompl") {
    for (const auto& [scenario, log] : OmplLogs(command.runs)) folder.Write(scenario + ".log", log);
  } else {
    ExportWalks(command, &folder);
  }
  nlohmann::ordered_json manifest = {{"format", 1},         {"program", "halfstep"},
                                     {"kind", "export"},    {"version", kVersion},
                                     {"commit", kCommit},   {"exported", command.format},
                                     {"runs", command.runs}};
  folder.Write(
      "manifest.json",
      manifest.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  folder.Publish();
  if (!command.quiet) std::cout << "written: " << folder.path().string() << '\n';
  return kSuccess;
}

CommandAction DeclareExport(CLI::App* app) {
  const auto command = std::make_shared<ExportCommand>();
  app->add_option("RUN", command->runs, "run folder; several for ompl")->required();
  app->add_option("--format", command->format, "csv, hrpsys or ompl")
      ->required()
      ->check(CLI::IsMember({"csv", "hrpsys", "ompl"}));
  app->add_option("--method", command->method, "only this one (default: all)");
  app->add_option("--out", command->out, "folder (default: RUN-FORMAT)");
  app->add_option("--period", command->period, "between rows [s] (default: the run's)");
  app->add_option("--columns", command->columns, "csv: patterns of columns (default: all)");
  app->add_option("--joints", command->joints,
                  "hrpsys: patterns of joints in their order (default: the URDF's)");
  app->add_flag("--overwrite", command->overwrite, "replace an older export");
  app->add_flag("--quiet", command->quiet, "print nothing but errors");
  return [command] { return Export(*command); };
}

}  // namespace halfstep
