#include "wpg/files/yaml_fields.h"

#include <filesystem>
#include <utility>

#include "wpg/files/regular_file.h"
#include "wpg/files/yaml_node.h"
#include "wpg/files/yaml_reader.h"

namespace halfstep {
namespace {

// yaml-cpp needs up to 240 bytes of memory for one of text.
constexpr std::uint64_t kMostYamlBytes = 4 << 20;

}  // namespace

std::string ReadYamlFile(const std::string& path) {
  YamlComplaints complaints(path);
  FileBytes file = TryReadRegularFile(path, kMostYamlBytes);
  if (!file.refused.empty()) complaints.Fail({}, "", file.refused);
  return std::move(file.bytes);
}

void ReadYaml(const std::string& path, const std::vector<YamlOverride>& overrides,
              const std::function<void(Fields&)>& declare) {
  ReadYamlText(ReadYamlFile(path), path, std::filesystem::path(path).parent_path().string(),
               overrides, declare);
}

void ReadYamlText(const std::string& text, const std::string& name, const std::string& directory,
                  const std::vector<YamlOverride>& overrides,
                  const std::function<void(Fields&)>& declare) {
  YamlComplaints complaints(name);
  YamlNode root = ParseYaml(text, "", &complaints);
  if (root.kind != YamlNode::Kind::kMap) {
    complaints.Fail(root.place, "", "not a map: " + Describe(root) + " (valid: a map of keys)");
  }
  for (const YamlOverride& item : overrides) OverrideYaml(item.key, item.value, &root, &complaints);
  YamlReader(&root, "", directory, &complaints).Run(declare);
  complaints.ThrowIfAny();
}

}  // namespace halfstep
