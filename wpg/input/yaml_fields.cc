#include "wpg/input/yaml_fields.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "wpg/input/yaml_node.h"
#include "wpg/input/yaml_reader.h"

namespace halfstep {
namespace {

// yaml-cpp needs up to 240 bytes of memory for one of text.
constexpr size_t kMostBytes = 4 << 20;

}  // namespace

std::string ReadYamlFile(const std::string& path) {
  YamlComplaints complaints(path);
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    complaints.Fail({}, "", "is a folder, not a file");
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) complaints.Fail({}, "", "cannot be opened: " + std::generic_category().message(errno));
  std::string text(kMostBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad())
    complaints.Fail({}, "", "cannot be read: " + std::generic_category().message(errno));
  text.resize(static_cast<size_t>(file.gcount()));
  if (text.size() > kMostBytes) {
    complaints.Fail({}, "",
                    "too large (valid: at most " + std::to_string(kMostBytes >> 20) + " MiB)");
  }
  return text;
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
