#pragma once

#include <functional>
#include <string>
#include <vector>

#include "wpg/input/fields.h"

namespace halfstep {

/// Replaces the value of a dotted key: "smoothing.margins.clearance_m=0.02". List items by index.
struct YamlOverride {
  std::string key;
  std::string value;  ///< YAML text.
};

/// Reads a YAML file strictly through a declaration of its keys. Throws InputError with every
/// complaint at once: unknown key (with the nearest known one and the list), duplicate key, wrong
/// type, missing required key, not finite, out of range, more than one document, too large or too
/// many alias expansions. Overrides are checked as the file is; their place is "--set key".
void ReadYaml(const std::string& path, const std::vector<YamlOverride>& overrides,
              const std::function<void(Fields&)>& declare);
/// The same for text; `name` stands for the file in complaints, `directory` for its folder.
void ReadYamlText(const std::string& text, const std::string& name, const std::string& directory,
                  const std::vector<YamlOverride>& overrides,
                  const std::function<void(Fields&)>& declare);

/// Writes all declared keys with their present values as YAML text that ReadYamlText reads back to
/// the same values (doubles in shortest round-trip form).
std::string WriteYaml(const std::function<void(Fields&)>& declare);

}  // namespace halfstep
