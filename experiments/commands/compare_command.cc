#include <filesystem>
#include <iostream>
#include <memory>

#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/compare/comparison_tables.h"
#include "experiments/report/report.h"
#include "experiments/report/report_page.h"
#include "experiments/tables/run_folder.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

// A comparison never takes the place of a run.
void CheckPlace(const CompareCommand& command) {
  if (!command.out) return;
  if (command.out->empty()) throw InputError({"--out: no folder is named (valid: a path)"});
  if (fs::exists(fs::path(*command.out) / "manifest.json") &&
      !fs::exists(fs::path(*command.out) / "comparison.csv")) {
    throw InputError({"--out: " + *command.out +
                      " is a run folder (valid: a new folder, or one of an older comparison)"});
  }
}

}  // namespace

ExitStatus CompareRuns(const CompareCommand& command) {
  CheckPlace(command);
  std::vector<RunRecord> runs;
  std::vector<std::string> complaints;
  for (const std::string& run : command.runs) {
    try {
      runs.push_back(ReadRun(run));
    } catch (const InputError& error) {
      complaints.insert(complaints.end(), error.complaints().begin(), error.complaints().end());
    }
  }
  if (!complaints.empty()) throw InputError(complaints);
  const Comparison comparison = Compare(runs);
  if (command.out) {
    RunFolder folder(*command.out, command.overwrite);
    WriteCsv("comparison", ComparisonCsv(comparison), &folder);
    WriteCsv("performance_profile", PerformanceProfileCsv(comparison), &folder);
    WriteCsv("anytime", AnytimeCsv(comparison), &folder);
    WriteCsv("means", MeansCsv(comparison), &folder);
    folder.Write("manifest.json", ComparisonManifest(runs));
    if (HasReport()) folder.Write("report.html", ComparisonReport(comparison, command.tools));
    folder.Publish();
  }
  if (!command.quiet) {
    std::cout << ComparisonScreen(comparison);
    if (command.out) std::cout << "\nwritten: " << *command.out << '\n';
  }
  return kSuccess;
}

CommandAction DeclareCompare(CLI::App* app, const Toolbox& tools) {
  const auto command = std::make_shared<CompareCommand>();
  command->tools = tools;
  app->add_option("RUN", command->runs, "run folder, or LABEL=RUN")->required();
  app->add_option("--out", command->out, "folder for the tables as CSV");
  app->add_flag("--overwrite", command->overwrite, "replace an older comparison");
  app->add_flag("--quiet", command->quiet, "print nothing but errors");
  return [command] { return CompareRuns(*command); };
}

}  // namespace halfstep
