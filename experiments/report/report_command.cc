#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "experiments/certificate_files.h"
#include "experiments/commands.h"
#include "experiments/experiment.h"
#include "experiments/report/report.h"
#include "experiments/report/report_page.h"
#include "experiments/report/report_walk.h"
#include "planner/whole_file.h"
#include "wpg/input/input_error.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

// The walks are drawn with today's files; these must be those that they were made for.
void CheckSame(const std::vector<std::string>& files, const std::string& what,
               const fs::path& run) {
  const fs::path path = run / "raw" / "certificate.json";
  const nlohmann::json hash =
      ReadJsonObject(path).value(nlohmann::json::json_pointer("/sha256/" + what), nlohmann::json());
  if (hash == HashOfFiles(files)) return;
  throw InputError({path.string() + ": the files of the " + what +
                    " are not those of this run (valid: as they were when it was made)"});
}

}  // namespace

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
  const Place place = LoadPlace(LoadConfig((run / "config.yaml").string(), {}));
  CheckSame(place.robot.files, "robot", run);
  CheckSame(place.scene.files, "scene", run);
  WriteWholeFile(out.string(), {RunReport(place.robot, place.scene, run)});
  if (!command.quiet) std::cout << "written: " << out.string() << '\n';
  return kSuccess;
}

}  // namespace halfstep
