#include "experiments/config/data_folder.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <system_error>

#include "wpg/files/input_error.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

bool HasData(const fs::path& share) {
  std::error_code ignored;
  return fs::is_directory(share / "robots", ignored);
}

// The nearest share/halfstep in a folder above a file.
std::optional<fs::path> ShareAbove(const fs::path& file) {
  for (fs::path folder = file.parent_path();; folder = folder.parent_path()) {
    const fs::path share = folder / "share" / "halfstep";
    if (HasData(share)) return share;
    if (!folder.has_relative_path()) return std::nullopt;
  }
}

// The library that holds the code of this file. A program may be named as it was called, which need
// not be a path.
std::optional<fs::path> ThisLibrary() {
  Dl_info info;
  if (dladdr(reinterpret_cast<const void*>(&DataFolder), &info) == 0) return std::nullopt;
  const fs::path path = info.dli_fname;
  return path.is_absolute() ? std::optional(path) : std::nullopt;
}

fs::path Within(const std::string& folder) {
  const fs::path path = DataFolder() / folder;
  std::error_code error;
  const fs::path real = fs::canonical(path, error);
  return error ? path : real;
}

bool IsName(const fs::path& given) { return !given.has_parent_path() && !given.has_extension(); }

std::vector<std::string> NamesIn(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::path& path : YamlFiles(folder)) names.push_back(path.stem().string());
  return names;
}

// What a shipped name is that is none of `folder`, and which command takes it; "": nothing.
std::string OtherKind(const fs::path& name, const std::string& folder) {
  struct Kind {
    const char* folder;
    const char* what;
    const char* command;
  };
  constexpr Kind kKinds[] = {{"configs", "a config", "run"},
                             {"episodes", "an episode", "live"},
                             {"sweeps", "a sweep", "sweep"}};
  for (const Kind& kind : kKinds) {
    std::error_code ignored;
    if (folder == kind.folder ||
        !fs::is_regular_file(Within(kind.folder) / (name.string() + ".yaml"), ignored)) {
      continue;
    }
    return std::string("it is ") + kind.what + ": `halfstep " + kind.command + " " + name.string() +
           "`; ";
  }
  return "";
}

}  // namespace

fs::path DataFolder() {
  const char* folder = std::getenv("HALFSTEP_DATA");
  if (folder != nullptr && *folder != '\0') return folder;
  if (const std::optional<fs::path> library = ThisLibrary()) {
    if (const std::optional<fs::path> share = ShareAbove(*library)) return *share;
  }
  std::error_code error;
  if (const fs::path program = fs::read_symlink("/proc/self/exe", error); !error) {
    if (const std::optional<fs::path> share = ShareAbove(program)) return *share;
  }
  for (const char* share : {HALFSTEP_DATA_DIR, "/usr/local/share/halfstep"}) {
    if (HasData(share)) return share;
  }
  return "/usr/share/halfstep";
}

fs::path RobotsFolder() { return Within("robots"); }
fs::path ScenesFolder() { return Within("scenes"); }

std::vector<fs::path> YamlFiles(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& file : fs::directory_iterator(folder, ignored)) {
    if (file.path().extension() == ".yaml") files.push_back(file.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

fs::path ShippedOr(const fs::path& given, const std::string& folder) {
  std::error_code ignored;
  if (!IsName(given) || fs::exists(given, ignored)) return given;
  const fs::path shipped = Within(folder) / (given.string() + ".yaml");
  return fs::is_regular_file(shipped, ignored) ? shipped : given;
}

fs::path FileOrShipped(const std::string& given, const std::string& folder) {
  const fs::path found = ShippedOr(given, folder);
  std::error_code ignored;
  const fs::file_status status = fs::status(found, ignored);
  if (fs::exists(status)) return found;
  const std::vector<std::string> names = NamesIn(Within(folder));
  if (!IsName(found)) {
    if (status.type() != fs::file_type::not_found) return found;  // whoever opens it tells why
    throw InputError({given + ": no such file (" + NearestFile(found) +
                      "valid: a path, or a name of " + Joined(names) +
                      "; `halfstep init NAME` writes a config)"});
  }
  std::string hint = OtherKind(found, folder);
  if (hint.empty() && fs::exists(given + ".yaml", ignored)) {
    hint = "did you mean " + Quote(given + ".yaml") + "? ";
  }
  if (hint.empty()) hint = DidYouMean(given, names);
  throw InputError(
      {given + ": no such file (" + hint + "valid: a path, or " + Joined(names) + ")"});
}

std::string UnknownRobot(const std::string& robot) {
  if (robot.ends_with(".urdf")) {
    return "no such file: " + Quote(robot) +
           " (valid: a robot file; `halfstep robot URDF` makes one of a URDF)";
  }
  const std::vector<std::string> names = NamesIn(RobotsFolder());
  return "no such robot: " + Quote(robot) + " (" + DidYouMean(robot, names) +
         "valid: " + Joined(names) + ", or the path of a robot file)";
}

std::string NearestFile(const fs::path& missing) {
  std::vector<std::string> names;
  for (const fs::path& path : YamlFiles(missing.has_parent_path() ? missing.parent_path() : ".")) {
    names.push_back(path.filename().string());
  }
  return DidYouMean(missing.filename().string(), names);
}

}  // namespace halfstep
