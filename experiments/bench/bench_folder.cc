#include "experiments/bench/bench_folder.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "experiments/about/build_info.h"
#include "experiments/config/folder_name.h"
#include "experiments/tables/csv_reader.h"
#include "experiments/tables/csv_writer.h"
#include "wpg/files/input_error.h"
#include "wpg/files/regular_file.h"
#include "wpg/files/sha256.h"
#include "wpg/files/whole_file.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using enum CsvType;

constexpr std::uint64_t kMostBytes = std::uint64_t{64} << 20;

CsvColumns TimingColumns() {
  return {{"case", kString, "", "scene and who answers it"},
          {"machine_plan_wall_s", kNumber, "s", "of planning, by this machine's clock; 0: none"}};
}

std::optional<double> IfFinite(double value) {
  return std::isfinite(value) && value > 0.0 ? std::optional(value) : std::nullopt;
}

// Of the files that --footsteps has.
std::string HashOfFootsteps(const BenchSelection& selection) {
  std::string bytes;
  for (const BenchKey& key : KeysOf(selection)) {
    for (const char* ending : {".csv", ".yaml"}) {
      const fs::path file = fs::path(selection.footsteps) / (key.Name() + ending);
      bytes += key.Name() + ending + TryReadRegularFile(file.string(), kMostBytes).bytes;
    }
  }
  return Sha256(bytes);
}

// What a benchmark is of, and nothing that another run of it would not say.
std::string DefinitionOf(const BenchSelection& selection, const RobotModel& robot) {
  nlohmann::ordered_json set = nlohmann::ordered_json::object();
  for (const YamlOverride& one : selection.overrides) set[one.key] = one.value;
  nlohmann::ordered_json manifest = {{"format", 1},
                                     {"program", "halfstep"},
                                     {"kind", "bench"},
                                     {"version", kVersion},
                                     {"commit", kCommit},
                                     {"build_type", kBuildType},
                                     {"compiler", kCompiler},
                                     {"robot", robot.name},
                                     {"robot_sha256", CombinedSha256(robot.files)},
                                     {"kinds", selection.kinds},
                                     {"difficulties", selection.difficulties},
                                     {"seeds", selection.seeds},
                                     {"planners", selection.planners},
                                     {"set", set}};
  if (!selection.footsteps.empty()) manifest["footsteps_sha256"] = HashOfFootsteps(selection);
  return manifest.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

CsvColumns BenchColumns() {
  return {{"case", kString, "", "scene and who answers it"},
          {"kind", kString, "", "below, beside, overhead or mix"},
          {"difficulty", kInteger, "", "1 to 5"},
          {"seed", kInteger, "", "of the scene"},
          {"planner", kString, "", "a planner's name; footsteps: from elsewhere"},
          {"bar_m", kNumber, "m", "top of the highest bar across; empty: none"},
          {"gap_m", kNumber, "m", "breadth of the narrowest doorway; empty: none"},
          {"headroom_m", kNumber, "m", "height below the lowest beam across; empty: none"},
          {"status", kString, "", "solved, or why not"},
          {"solved", kBoolean, "", "whether certified half-steps lead into the goal"},
          {"footsteps", kInteger, "", "0 unless solved"},
          {"raw_s", kNumber, "s", "duration of the half-steps one after the other"},
          {"smoothed_s", kNumber, "s", "duration of the smoothed walk; empty: none is certified"},
          {"certified", kBoolean, "", "that walk, for all t"},
          {"nodes", kInteger, "", "of the planner"},
          {"effort", kNumber, "", "counted work of the planner; 1 is about a second of one core"},
          {"crouch_m", kNumber, "m", "how far the waist is below where it stands upright, at most"},
          {"message", kString, "", "in words"}};
}

BenchFolder::BenchFolder(const fs::path& path, const BenchSelection& selection,
                         const RobotModel& robot)
    : path_(fs::absolute(path).lexically_normal()), sizes_(BenchSizesOf(robot)) {
  if (!path_.has_filename()) path_ = path_.parent_path();  // a trailing slash
  const std::string manifest = DefinitionOf(selection, robot);
  const fs::path file = path_ / "manifest.json";
  std::error_code error;
  if (fs::exists(fs::symlink_status(path_))) {
    const FileBytes there = TryReadRegularFile(file.string(), kMostBytes);
    if (there.bytes != manifest && !fs::is_empty(path_, error)) {
      throw InputError({"--out: " + path_.string() +
                        ": holds something else, or a benchmark of other choices (valid: a new "
                        "folder, or one that the same command by the same program began)"});
    }
  }
  fs::create_directories(path_ / "cases", error);
  if (error) {
    throw std::runtime_error(path_.string() + ": cannot make the folder: " + error.message());
  }
  WriteWhole(file, {manifest});
  WriteBenchScenes(selection, sizes_, scenes());
}

bool BenchFolder::IsDone(const BenchCase& one) const {
  try {
    const CsvTable table = ReadCsv(CasePath(one, ".csv").string());
    const CsvTable timing = ReadCsv(CasePath(one, "_timing.csv").string());
    return table.rows.size() == 1 && timing.rows.size() == 1 && table.Texts("case")[0] == one.Id();
  } catch (const InputError&) {
    return false;
  }
}

void BenchFolder::Write(const BenchCase& one, const BenchRow& row) const {
  const BenchScene scene = DrawBenchScene(one.key, sizes_, "hrp2");
  if (!row.footsteps_yaml.empty()) {
    WriteWhole(path_ / "footsteps" / MethodFolder(one.planner) / (one.key.Name() + ".yaml"),
               {row.footsteps_yaml});
  }
  CsvWriter timing(TimingColumns());
  timing.Cell(one.Id()).Cell(std::isfinite(row.wall) ? row.wall : 0.0).EndRow();
  WriteWhole(CasePath(one, "_timing.csv"), {timing.text()});
  CsvWriter csv(BenchColumns());
  csv.Cell(one.Id()).Cell(one.key.kind).Cell(one.key.difficulty).Cell(one.key.seed);
  csv.Cell(one.planner).Cell(IfFinite(scene.bar)).Cell(IfFinite(scene.gap));
  csv.Cell(IfFinite(scene.headroom)).Cell(row.status).Cell(row.status == "solved");
  csv.Cell(row.footsteps).Cell(row.raw).Cell(row.smoothed).Cell(row.certified);
  csv.Cell(static_cast<long>(row.nodes)).Cell(row.effort).Cell(row.crouch).Cell(row.message);
  csv.EndRow();
  WriteWhole(CasePath(one, ".csv"), {csv.text()});
}

std::string BenchFolder::Collect(const std::vector<BenchCase>& cases) const {
  const std::string bench = CsvWriter(BenchColumns()).text(),
                    timing = CsvWriter(TimingColumns()).text();
  std::string all = bench, timings = timing;
  for (const BenchCase& one : cases) {
    all += ReadCsvText(CasePath(one, ".csv").string()).substr(bench.size());
    timings += ReadCsvText(CasePath(one, "_timing.csv").string()).substr(timing.size());
  }
  WriteWhole(path_ / "timings.schema.json", {SchemaJson(TimingColumns())});
  WriteWhole(path_ / "timings.csv", {timings});
  WriteWhole(path_ / "bench.schema.json", {SchemaJson(BenchColumns())});
  WriteWhole(path_ / "bench.csv", {all});
  return all;
}

CsvFile BenchScenesCsv(const BenchSelection& selection, const BenchSizes& sizes) {
  CsvWriter csv({{"name", kString, "", "of the scene and its files"},
                 {"kind", kString, "", "below, beside, overhead or mix"},
                 {"difficulty", kInteger, "", "1 to 5"},
                 {"seed", kInteger, "", "of the draw"},
                 {"bar_m", kNumber, "m", "top of the highest bar across; empty: none"},
                 {"gap_m", kNumber, "m", "breadth of the narrowest doorway; empty: none"},
                 {"headroom_m", kNumber, "m", "height below the lowest beam across; empty: none"}});
  for (const BenchKey& key : KeysOf(selection)) {
    const BenchScene scene = DrawBenchScene(key, sizes, selection.robot);
    csv.Cell(key.Name()).Cell(key.kind).Cell(key.difficulty).Cell(key.seed);
    csv.Cell(IfFinite(scene.bar)).Cell(IfFinite(scene.gap)).Cell(IfFinite(scene.headroom)).EndRow();
  }
  return csv.file();
}

void WriteBenchScenes(const BenchSelection& selection, const BenchSizes& sizes,
                      const fs::path& folder) {
  for (const BenchKey& key : KeysOf(selection)) {
    const BenchScene scene = DrawBenchScene(key, sizes, selection.robot);
    WriteWhole(folder / (key.Name() + "_scene.yaml"), {scene.scene});
    WriteWhole(folder / (key.Name() + ".yaml"), {scene.config});
  }
  const CsvFile table = BenchScenesCsv(selection, sizes);
  WriteWhole(folder / "scenes.schema.json", {SchemaJson(table.columns)});
  WriteWhole(folder / "scenes.csv", {table.text});
}

}  // namespace halfstep
