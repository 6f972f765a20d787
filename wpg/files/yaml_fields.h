#pragma once

#include <functional>
#include <string>
#include <vector>

#include "wpg/files/fields.h"
#include "wpg/files/yaml_node.h"

namespace halfstep {

/// Replaces the value of a dotted key: "smoothing.margins.clearance_m=0.02". List items by index.
struct YamlOverride {
  std::string key;         ///< dotted, from the root
  std::string value;       ///< YAML text.
  bool leave_out = false;  ///< no value: the key goes, with all below it
};

/// Reads a YAML file strictly through a declaration of its keys. Throws InputError with every
/// complaint at once, in the order of the file: unknown key (with the nearest known one and the
/// list), duplicate key, wrong type, missing required key, not finite, out of range, tags. What
/// leaves no tree to read is one complaint: a file that cannot be read or exceeds 4 MiB (of
/// ReadYamlFile: what `limits` says), bytes that
/// are not UTF-8, broken YAML, no or more than one document, an alias inside its own value, more
/// than 64 levels or 200,000 values (aliases expanded). Overrides are checked as the file is; their
/// place is "--set key".
/// Numbers are decimal and without quotes; what `declare` wrote is meaningless after a throw.
void ReadYaml(const std::string& path, const std::vector<YamlOverride>& overrides,
              const std::function<void(Fields&)>& declare);
/// The text of a YAML file, for ReadYamlText. Throws InputError as ReadYaml for what cannot be
/// read.
std::string ReadYamlFile(const std::string& path, const YamlLimits& limits = {});
/// The same as ReadYaml for text; `name` stands for the file in complaints, `directory` for its
/// folder.
void ReadYamlText(const std::string& text, const std::string& name, const std::string& directory,
                  const std::vector<YamlOverride>& overrides,
                  const std::function<void(Fields&)>& declare, const YamlLimits& limits = {});

/// Writes all declared keys with their present values as YAML text that ReadYamlText reads back to
/// the same values (doubles in shortest round-trip form).
std::string WriteYaml(const std::function<void(Fields&)>& declare);

}  // namespace halfstep
