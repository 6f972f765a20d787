#include "experiments/sweep/sweep_folder.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string_view>
#include <tuple>

#include "experiments/about/build_info.h"
#include "experiments/config/experiment.h"
#include "experiments/sweep/sweep_tables.h"
#include "experiments/tables/csv_reader.h"
#include "experiments/tables/csv_writer.h"
#include "experiments/tables/json_file.h"
#include "experiments/tables/not_covered_json.h"
#include "wpg/files/input_error.h"
#include "wpg/files/nesting.h"
#include "wpg/files/partial_sibling.h"
#include "wpg/files/regular_file.h"
#include "wpg/files/sha256.h"
#include "wpg/files/whole_file.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

// "" when it cannot be read.
std::string Content(const fs::path& path) {
  return TryReadRegularFile(path.string(), std::uint64_t{1} << 30).bytes;
}

// SHA-256 over each other config that cases name, over the files of each robot and each scene, and
// over each file of footsteps.
ordered_json FilesOf(const SweepConfig& sweep) {
  constexpr std::string_view kFootsteps = "footsteps_file.path";
  std::vector<SweepCase> variants(1);
  std::map<std::string, std::string> hashes;
  std::set<fs::path> folders = {sweep.ConfigPath().parent_path()};  // of the configs
  for (const SweepAxis& axis : sweep.vary) {
    if (axis.key != "robot" && axis.key != "scene" && axis.key != kConfigKey) continue;
    for (const std::string& value : axis.values) {
      variants.push_back({"", {{axis.key, value}}});
      if (axis.key == kConfigKey) {
        hashes[value] = Sha256(ReadYamlFile(sweep.ConfigPath(value).string()));
        folders.insert(sweep.ConfigPath(value).parent_path());
      }
    }
  }
  for (const SweepCase& variant : variants) {
    const ExperimentConfig config = LoadCase(sweep, variant);
    const Place place = LoadPlace(config);
    hashes[config.robot] = CombinedSha256(place.robot.files);
    hashes[config.scene] = CombinedSha256(place.scene.files);
    if (config.footsteps_file) hashes[config.footsteps_file->name] = config.footsteps_file->sha256;
  }
  for (const SweepAxis& axis : sweep.vary) {
    if (axis.key != kFootsteps) continue;
    for (const std::string& value : axis.values) {
      std::string bytes;
      for (const fs::path& folder : folders) bytes += Content(folder / value);
      hashes[value] = Sha256(bytes);
    }
  }
  return hashes;
}

std::string HashOfCases(const SweepConfig& sweep) {
  std::string cases;
  for (const SweepCase& one : SweepCases(sweep)) cases += one.id + " " + OverrideText(one) + "\n";
  return Sha256(cases);
}

std::string Resolved(const fs::path& folder, const SweepConfig& sweep) {
  SweepConfig moved = sweep;
  moved.config = fs::proximate(sweep.ConfigPath(), folder).string();
  return WriteYaml([&](Fields& fields) { DeclareFields(fields, &moved); });
}

// The same from the folder of a sweep that was begun with the same sweep.yaml, which says the
// cases; the workers of a large sweep need not list them all.
std::string KnownHashOfCases(const fs::path& folder, const SweepConfig& sweep) {
  const std::string text = Content(folder / "manifest.json");
  if (text.empty() || JsonDepth(text) > kMostJsonLevels) return "";
  const ordered_json there = ordered_json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!there.is_object() || Content(folder / "sweep.yaml") != Resolved(folder, sweep)) return "";
  const auto hash = there.find("cases_sha256");
  return hash != there.end() && hash->is_string() ? hash->get<std::string>() : "";
}

// Text of manifest.json: what a sweep is, and nothing that another run of it would not say.
std::string Definition(const fs::path& folder, const SweepConfig& sweep) {
  std::vector<std::string> keys;
  for (const SweepAxis& axis : sweep.vary) keys.push_back(axis.key);
  const std::string known = KnownHashOfCases(folder, sweep);
  ordered_json manifest = {{"format", 1},
                           {"program", "halfstep"},
                           {"kind", "sweep"},
                           {"version", kVersion},
                           {"commit", kCommit},
                           {"build_type", kBuildType},
                           {"compiler", kCompiler},
                           {"name", sweep.name},
                           {"keep", sweep.keep},
                           {"keys", keys},
                           {"cases", NumSweepCases(sweep)},
                           {"cases_sha256", known.empty() ? HashOfCases(sweep) : known},
                           {"config_sha256", Sha256(ReadYamlFile(sweep.ConfigPath().string()))},
                           {"files_sha256", FilesOf(sweep)}};
  for (const auto& [library, version] : kLibraries) manifest["libraries"][library] = version;
  return manifest.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string Difference(const std::string& there, const std::string& wanted) {
  if (JsonDepth(there) > kMostJsonLevels) return "is the folder of no sweep";
  const ordered_json a = ordered_json::parse(there, nullptr, /*allow_exceptions=*/false);
  const ordered_json b = ordered_json::parse(wanted);
  if (!a.is_object() || a.value("kind", "") != "sweep") return "is the folder of no sweep";
  for (const auto& [key, value] : b.items()) {
    if (a.contains(key) && a[key] == value) continue;
    const std::string what = key == "cases_sha256" || key == "cases" || key == "keys"
                                 ? "other cases"
                             : key == "config_sha256" ? "another config"
                             : key == "files_sha256"  ? "another robot, scene or footsteps file"
                                                      : "another " + key;
    return "holds a sweep of " + what;
  }
  return "holds another sweep";
}

void CheckPlace(const fs::path& path, const std::string& manifest) {
  const fs::path older = path / "manifest.json";
  std::error_code ignored;
  std::string complaint;
  if (fs::exists(older)) {
    const std::string there = Content(older);
    if (there != manifest) complaint = Difference(there, manifest);
  } else if (fs::exists(path)) {
    static const std::set<std::string> kOwn = {"cases", "sweep.yaml"};
    for (const auto& entry : fs::directory_iterator(path, ignored)) {
      const std::string name = entry.path().filename().string();
      if (!kOwn.contains(name) && !name.starts_with('.')) complaint = "is the folder of no sweep";
    }
    if (!fs::is_directory(path)) complaint = "is no folder";
  }
  if (complaint.empty()) return;
  throw InputError(
      {"--out: " + path.string() + ": " + complaint +
       " (valid: a new folder, or one that the same sweep by the same program began)"});
}

}  // namespace

SweepFolder::SweepFolder(const fs::path& path, const SweepConfig& sweep)
    : path_(fs::absolute(path).lexically_normal()),
      sweep_(sweep),
      runs_(EmptyRuns(sweep)),
      timings_(EmptyTimings()),
      runs_schema_(SchemaJson(runs_.columns)),
      timings_schema_(SchemaJson(timings_.columns)) {
  if (!path_.has_filename()) path_ = path_.parent_path();  // a trailing slash
  const std::string manifest = Definition(path_, sweep_);
  CheckPlace(path_, manifest);
  std::error_code error;
  fs::create_directories(path_ / "cases", error);
  if (error) {
    throw std::runtime_error(path_.string() + ": cannot make the folder: " + error.message());
  }
  if (Content(path_ / "manifest.json") == manifest) return;
  try {
    WriteWhole(path_ / "sweep.yaml", {Resolved(path_, sweep_)});
    WriteWhole(path_ / "manifest.json", {manifest});
  } catch (const std::runtime_error&) {
    // Another machine may begin the same sweep at this moment.
    if (Content(path_ / "manifest.json") != manifest) throw;
  }
}

bool SweepFolder::IsDone(const SweepCase& one) const {
  const fs::path place = CasePath(one);
  if (!fs::exists(place / "config.yaml")) return false;
  for (const auto& [name, empty, schema] : {std::tuple{"runs", &runs_, &runs_schema_},
                                            std::tuple{"timings", &timings_, &timings_schema_}}) {
    const std::string file = (place / name).string();
    const std::string text = Content(file + ".csv");
    if (!text.starts_with(empty->text)) return false;
    if (Content(file + ".schema.json") != *schema) return false;
    try {
      const CsvTable table = ParseCsv(text, file + ".csv");
      if (table.rows.empty()) return false;
      for (const std::string& id : table.Texts("case")) {
        if (id != one.id) return false;
      }
    } catch (const InputError&) {
      return false;
    }
  }
  return true;
}

std::vector<SweptNotCovered> SweepFolder::NotCoveredOf(const std::vector<SweepCase>& cases) const {
  std::vector<SweptNotCovered> all;
  for (const SweepCase& one : cases) {
    const fs::path path = CasePath(one) / "not_covered.json";
    if (!fs::exists(path)) continue;  // a case without a walk
    for (const NotCovered& thing : ReadNotCovered(ReadJsonObject(path), path.string())) {
      const auto known = std::ranges::find(all, thing, &SweptNotCovered::thing);
      if (known == all.end()) {
        all.push_back({thing, 1});
      } else {
        ++known->cases;
      }
    }
  }
  return all;
}

std::string SweepFolder::Collect(const std::vector<SweepCase>& cases) const {
  std::string runs = runs_.text, timings = timings_.text;
  for (const SweepCase& one : cases) {
    runs += Content(CasePath(one) / "runs.csv").substr(runs_.text.size());
    timings += Content(CasePath(one) / "timings.csv").substr(timings_.text.size());
  }
  ordered_json not_covered = ordered_json::array();
  for (const SweptNotCovered& one : NotCoveredOf(cases)) {
    not_covered.push_back(NotCoveredJson({one.thing})[0]);
    not_covered.back()["cases"] = one.cases;
  }
  RemoveAbandonedSiblings(path_ / "cases", "");
  WriteWhole(path_ / "not_covered.json",
             {ordered_json({{"not_covered", not_covered}})
                  .dump(2, ' ', false, ordered_json::error_handler_t::replace) +
              "\n"});
  WriteWhole(path_ / "runs.schema.json", {runs_schema_});
  WriteWhole(path_ / "timings.schema.json", {timings_schema_});
  WriteWhole(path_ / "timings.csv", {timings});
  WriteWhole(path_ / "runs.csv", {runs});
  return runs;
}

}  // namespace halfstep
