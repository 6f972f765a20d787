#include "experiments/verify/given_files.h"

#include <filesystem>

namespace halfstep::verify {

YamlOverride NamedInstead(const char* key, const std::string& path) {
  std::string yaml = "'";
  for (const char c : std::filesystem::absolute(path).string()) {
    yaml += c == '\'' ? std::string("''") : std::string(1, c);
  }
  return {key, yaml + "'"};
}

std::vector<YamlOverride> GivenFiles(const VerifyOptions& options) {
  std::vector<YamlOverride> given;
  if (options.robot) given.push_back(NamedInstead("robot", *options.robot));
  if (options.scene && *options.scene != "none") {
    given.push_back(NamedInstead("scene", *options.scene));
  } else if (options.scene) {
    given.push_back({"scene", "none"});
  }
  return given;
}

}  // namespace halfstep::verify
