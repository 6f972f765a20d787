#include "experiments/tables/not_covered_json.h"

#include <optional>

#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

constexpr char kValid[] =
    " (valid: a list of kind, subject and sentence, as `halfstep run` writes)";

std::string TextOf(const nlohmann::json& object, const char* key, const std::string& path) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (!object.is_object() || found == object.end() || !found->is_string()) {
    throw InputError({path + ": not_covered: no text '" + key + "'" + kValid});
  }
  return found->get<std::string>();
}

}  // namespace

nlohmann::ordered_json NotCoveredJson(const std::vector<NotCovered>& list) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const NotCovered& one : list) {
    json.push_back(
        {{"kind", Name(one.kind)}, {"subject", one.subject}, {"sentence", one.sentence}});
  }
  return json;
}

std::vector<NotCovered> ReadNotCovered(const nlohmann::json& object, const std::string& path) {
  if (!object.is_object() || !object.contains("not_covered") || !object["not_covered"].is_array()) {
    throw InputError({path + ": not_covered: is missing" + kValid});
  }
  std::vector<NotCovered> list;
  for (const nlohmann::json& one : object["not_covered"]) {
    const std::string name = TextOf(one, "kind", path);
    const std::optional<NotCoveredKind> kind = NotCoveredKindOf(name);
    if (!kind) throw InputError({path + ": not_covered: kind: is none" + kValid});
    list.push_back({*kind, TextOf(one, "subject", path), TextOf(one, "sentence", path)});
  }
  return list;
}

}  // namespace halfstep
