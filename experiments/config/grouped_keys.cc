#include "experiments/config/grouped_keys.h"

#include <algorithm>
#include <string>

#include "wpg/files/suggestion.h"

namespace halfstep {
namespace {

// Paths that end with the key, those of lists left out.
void FindPaths(const std::vector<KeyDescription>& keys, const std::string& key,
               std::vector<std::string>* found) {
  for (const KeyDescription& one : keys) {
    if (one.kind == KeyDescription::Kind::kList) continue;
    if (one.path.ends_with("." + key)) found->push_back(one.path);
    FindPaths(one.keys, key, found);
  }
}

}  // namespace

void RefuseKeysOfGroups(Fields& fields, const std::vector<KeyDescription>& keys) {
  for (const std::string& key : fields.Keys()) {
    if (std::ranges::find(keys, key, &KeyDescription::path) != keys.end()) continue;
    if (key == "half_steps") continue;  // an old name, which is told
    std::vector<std::string> paths;
    FindPaths(keys, key, &paths);
    if (paths.empty()) continue;
    fields.Misplaced(key.c_str(), "belongs into a group (valid: " + Joined(paths) + ")");
  }
}

}  // namespace halfstep
