#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "experiments/config/key_tables.h"
#include "wpg/files/number_text.h"
#include "wpg/files/yaml_node.h"

namespace halfstep {
namespace {

using Kind = KeyDescription::Kind;
using nlohmann::ordered_json;

constexpr size_t kAnyNumber = std::numeric_limits<size_t>::max();

// A value of a file as JSON: numbers where they may stand, texts elsewhere.
ordered_json JsonOf(const YamlNode& node, bool numbers) {
  if (node.kind == YamlNode::Kind::kList) {
    ordered_json list = ordered_json::array();
    for (const YamlNode& item : node.items) list.push_back(JsonOf(item, numbers));
    return list;
  }
  const NumberText number = ParseNumber(node.text);
  if (!numbers || number.kind != NumberText::Kind::kNumber) return node.text;
  if (node.text.find_first_of(".eE") == std::string::npos) return std::llrint(number.extended);
  return number.value;
}

ordered_json DefaultOf(const KeyDescription& key) {
  if (key.kind == Kind::kBoolean) return key.default_text == "true";
  const bool texts = key.kind == Kind::kText || key.kind == Kind::kTexts;
  YamlComplaints none("");
  return JsonOf(ParseYaml(key.default_text, "", &none), !texts);
}

ordered_json NumberSchema(const KeyDescription& key, const char* type) {
  ordered_json schema = {{"type", type}};
  if (std::isfinite(key.min)) schema["minimum"] = key.min;
  if (std::isfinite(key.max)) schema["maximum"] = key.max;
  return schema;
}

// A text without choices may look like a number: 2026 is a name.
ordered_json TextSchema(const KeyDescription& key) {
  if (!key.choices.empty()) return {{"enum", key.choices}};
  return {{"type", {"string", "number", "boolean"}}};
}

ordered_json ListSchema(ordered_json items, size_t least, size_t most) {
  ordered_json schema = {{"type", "array"}, {"items", std::move(items)}};
  if (least > 0) schema["minItems"] = least;
  if (most != kAnyNumber) schema["maxItems"] = most;
  return schema;
}

ordered_json MapSchema(const std::vector<KeyDescription>& keys);

ordered_json TypeSchema(const KeyDescription& key) {
  switch (key.kind) {
    case Kind::kNumber:
      return NumberSchema(key, "number");
    case Kind::kOptionalNumber:
      return {{"anyOf", {NumberSchema(key, "number"), {{"enum", {"none", nullptr}}}}}};
    case Kind::kInteger:
      return NumberSchema(key, "integer");
    case Kind::kBoolean:
      return {{"type", "boolean"}};
    case Kind::kText:
      return TextSchema(key);
    case Kind::kTexts:
      return ListSchema(TextSchema(key), key.min_items, key.max_items);
    case Kind::kNumbers:
      return ListSchema(NumberSchema(key, "number"), key.min_items, key.max_items);
    case Kind::kPoints:
      return ListSchema(ListSchema(NumberSchema(key, "number"), 2, 2), key.min_items,
                        key.max_items);
    case Kind::kGroup:
      return MapSchema(key.keys);
    case Kind::kList:
      return ListSchema(MapSchema(key.keys), key.min_items, key.max_items);
  }
  return {};
}

ordered_json SchemaOf(const KeyDescription& key) {
  ordered_json schema = TypeSchema(key);
  std::string description = key.meaning;
  if (!key.unit.empty()) description += " [" + key.unit + "]";
  if (!key.otherwise.empty()) description += "; else " + key.otherwise;
  if (!description.empty()) schema["description"] = description;
  if (key.otherwise.empty() && !key.default_text.empty()) schema["default"] = DefaultOf(key);
  return schema;
}

ordered_json MapSchema(const std::vector<KeyDescription>& keys) {
  ordered_json schema = {{"type", "object"}, {"additionalProperties", false}};
  schema["properties"] = ordered_json::object();
  for (const KeyDescription& key : keys) {
    schema["properties"][key.key()] = SchemaOf(key);
    if (key.required) schema["required"].push_back(key.key());
  }
  return schema;
}

}  // namespace

std::string KeySchema(const std::string& title, const std::vector<KeyDescription>& keys) {
  ordered_json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}};
  schema.update(MapSchema(keys));
  return schema.dump(2) + "\n";
}

}  // namespace halfstep
