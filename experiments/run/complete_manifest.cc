#include "experiments/run/complete_manifest.h"

#include <nlohmann/json.hpp>

#include "wpg/files/input_error.h"
#include "wpg/files/regular_file.h"

namespace halfstep {
namespace {

using nlohmann::ordered_json;

constexpr char kManifest[] = "manifest.json";
constexpr std::uint64_t kMostManifestBytes = std::uint64_t{16} << 20;

ordered_json InputsJson(const std::vector<InputFile>& files) {
  ordered_json list = ordered_json::array();
  for (const InputFile& file : files) {
    list.push_back({{"name", file.name}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  }
  return list;
}

}  // namespace

void CompleteManifest(const RobotModel& robot, const Scene& scene, RunFolder* folder) {
  const std::string path = (folder->staging() / kManifest).string();
  ordered_json manifest = ordered_json::parse(ReadRegularFile(path, kMostManifestBytes), nullptr,
                                              /*allow_exceptions=*/false);
  if (!manifest.is_object()) throw InputError({path + ": is no JSON object"});
  manifest["robot_sha256"] = CombinedSha256(robot.files);
  manifest["scene_sha256"] = CombinedSha256(scene.files);
  manifest["inputs"] = {{"robot", InputsJson(robot.files)}, {"scene", InputsJson(scene.files)}};
  if (!manifest["files"].is_object()) manifest["files"] = ordered_json::object();
  for (const auto& [name, file] : folder->written()) {
    if (name == kManifest) continue;
    manifest["files"][name] = {{"bytes", file.bytes}, {"sha256", file.sha256}};
  }
  folder->Write(kManifest,
                manifest.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace halfstep
