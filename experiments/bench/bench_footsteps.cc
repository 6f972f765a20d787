#include "experiments/bench/bench_footsteps.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <vector>

#include "experiments/config/footsteps_file.h"
#include "wpg/files/input_error.h"
#include "wpg/files/regular_file.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/files/yaml_fields.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

// A text as YAML has it.
std::string InYaml(const std::string& text) { return nlohmann::json(text).dump(); }

// The scene's config, but another name of its scene, and without what is planned.
std::string WithoutGoal(const std::string& config, const std::string& scene) {
  std::istringstream lines(config);
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("goal:") || line.starts_with("planner:") || line.starts_with('#'))
      continue;
    text += line.starts_with("scene:") ? "scene: " + InYaml(scene) + "\n" : line + "\n";
  }
  return text;
}

// Whether a CSV says that the feet start elsewhere than the config does.
bool StartsElsewhere(const FiledFootsteps& read, const ExperimentConfig& config) {
  constexpr double kSame = 1e-6;
  if (!read.start) return false;
  const auto differ = [](const Pose2& a, const Pose2& b) {
    return (a.position() - b.position()).norm() > kSame || std::fabs(a.yaw - b.yaw) > kSame;
  };
  return differ(read.start->front(), config.start_left) ||
         differ(read.start->back(), config.start_right);
}

}  // namespace

std::string ReadBenchConfig(const fs::path& scenes, const BenchKey& key) {
  return ReadYamlFile((scenes / (key.Name() + ".yaml")).string());
}

GivenFootsteps ReadGivenFootsteps(const BenchSelection& selection, const BenchKey& key,
                                  const std::string& scene, const std::string& config) {
  const fs::path folder = fs::absolute(selection.footsteps).lexically_normal();
  const fs::path csv = folder / (key.Name() + ".csv"), yaml = folder / (key.Name() + ".yaml");
  const std::string base = WithoutGoal(config, scene);
  if (fs::exists(yaml)) {
    const std::string text = ReadYamlFile(yaml.string());
    return {ParseConfig(yaml.string(), text + (text.ends_with('\n') ? "" : "\n") + base,
                        selection.overrides, selection.tools),
            {}};
  }
  if (!fs::exists(csv)) return {{}, "missing", "there are no footsteps"};
  ExperimentConfig read = ParseConfig(
      csv.string(), base + "footsteps_file: {path: " + InYaml(csv.filename().string()) + "}\n",
      selection.overrides, selection.tools);
  if (StartsElsewhere(ReadFootsteps(csv.string(), false, std::nullopt), read)) {
    return {{}, "other_start", "the feet start elsewhere than the scene has them"};
  }
  return {std::move(read), {}};
}

void CheckFootsteps(const BenchSelection& selection, const BenchSizes& sizes) {
  const fs::path folder = selection.footsteps;
  if (!fs::is_directory(folder)) {
    throw InputError({"--footsteps: " + Quote(selection.footsteps) +
                      ": no such folder (valid: a folder of NAME.csv or NAME.yaml)"});
  }
  std::set<std::string> names, all;
  Complaints complaints;
  for (const BenchKey& key : KeysOf(selection)) names.insert(key.Name());
  int found = 0;
  for (const BenchKey& key : KeysOf(selection)) {
    try {
      const std::string config = DrawBenchScene(key, sizes, selection.robot).config;
      if (ReadGivenFootsteps(selection, key, "none", config).status != "missing") ++found;
    } catch (const InputError& error) {
      complaints.Add(error.complaints());
    }
  }
  std::set<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.insert(entry.path());
  for (const fs::path& file : files) {
    const std::string ending = file.extension().string();
    if (ending != ".csv" && ending != ".yaml") continue;
    if (names.contains(file.stem().string())) continue;
    complaints.Add({file.string() + ": is of no scene that was chosen (valid: names that "
                                    "`halfstep bench --list` prints with the same options)"});
  }
  if (complaints.empty() && found == 0) {
    complaints.Add({"--footsteps: " + Quote(selection.footsteps) +
                    ": has footsteps of no scene (valid: files as " + *names.begin() + ".csv)"});
  }
  complaints.ThrowIfAny();
}

}  // namespace halfstep
