#include "experiments/tables/run_record.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "experiments/config/folder_name.h"
#include "experiments/tables/csv_reader.h"
#include "experiments/tables/json_file.h"
#include "experiments/tables/not_covered_json.h"
#include "wpg/files/input_error.h"
#include "wpg/files/sha256.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

[[noreturn]] void Refuse(const fs::path& path, const std::string& what) {
  throw InputError({path.string() + ": " + what});
}

const json& Member(const json& object, const char* key, const fs::path& path) {
  if (!object.is_object() || !object.contains(key)) {
    Refuse(path, std::string("no '") + key + "' (valid: a run of this version of halfstep)");
  }
  return object[key];
}

std::string TextOf(const json& object, const char* key, const fs::path& path) {
  const json& value = Member(object, key, path);
  if (!value.is_string()) Refuse(path, std::string("'") + key + "' is no text");
  return value.get<std::string>();
}

// Splits LABEL=RUN; an argument that is a folder is one.
std::pair<std::string, std::string> LabelAndRun(const std::string& argument) {
  const size_t equals = argument.find('=');
  if (equals == std::string::npos || fs::is_directory(argument)) return {"", argument};
  const std::string label = argument.substr(0, equals);
  const bool plain = !label.empty() && !LooksLikeFormula(label) &&
                     std::all_of(label.begin(), label.end(), [](unsigned char c) {
                       return (c < 128 && std::isalnum(c)) || c == '_' || c == '.' || c == '-';
                     });
  if (!plain) {
    throw InputError({argument + ": the label " + Quote(label) +
                      " is not plain (valid: letters, digits, '_', '.', '-', but '-' not first)"});
  }
  return {label, argument.substr(equals + 1)};
}

// Names go into folder names, tables and scripts.
void CheckWord(const std::string& word, const char* what, const fs::path& path) {
  const bool plain = !word.empty() && !LooksLikeFormula(word) &&
                     std::all_of(word.begin(), word.end(), [](unsigned char c) {
                       return c > 32 && c < 127 && c != ',' && c != '"' && c != '\'' && c != '\\';
                     });
  if (!plain || word.find("..") != std::string::npos || word.front() == '/') {
    Refuse(path, Quote(word) + " cannot be " + what);
  }
}

std::vector<double> NotNegative(const CsvTable& table, const char* column) {
  std::vector<double> numbers = table.Numbers(column);
  for (size_t i = 0; i < numbers.size(); ++i) {
    if (std::isfinite(numbers[i]) && numbers[i] >= 0.0) continue;
    throw InputError({table.path + ":" + std::to_string(i + 2) + ": " + column +
                      ": out of range (valid: finite, not negative)"});
  }
  return numbers;
}

std::vector<IncumbentRecord> ReadIncumbents(const fs::path& folder) {
  const fs::path path = folder / "iterates.csv";
  const CsvTable table = ReadCsv(path.string());
  const std::vector<double> walls = NotNegative(table, "wall_s");
  const std::vector<double> instants = NotNegative(table, "instants");
  const std::vector<double> efforts = NotNegative(table, "effort");
  const std::vector<double> durations = NotNegative(table, "incumbent_duration_s");
  std::vector<IncumbentRecord> incumbents;
  for (size_t i = 0; i < walls.size(); ++i) {
    incumbents.push_back({walls[i], instants[i], efforts[i], durations[i]});
  }
  return incumbents;
}

// The rows of summary.csv.
std::vector<MethodRecord> ReadSummary(const fs::path& run, const std::string& label) {
  const CsvTable table = ReadCsv((run / "summary.csv").string());
  const std::vector<std::string> names = table.Texts("method"), statuses = table.Texts("status"),
                                 certified = table.Texts("certified");
  const std::vector<double> durations = NotNegative(table, "duration_s"),
                            speedups = NotNegative(table, "speedup"), costs = table.Numbers("cost"),
                            instants = NotNegative(table, "instants"),
                            efforts = NotNegative(table, "effort"),
                            queries = NotNegative(table, "collision_queries"),
                            walls = NotNegative(table, "wall_s");
  const std::vector<std::optional<double>> gaps = table.NumbersOrEmpty("gap_to_reference");
  std::vector<std::optional<double>> above;
  if (table.Has("gap_lipm")) above = table.NumbersOrEmpty("gap_lipm");
  std::vector<MethodRecord> methods;
  for (size_t i = 0; i < names.size(); ++i) {
    const std::string line = table.path + ":" + std::to_string(i + 2);
    CheckWord(names[i], "a method's name", line);
    const std::optional<opt::Ending> ending = opt::EndingOf(statuses[i]);
    if (!ending)
      Refuse(line, "status: " + Quote(statuses[i]) + " (valid: " + opt::EndingNames() + ")");
    if (certified[i] != "true" && certified[i] != "false") {
      Refuse(line, "certified: " + Quote(certified[i]) + " (valid: true, false)");
    }
    if (!(durations[i] > 0.0)) Refuse(line, "duration_s: 0 (valid: above 0)");
    if (!(speedups[i] > 0.0)) Refuse(line, "speedup: 0 (valid: above 0)");
    if (!std::isfinite(costs[i])) Refuse(line, "cost: not finite");
    MethodRecord& method = methods.emplace_back();
    method.name = label.empty() || names[i] == "raw" ? names[i] : label + ":" + names[i];
    method.ending = *ending;
    method.certified = certified[i] == "true";
    method.duration = durations[i];
    method.speedup = speedups[i];
    method.cost = costs[i];
    method.gap_to_reference = gaps[i];
    if (!above.empty()) method.gap_lipm = above[i];
    method.instants = instants[i];
    method.effort = efforts[i];
    method.collision_queries = queries[i];
    method.wall = walls[i];
    const fs::path folder = run / MethodFolder(names[i]);
    if (names[i] != "raw") {
      method.incumbents = ReadIncumbents(folder);
    } else if (i > 0) {
      Refuse(line, "raw is not the first (valid: once, first)");
    }
    for (size_t before = 0; before < i; ++before) {
      if (names[before] == names[i]) Refuse(line, "the method is there twice");
    }
  }
  if (methods.empty() || !methods.front().raw()) Refuse(table.path, "no row of raw");
  return methods;
}

// What the manifest says of the methods goes with the rows of the summary.
void AddRequested(const json& manifest, const fs::path& path, const std::string& label,
                  std::vector<MethodRecord>* methods) {
  const json& entries = Member(manifest, "methods", path);
  if (!entries.is_array() || entries.size() != methods->size()) {
    Refuse(path, "its methods are not those of summary.csv");
  }
  for (size_t i = 0; i < methods->size(); ++i) {
    MethodRecord& method = (*methods)[i];
    const std::string name = TextOf(entries[i], "name", path);
    if (method.name != (label.empty() || method.raw() ? name : label + ":" + name)) {
      Refuse(path, "its methods are not those of summary.csv");
    }
    const json& requested = Member(entries[i], "requested", path);
    method.requested = requested.dump();
    method.message = TextOf(entries[i], "message", path);
    if (method.raw()) continue;
    method.variables = TextOf(requested, "variables", path);
    CheckWord(method.variables, "variables", path);
    // Dichotomies and the like know no other objective than their default.
    if (requested.contains("objective")) method.objective = TextOf(requested, "objective", path);
    CheckWord(method.objective, "an objective", path);
  }
}

// See RunRecord::problem.
std::string ProblemOf(const json& manifest, const fs::path& run, const fs::path& path) {
  const fs::path claims = run / "raw" / "certificate.json";
  const json certificate = ReadJsonObject(claims);
  std::string text = ReadCsvText((run / "footsteps.csv").string());
  text += TextOf(manifest, "robot_sha256", path);
  text += TextOf(manifest, "scene_sha256", path);
  text += Member(certificate, "demanded", claims).dump();
  text += Member(certificate, "limits", claims).dump();
  return Sha256(text);
}

bool IsOfKind(const fs::path& folder, const char* kind) {
  const fs::path path = folder / "manifest.json";
  if (!fs::exists(path)) return false;
  const json manifest = ReadJsonObject(path);
  return manifest.contains("kind") && manifest["kind"] == kind;
}

}  // namespace

bool IsEpisode(const fs::path& folder) { return IsOfKind(folder, "episode"); }

bool IsSweep(const fs::path& folder) { return IsOfKind(folder, "sweep"); }

RunRecord ReadRun(const std::string& argument) {
  const auto [label, folder] = LabelAndRun(argument);
  const fs::path run(folder);
  const fs::path path = run / "manifest.json";
  if (!fs::is_directory(run) || !fs::exists(path)) {
    throw InputError({folder + ": no such run folder (" + DidYouMeanRun(folder) +
                      "valid: a folder that `halfstep run` wrote)"});
  }
  const std::string text = ReadJsonText(path);
  const json manifest = ParseJsonObject(text, path);
  if (IsEpisode(run)) {
    throw InputError({folder + ": is the folder of an episode (valid: a run folder; `halfstep "
                               "report`, `verify` and `replay` take episodes)"});
  }
  if (IsSweep(run)) {
    throw InputError({folder + ": is the folder of a sweep (valid: a run folder, as cases/ID of a "
                               "sweep with keep: all; `halfstep report` takes sweeps)"});
  }
  RunRecord record;
  record.run = folder;
  record.scenario = TextOf(manifest, "name", path);
  if (HasControlCharacter(record.scenario)) Refuse(path, "'name' holds a control character");
  if (LooksLikeFormula(record.scenario)) Refuse(path, "'name' would be taken for a formula");
  record.objective = TextOf(manifest, "objective", path);
  CheckWord(record.objective, "an objective", path);
  const json& half_steps = Member(manifest, "half_steps", path);
  if (!half_steps.is_number_integer()) Refuse(path, "'half_steps' is no integer");
  record.half_steps = half_steps.get<int>();
  record.manifest_sha256 = Sha256(text);
  record.problem = ProblemOf(manifest, run, path);
  const fs::path claims = run / "raw" / "certificate.json";
  record.not_covered = ReadNotCovered(ReadJsonObject(claims), claims.string());
  record.methods = ReadSummary(run, label);
  AddRequested(manifest, path, label, &record.methods);
  for (MethodRecord& method : record.methods) {
    method.run = folder;
    if (method.objective == "fastest") method.cost = method.duration;  // by definition
  }
  return record;
}

}  // namespace halfstep
