#include "experiments/verify/run_manifest.h"

#include <algorithm>

#include "experiments/verify/json_text.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"

namespace halfstep::verify {
namespace {

using nlohmann::json;

std::vector<InputFile> InputsOf(const std::string& path, const json& list) {
  std::vector<InputFile> files;
  for (const json& item : list) {
    const JsonMember member(path, item, "inputs");
    files.push_back(ListedFile(member, member.String("name")));
  }
  return files;
}

}  // namespace

InputFile ListedFile(const JsonMember& member, const std::string& name) {
  const long bytes = member.Whole("bytes");
  if (bytes < 0) member.Fail("bytes: is negative");
  return {.name = name,
          .path = "",
          .bytes = static_cast<size_t>(bytes),
          .sha256 = member.String("sha256")};
}

std::map<std::string, InputFile> ListedFiles(const JsonMember& root) {
  const JsonMember files = root.Object("files");
  std::map<std::string, InputFile> listed;
  for (const auto& [name, item] : files.object().items()) {
    listed[name] = ListedFile(files.Object(name), name);
  }
  return listed;
}

const RunManifest::Method* RunManifest::MethodOf(const std::string& folder) const {
  const auto found = std::find_if(methods.begin(), methods.end(), [&](const Method& method) {
    return FolderOfMethod(method.name) == folder;
  });
  return found == methods.end() ? nullptr : &*found;
}

RunManifest ReadManifest(const std::string& path, const std::string& text) {
  const json document = ParseJson(path, text);
  const JsonMember root(path, document, "");
  if (root.Whole("format") != 2) root.Fail("format: only 2 is known");
  if (root.String("program") != "halfstep") root.Fail("program: is not halfstep");
  RunManifest m{.name = root.String("name"),
                .robot = root.String("robot"),
                .scene = root.String("scene"),
                .objective = root.String("objective"),
                .acceptance = root.String("acceptance"),
                .config_sha256 = root.String("config_sha256"),
                .robot_sha256 = root.String("robot_sha256"),
                .scene_sha256 = root.String("scene_sha256"),
                .robot_files = InputsOf(path, root.Object("inputs").List("robot")),
                .scene_files = InputsOf(path, root.Object("inputs").List("scene")),
                .seed = root.Whole("seed"),
                .half_steps = root.Whole("half_steps"),
                .methods = {},
                .not_covered = NotCoveredItems(root),
                .files = ListedFiles(root)};
  for (const json& item : root.List("methods")) {
    const JsonMember method(path, item, "methods");
    m.methods.push_back({method.String("name"), method.String("status"),
                         item.contains("verdict") ? method.String("verdict") : "",
                         method.Number("duration_s")});
    const std::string& name = m.methods.back().name;
    if (name.empty() || name.front() == '.' || !NameMistake(name).empty()) {
      method.Fail("name: unfit: " + Quote(name));
    }
  }
  return m;
}

std::string FolderOfMethod(std::string method) {
  std::replace(method.begin(), method.end(), '/', '_');
  return method;
}

}  // namespace halfstep::verify
