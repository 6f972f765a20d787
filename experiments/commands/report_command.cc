#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/report/report.h"
#include "experiments/report/report_page.h"
#include "experiments/run/complete_manifest.h"
#include "experiments/tables/run_folder.h"
#include "wpg/files/input_error.h"
#include "wpg/files/whole_file.h"

namespace halfstep {

namespace fs = std::filesystem;

ExitStatus Report(const ReportCommand& command) {
  const fs::path run(command.run);
  if (!fs::is_directory(run) || !fs::exists(run / "manifest.json")) {
    throw InputError(
        {command.run + ": no such run folder (valid: a folder that `halfstep run` wrote)"});
  }
  if (!HasReport()) {
    throw std::runtime_error(
        "this build has no report: npm was not there or could not fetch its packages when it was "
        "configured, or HALFSTEP_REPORT was OFF");
  }
  const fs::path out = command.out ? fs::path(*command.out) : run / "report.html";
  if (out.empty()) throw InputError({"--out: no file is named (valid: a path)"});
  if (command.out && !command.overwrite && fs::exists(fs::symlink_status(out))) {
    throw std::runtime_error(out.string() + ": is there already (--overwrite replaces it)");
  }
  const Place place = PlaceOfRun(run);
  if (command.out) {
    WriteWhole(out, {RunReport(place.robot, place.scene, run)});
  } else {
    RunFolder folder(run, /*overwrite=*/true);
    folder.CopyOlder();
    WriteReport(place.robot, place.scene, &folder);
    CompleteManifest(place.robot, place.scene, &folder);
    folder.Publish();
  }
  if (!command.quiet) std::cout << "written: " << out.string() << '\n';
  return kSuccess;
}

CommandAction DeclareReport(CLI::App* app) {
  const auto command = std::make_shared<ReportCommand>();
  app->add_option("RUN", command->run, "run folder")->required();
  app->add_option("--out", command->out, "the file (default: report.html in the run folder)");
  app->add_flag("--overwrite", command->overwrite, "replace --out");
  app->add_flag("--quiet", command->quiet, "print nothing but errors");
  return [command] { return Report(*command); };
}

}  // namespace halfstep
