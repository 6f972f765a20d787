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

std::string FileText(const std::string& path, YamlComplaints* complaints) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    complaints->Fail({}, "", "is a folder, not a file");
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file)
    complaints->Fail({}, "", "cannot be opened: " + std::generic_category().message(errno));
  std::string text(kMostBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad())
    complaints->Fail({}, "", "cannot be read: " + std::generic_category().message(errno));
  text.resize(static_cast<size_t>(file.gcount()));
  if (text.size() > kMostBytes) {
    complaints->Fail({}, "",
                     "too large (valid: at most " + std::to_string(kMostBytes >> 20) + " MiB)");
  }
  return text;
}

void Read(const std::string& text, const std::string& directory,
          const std::vector<YamlOverride>& overrides, const std::function<void(Fields&)>& declare,
          YamlComplaints* complaints) {
  YamlNode root = ParseYaml(text, "", complaints);
  if (root.kind != YamlNode::Kind::kMap) {
    complaints->Fail(root.place, "", "not a map: " + Describe(root) + " (valid: a map of keys)");
  }
  for (const YamlOverride& item : overrides) OverrideYaml(item.key, item.value, &root, complaints);
  YamlReader(&root, "", directory, complaints).Run(declare);
  complaints->ThrowIfAny();
}

}  // namespace

void ReadYaml(const std::string& path, const std::vector<YamlOverride>& overrides,
              const std::function<void(Fields&)>& declare) {
  YamlComplaints complaints(path);
  const std::string directory = std::filesystem::path(path).parent_path().string();
  Read(FileText(path, &complaints), directory, overrides, declare, &complaints);
}

void ReadYamlText(const std::string& text, const std::string& name, const std::string& directory,
                  const std::vector<YamlOverride>& overrides,
                  const std::function<void(Fields&)>& declare) {
  YamlComplaints complaints(name);
  Read(text, directory, overrides, declare, &complaints);
}

}  // namespace halfstep
