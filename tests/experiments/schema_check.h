#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "wpg/files/number_text.h"
#include "wpg/files/yaml_node.h"

namespace halfstep {

/// A YAML tree as JSON, as an editor would see it.
inline nlohmann::json JsonOfYaml(const YamlNode& node) {
  nlohmann::json value;
  switch (node.kind) {
    case YamlNode::Kind::kNull:
      return nullptr;
    case YamlNode::Kind::kList:
      value = nlohmann::json::array();
      for (const YamlNode& item : node.items) value.push_back(JsonOfYaml(item));
      return value;
    case YamlNode::Kind::kMap:
      value = nlohmann::json::object();
      for (const YamlNode& item : node.items) value[item.key] = JsonOfYaml(item);
      return value;
    case YamlNode::Kind::kScalar:
      break;
  }
  const NumberText number = ParseNumber(node.text);
  if (node.quoted || number.kind != NumberText::Kind::kNumber) {
    const bool boolean = !node.quoted && (node.text == "true" || node.text == "false");
    return boolean ? nlohmann::json(node.text == "true") : nlohmann::json(node.text);
  }
  if (node.text.find_first_of(".eE") == std::string::npos) return std::stol(node.text);
  return number.value;
}

/// The first disagreement between a value and a schema of the keywords that we use, as
/// "/path: keyword"; "" when there is none. Throws for a keyword that it does not know.
inline std::string SchemaComplaint(const nlohmann::json& schema, const nlohmann::json& value,
                                   const std::string& path = "") {
  const auto is = [&](const std::string& type) {
    return (type == "object" && value.is_object()) || (type == "array" && value.is_array()) ||
           (type == "string" && value.is_string()) || (type == "boolean" && value.is_boolean()) ||
           (type == "number" && value.is_number()) ||
           (type == "integer" && value.is_number_integer());
  };
  for (const auto& [keyword, wanted] : schema.items()) {
    bool good = true;
    if (keyword == "type") {
      good = false;
      for (const auto& type : wanted.is_array() ? wanted : nlohmann::json::array({wanted})) {
        good = good || is(type.get<std::string>());
      }
    } else if (keyword == "minimum" || keyword == "maximum") {
      good = !value.is_number() ||
             (keyword == "minimum" ? value.get<double>() >= wanted.get<double>()
                                   : value.get<double>() <= wanted.get<double>());
    } else if (keyword == "minItems" || keyword == "maxItems") {
      good = !value.is_array() || (keyword == "minItems" ? value.size() >= wanted.get<size_t>()
                                                         : value.size() <= wanted.get<size_t>());
    } else if (keyword == "enum") {
      good = std::find(wanted.begin(), wanted.end(), value) != wanted.end();
    } else if (keyword == "anyOf") {
      good = false;
      for (const auto& choice : wanted) good = good || SchemaComplaint(choice, value).empty();
    } else if (keyword == "items" && value.is_array()) {
      for (size_t i = 0; i < value.size(); ++i) {
        const std::string below = SchemaComplaint(wanted, value[i], path + "/" + std::to_string(i));
        if (!below.empty()) return below;
      }
    } else if (keyword == "properties" && value.is_object()) {
      for (const auto& [key, item] : value.items()) {
        if (!wanted.contains(key)) continue;
        const std::string below = SchemaComplaint(wanted[key], item, path + "/" + key);
        if (!below.empty()) return below;
      }
    } else if (keyword == "additionalProperties" && value.is_object()) {
      for (const auto& [key, item] : value.items()) {
        if (!schema["properties"].contains(key)) return path + "/" + key + ": " + keyword;
      }
    } else if (keyword == "required" && value.is_object()) {
      for (const auto& key : wanted) {
        if (!value.contains(key)) return path + ": required " + key.get<std::string>();
      }
    } else if (keyword != "items" && keyword != "properties" && keyword != "required" &&
               keyword != "additionalProperties" && keyword != "description" &&
               keyword != "default" && keyword != "title" && keyword != "$schema") {
      throw std::runtime_error("unknown keyword " + keyword);
    }
    if (!good) return path + ": " + keyword;
  }
  return "";
}

}  // namespace halfstep
