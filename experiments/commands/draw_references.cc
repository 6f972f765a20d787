#include "experiments/commands/draw_references.h"

#include <algorithm>
#include <ctime>
#include <iostream>
#include <map>
#include <mutex>

#include "experiments/commands/command_line.h"
#include "experiments/references/reference_folder.h"
#include "experiments/run/interrupt.h"
#include "experiments/run/progress_bar.h"
#include "smoothing/margins/not_covered_by.h"
#include "smoothing/methods/methods.h"
#include "wpg/files/input_error.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/workers.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

constexpr int kMostReferences = 100000;

// Whether this is the name of a shipped robot, else the path of a robot file.
bool IsRobotName(const fs::path& robot) {
  return !robot.has_parent_path() && !robot.has_extension();
}

ReferenceRequest Checked(const ReferencesCommand& command, const fs::path& folder) {
  ReferenceRequest request = command.request;
  if (request.count < 1 || request.count > kMostReferences) {
    throw InputError(
        {Formatted("--count: %d references (valid: 1 … %d)", request.count, kMostReferences)});
  }
  const std::vector<std::string> methods = Methods::Standard().Names();
  if (std::ranges::find(methods, request.method) == methods.end()) {
    throw InputError({"--method " + Quote(request.method) + ": no such method" +
                      Suggestion(request.method, methods)});
  }
  if (!IsRobotName(request.robot)) {
    request.robot = fs::proximate(fs::absolute(request.robot), folder / "walks").string();
  }
  return request;
}

std::string CountsText(const std::map<std::string, int>& counts) {
  std::string text;
  for (const auto& [name, count] : counts) {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + name;
  }
  return text;
}

}  // namespace

ExitStatus DrawReferences(const ReferencesCommand& command) {
  InterruptGuard interrupt;
  if (command.out.empty()) {
    throw InputError({"draw: references: --out is missing (valid: a folder)"});
  }
  const fs::path out = fs::absolute(command.out).lexically_normal();
  const ReferenceRequest request = Checked(command, out);
  const ReferenceMaker maker(request, out);
  TellWarnings(maker.experiment().robot);
  const ReferenceFolder folder(out, ReferenceManifest(request, maker));
  interrupt.Keep();
  std::vector<std::string> names;
  std::vector<int> missing;
  for (int number = 1; number <= request.count; ++number) {
    names.push_back(maker.NameOf(number));
    if (!folder.IsDone(names.back())) missing.push_back(number);
  }
  if (!command.quiet && missing.size() < names.size()) {
    std::cout << names.size() - missing.size() << " of " << names.size()
              << " references are done already\n"
              << std::flush;
  }
  std::mutex mutex;  // of what follows
  std::map<std::string, int> refused;
  int made = 0, failed = 0;
  const std::clock_t begin = std::clock();
  {
    ProgressBar bar("references", command.quiet);
    Workers workers(command.jobs);
    workers.Run(static_cast<int>(missing.size()), [&](int index, int) {
      const int number = missing[static_cast<size_t>(index)];
      const std::optional<MadeReference> one = maker.Make(number, interrupt.token());
      if (!one) return false;
      folder.Write(maker.NameOf(number), *one);
      const std::lock_guard<std::mutex> lock(mutex);
      for (const auto& [what, count] : one->refused) refused[what] += count;
      failed += one->certified ? 0 : 1;
      ++made;
      bar.Update(static_cast<double>(made) / static_cast<double>(missing.size()));
      return !interrupt.requested();
    });
  }
  const double seconds =
      static_cast<double>(std::clock() - begin) / static_cast<double>(CLOCKS_PER_SEC);
  if (made < static_cast<int>(missing.size())) {
    std::cerr << "halfstep: stopped; " << missing.size() - static_cast<size_t>(made) << " of "
              << names.size() << " references are not done (the same command goes on)\n";
    return kInterrupted;
  }
  const std::uintmax_t bytes = folder.Finish(maker.Columns(), names);
  if (!command.quiet) {
    int draws = 0;
    for (const auto& [what, count] : refused) draws += count;
    std::cout << command.request.robot << ": " << made - failed << " references certified";
    if (draws > 0) std::cout << "; " << draws << " draws were not: " << CountsText(refused);
    std::cout << '\n'
              << Formatted("%.2f references a second of processor time, %.1f MB\n",
                           seconds > 0.0 ? made / seconds : 0.0, 1e-6 * static_cast<double>(bytes))
              << NotCoveredText(NotCoveredBy(maker.experiment().robot, maker.experiment().scene,
                                             maker.limits()),
                                "manifest.json")
              << "written: " << command.out << '\n';
  }
  if (failed == 0) return kSuccess;
  std::cerr << "halfstep: of " << failed << " references none of " << ReferenceMaker::kMostDraws
            << " draws was certified (index.csv: refused)\n";
  return kFailed;
}

}  // namespace halfstep
