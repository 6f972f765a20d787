#include "wpg/files/yaml_fields.h"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>

#include "wpg/files/regular_file.h"
#include "wpg/files/yaml_node.h"
#include "wpg/files/yaml_reader.h"

namespace halfstep {

namespace {

bool IsUrdf(const std::string& path, std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n\xEF\xBB\xBF"), text.size()));
  return path.ends_with(".urdf") || text.starts_with("<?xml") || text.starts_with("<robot");
}

}  // namespace

std::string ReadYamlFile(const std::string& path, const YamlLimits& limits) {
  YamlComplaints complaints(path);
  FileBytes file = TryReadRegularFile(path, limits.bytes);
  if (!file.refused.empty()) complaints.Fail({}, "", file.refused);
  if (IsUrdf(path, file.bytes)) {
    complaints.Fail(
        {1, 1, ""}, "",
        "is a URDF (valid: YAML; `halfstep robot " + path + "` makes a robot file of it)");
  }
  return std::move(file.bytes);
}

void ReadYaml(const std::string& path, const std::vector<YamlOverride>& overrides,
              const std::function<void(Fields&)>& declare) {
  ReadYamlText(ReadYamlFile(path), path, std::filesystem::path(path).parent_path().string(),
               overrides, declare);
}

void ReadYamlText(const std::string& text, const std::string& name, const std::string& directory,
                  const std::vector<YamlOverride>& overrides,
                  const std::function<void(Fields&)>& declare, const YamlLimits& limits) {
  YamlComplaints complaints(name);
  YamlNode root = ParseYaml(text, "", &complaints, limits);
  if (root.kind != YamlNode::Kind::kMap) {
    complaints.Fail(root.place, "", "not a map: " + Describe(root) + " (valid: a map of keys)");
  }
  for (const YamlOverride& item : overrides) {
    if (item.leave_out) {
      RemoveYaml(item.key, &root);
    } else {
      OverrideYaml(item.key, item.value, &root, &complaints);
    }
  }
  YamlReader(&root, "", directory, &complaints).Run(declare);
  complaints.ThrowIfAny();
}

}  // namespace halfstep
