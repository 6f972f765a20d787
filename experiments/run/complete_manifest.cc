#include "experiments/run/complete_manifest.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "experiments/config/folder_name.h"
#include "wpg/files/input_error.h"
#include "wpg/files/regular_file.h"

namespace halfstep {
namespace {

using nlohmann::ordered_json;

constexpr char kManifest[] = "manifest.json";
constexpr std::uint64_t kMostManifestBytes = std::uint64_t{64} << 20;

ordered_json InputsJson(const std::vector<InputFile>& files) {
  ordered_json list = ordered_json::array();
  for (const InputFile& file : files) {
    list.push_back({{"name", file.name}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  }
  return list;
}

ordered_json Parsed(const std::string& path) {
  return ordered_json::parse(ReadRegularFile(path, kMostManifestBytes), nullptr,
                             /*allow_exceptions=*/false);
}

// What the certificate of each method says of its walk.
void TakeVerdicts(const RunFolder& folder, ordered_json* methods) {
  for (ordered_json& method : *methods) {
    if (!method.is_object() || !method.contains("name") || !method["name"].is_string()) continue;
    const std::string place = MethodFolder(method["name"].get<std::string>());
    const auto path = folder.staging() / place / "certificate.json";
    if (!std::filesystem::exists(path)) continue;
    const ordered_json certificate = Parsed(path.string());
    if (certificate.is_object()) method["verdict"] = certificate.value("verdict", ordered_json());
  }
}

}  // namespace

void CompleteManifest(const RobotModel& robot, const Scene& scene, RunFolder* folder) {
  const std::string path = (folder->staging() / kManifest).string();
  ordered_json manifest = Parsed(path);
  if (!manifest.is_object()) throw InputError({path + ": is no JSON object"});
  manifest["robot_sha256"] = CombinedSha256(robot.files);
  manifest["scene_sha256"] = CombinedSha256(scene.files);
  manifest["inputs"] = {{"robot", InputsJson(robot.files)}, {"scene", InputsJson(scene.files)}};
  if (manifest.contains("methods")) TakeVerdicts(*folder, &manifest["methods"]);
  if (!manifest["files"].is_object()) manifest["files"] = ordered_json::object();
  for (const auto& [name, file] : folder->written()) {
    if (name == kManifest) continue;
    manifest["files"][name] = {{"bytes", file.bytes}, {"sha256", file.sha256}};
  }
  folder->Write(kManifest,
                manifest.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace halfstep
