#include "experiments/references/reference_folder.h"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "experiments/about/build_info.h"
#include "experiments/tables/certificate_statement.h"
#include "experiments/tables/csv_writer.h"
#include "experiments/tables/not_covered_json.h"
#include "smoothing/margins/not_covered_by.h"
#include "wpg/files/input_error.h"
#include "wpg/files/partial_sibling.h"
#include "wpg/files/regular_file.h"
#include "wpg/files/whole_file.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostManifestBytes = 16 << 20;
constexpr const char* kUnfinished = "unfinished";

[[noreturn]] void RefuseFolder(const fs::path& path, const std::string& what) {
  throw InputError({"--out: " + path.string() + ": " + what +
                    " (valid: a new folder, or one that the same command by the same program "
                    "began)"});
}

// Whether a folder is what a command left that was killed before its manifest was written: nothing
// is in it but what is partial. Then that is removed.
bool ClearIfBarelyBegun(const fs::path& path) {
  if (!fs::is_directory(path / kUnfinished)) return false;
  std::vector<fs::path> partial;
  for (const fs::directory_entry& entry : fs::directory_iterator(path)) {
    const std::string name = entry.path().filename().string();
    if (name == kUnfinished && entry.is_directory() && fs::is_empty(entry.path())) continue;
    if (!name.starts_with(".manifest.json.partial-")) return false;
    partial.push_back(entry.path());
  }
  for (const fs::path& file : partial) fs::remove(file);
  return true;
}

// Makes a folder that is begun, at once: an empty one would be somebody else's.
void BeginFolder(const fs::path& path) {
  fs::create_directories(path.parent_path());
  RemoveAbandonedSiblings(path.parent_path(), path.filename().string());
  PartialSibling begun(path, PartialSibling::Kind::kFolder);
  std::error_code error;
  fs::create_directory(begun.path() / kUnfinished, error);
  if (!error) {
    SyncFolder(begun.path() / kUnfinished, path);
    SyncFolder(begun.path(), path);
    fs::rename(begun.path(), path, error);
  }
  if (error) throw std::runtime_error(path.string() + ": cannot be made: " + error.message());
  begun.Release();
  SyncFolder(path.parent_path(), path);
}

}  // namespace

ReferenceFolder::ReferenceFolder(const fs::path& path, const std::string& manifest)
    : path_(fs::absolute(path).lexically_normal()) {
  if (!path_.has_filename()) path_ = path_.parent_path();  // a trailing slash
  if (fs::exists(fs::symlink_status(path_)) && !ClearIfBarelyBegun(path_)) {
    const FileBytes there =
        TryReadRegularFile((path_ / "manifest.json").string(), kMostManifestBytes);
    if (!there.refused.empty()) RefuseFolder(path_, "is there already");
    if (there.bytes != manifest) RefuseFolder(path_, "holds another set, or of another program");
    if (!fs::exists(path_ / kUnfinished)) RefuseFolder(path_, "is finished already");
    return;
  }
  if (!fs::exists(path_)) BeginFolder(path_);
  WriteWhole(path_ / "manifest.json", {manifest});
}

fs::path ReferenceFolder::RowPath(const std::string& name) const {
  return path_ / kUnfinished / (name + ".row");
}

bool ReferenceFolder::IsDone(const std::string& name) const { return fs::exists(RowPath(name)); }

void ReferenceFolder::Write(const std::string& name, const MadeReference& made) const {
  for (const ReferenceFile& file : made.files) WriteWhole(path_ / file.path, {file.bytes});
  WriteWhole(RowPath(name), {made.row});
}

std::uintmax_t ReferenceFolder::Finish(const CsvColumns& columns,
                                       const std::vector<std::string>& names) const {
  std::string text = CsvWriter(columns).text();
  for (const std::string& name : names) {
    text += ReadRegularFile(RowPath(name).string(), kMostManifestBytes);
  }
  WriteWhole(path_ / "index.schema.json", {SchemaJson(columns)});
  WriteWhole(path_ / "index.csv", {text});
  fs::remove_all(path_ / kUnfinished);
  std::uintmax_t bytes = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path_)) {
    if (entry.is_regular_file()) bytes += entry.file_size();
  }
  return bytes;
}

std::string ReferenceManifest(const ReferenceRequest& request, const ReferenceMaker& maker) {
  using nlohmann::ordered_json;
  const Experiment& experiment = maker.experiment();
  ordered_json demanded;
  for (const MarginFamily family : AllMarginFamilies()) {
    // References are of the flat floor, where this family is not.
    if (family == MarginFamily::kFoothold) continue;
    const double least = maker.limits().demanded_of(family);
    if (least != kNotDemanded) demanded[std::string(Name(family))] = least;
  }
  ordered_json set = ordered_json::object();
  for (const YamlOverride& one : request.overrides) set[one.key] = one.value;
  ordered_json manifest = {
      {"format", 1},
      {"program", "halfstep"},
      {"kind", "references"},
      {"version", kVersion},
      {"commit", kCommit},
      {"build_type", kBuildType},
      {"compiler", kCompiler},
      {"robot", request.robot},
      {"robot_sha256", CombinedSha256(experiment.robot.files)},
      {"method", request.method},
      {"formats", request.formats},
      {"fps", request.fps ? ordered_json(*request.fps) : ordered_json(nullptr)},
      {"set", set},
      {"count", request.count},
      {"seed", request.seed},
      {"statement",
       CertificateStatement(experiment.robot, maker.limits(), *experiment.scene.ground)},
      {"demanded", demanded},
      {"not_covered",
       NotCoveredJson(NotCoveredBy(experiment.robot, experiment.scene, maker.limits()))}};
  for (const auto& [library, version] : kLibraries) manifest["libraries"][library] = version;
  return manifest.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace halfstep
