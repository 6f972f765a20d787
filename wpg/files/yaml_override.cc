#include <algorithm>
#include <charconv>
#include <system_error>

#include "wpg/files/text.h"
#include "wpg/files/yaml_node.h"

namespace halfstep {
namespace {

// The item of a list, or the (new) value of a map; nullptr after a complaint.
YamlNode* Child(const std::string& part, const std::string& parent_path, const YamlPlace& place,
                YamlNode* parent, YamlComplaints* complaints) {
  const std::string name = parent_path.empty() ? "the document" : parent_path;
  if (parent->kind == YamlNode::Kind::kList) {
    size_t index = 0;
    const char* const end = part.data() + part.size();
    const auto [stop, error] = std::from_chars(part.data(), end, index);
    if (error == std::errc() && stop == end && index < parent->items.size()) {
      return &parent->items[index];
    }
    const std::string valid = parent->items.empty()
                                  ? "none, the list is empty"
                                  : "0 … " + std::to_string(parent->items.size() - 1);
    complaints->Add(place, "", name + " has no item " + Quote(part) + " (valid: " + valid + ")");
    return nullptr;
  }
  if (parent->kind == YamlNode::Kind::kScalar) {
    complaints->Add(place, "", name + " is " + Describe(*parent) + ", not a map or a list");
    return nullptr;
  }
  if (parent->kind == YamlNode::Kind::kNull) {
    parent->kind = YamlNode::Kind::kMap;
    parent->place = place;
  }
  if (YamlNode* const child = parent->Find(part)) return child;
  parent->items.push_back({.key = part, .key_place = place, .place = place});
  return &parent->items.back();
}

std::vector<std::string> Split(const std::string& dotted_key) {
  std::vector<std::string> parts(1);
  for (const char c : dotted_key) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

}  // namespace

void OverrideYaml(const std::string& dotted_key, const std::string& value_text, YamlNode* root,
                  YamlComplaints* complaints) {
  const YamlPlace place{0, 0, dotted_key.empty() ? "''" : KeyPath("", dotted_key)};
  const std::vector<std::string> parts = Split(dotted_key);
  if (std::find(parts.begin(), parts.end(), "") != parts.end()) {
    complaints->Add(place, "", "an empty key (valid: dotted keys, as smoothing.method)");
    return;
  }
  YamlNode value = ParseYaml(value_text, place.override_key, complaints);
  YamlNode* node = root;
  std::string path;
  for (const std::string& part : parts) {
    const bool in_list = node->kind == YamlNode::Kind::kList;
    node = Child(part, path, place, node, complaints);
    if (node == nullptr) return;
    if (in_list) {
      path.append("[").append(part).append("]");
    } else {
      path = KeyPath(path, part);
    }
  }
  value.place = place;
  value.key = node->key;
  value.key_place = place;
  *node = std::move(value);
}

void RemoveYaml(const std::string& dotted_key, YamlNode* root) {
  const std::vector<std::string> parts = Split(dotted_key);
  YamlNode* map = root;
  for (size_t i = 0; i + 1 < parts.size(); ++i) {
    if (map == nullptr || map->kind != YamlNode::Kind::kMap) return;
    map = map->Find(parts[i]);
  }
  if (map == nullptr || map->kind != YamlNode::Kind::kMap) return;
  std::erase_if(map->items, [&](const YamlNode& item) { return item.key == parts.back(); });
}

}  // namespace halfstep
