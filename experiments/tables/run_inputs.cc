#include "experiments/tables/run_inputs.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "wpg/files/regular_file.h"
#include "wpg/files/sha256.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLevels = 3;  // from the first file's folder up to the one that holds all

bool IsBelow(const fs::path& path, const fs::path& folder) {
  const fs::path relative = path.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

bool IsAbsolute(const std::string& name) {
  return fs::path(name).is_absolute() || name.starts_with("file:");
}

// The places of files, and the nearest folder that holds all of them; none when that is far up, or
// a file is named by its absolute path, for such a name does not lead to a copy.
std::optional<fs::path> CommonFolder(const std::vector<InputFile>& files,
                                     std::vector<fs::path>* places) {
  std::optional<fs::path> folder;
  int levels = 0;
  for (const InputFile& file : files) {
    places->push_back(fs::absolute(file.path).lexically_normal());
    if (IsAbsolute(file.name)) return std::nullopt;
    if (!folder) folder = places->back().parent_path();
    while (!IsBelow(places->back(), *folder)) {
      folder = folder->parent_path();
      if (++levels > kMostLevels || *folder == folder->root_path()) return std::nullopt;
    }
  }
  return folder;
}

// Writes copies into `inputs/KIND`. The place of the first file's copy in the run folder; "": none
// was written.
std::string Copy(const std::vector<InputFile>& files, const std::string& kind, std::size_t most,
                 RunFolder* run) {
  std::vector<fs::path> places;
  const std::optional<fs::path> folder = CommonFolder(files, &places);
  if (!folder) return "";
  std::map<std::string, std::string> copies;
  std::size_t bytes = 0;
  const auto name_of = [&](size_t i) {
    return "inputs/" + kind + "/" + places[i].lexically_relative(*folder).string();
  };
  for (size_t i = 0; i < files.size(); ++i) {
    std::string& copy = copies[name_of(i)];
    if (!copy.empty()) continue;
    bytes += files[i].bytes;
    if (bytes > most) return "";
    copy = TryReadRegularFile(places[i].string(), most).bytes;
    if (Sha256(copy) != files[i].sha256) return "";
  }
  for (const auto& [name, copy] : copies) run->Write(name, copy);
  return name_of(0);
}

}  // namespace

ExperimentConfig WithInputs(const ExperimentConfig& config, const RobotModel& robot,
                            const Scene& scene, RunFolder* folder, std::size_t most) {
  ExperimentConfig named = config;
  const auto in_folder = [folder](const std::string& copy) {
    return (folder->path() / copy).string();
  };
  if (const std::string copy = Copy(robot.files, "robot", most, folder); !copy.empty()) {
    named.robot = in_folder(copy);
  }
  if (const std::string copy = Copy(scene.files, "scene", most, folder); !copy.empty()) {
    named.scene = in_folder(copy);
  }
  return named;
}

}  // namespace halfstep
