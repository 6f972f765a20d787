#include "experiments/verify/given_files.h"

#include <filesystem>

namespace halfstep::verify {

std::vector<YamlOverride> GivenFiles(const VerifyOptions& options) {
  const auto quoted = [](const std::string& path) {
    std::string yaml = "'";
    for (const char c : std::filesystem::absolute(path).string()) {
      yaml += c == '\'' ? std::string("''") : std::string(1, c);
    }
    return yaml + "'";
  };
  std::vector<YamlOverride> given;
  if (options.robot) given.push_back({"robot", quoted(*options.robot)});
  if (options.scene) {
    given.push_back({"scene", *options.scene == "none" ? "none" : quoted(*options.scene)});
  }
  return given;
}

}  // namespace halfstep::verify
