#include "experiments/verify/own_names.h"

#include <algorithm>

#include "experiments/config/known_names.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/yaml_node.h"

namespace halfstep::verify {
namespace {

using Kind = YamlNode::Kind;

const YamlNode* At(const YamlNode& root, std::initializer_list<const char*> keys) {
  const YamlNode* node = &root;
  for (const char* key : keys) {
    node = node->kind == Kind::kMap ? node->Find(key) : nullptr;
    if (node == nullptr) return nullptr;
  }
  return node;
}

bool Has(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

std::string Quoted(const std::string& text) {
  std::string yaml = "'";
  for (const char c : text) yaml += c == '\'' ? std::string("''") : std::string(1, c);
  return yaml + "'";
}

void FindMethods(const YamlNode& root, const std::vector<std::string>& known, OwnNames* own) {
  const YamlNode* methods = At(root, {"smoothing", "methods"});
  if (methods == nullptr || methods->kind != Kind::kList) return;
  std::vector<std::string> all;
  std::string rest;
  for (const YamlNode& method : methods->items) {
    if (method.kind != Kind::kScalar) return;
    all.push_back(method.text);
    if (Has(known, method.text)) {
      rest += (rest.empty() ? "" : ", ") + Quoted(method.text);
    } else {
      own->told.push_back("the method " + method.text);
    }
  }
  if (own->told.empty()) return;
  own->methods = all;
  own->overrides.push_back({"smoothing.methods", "[" + rest + "]"});
}

// Leaves out the keys of a group for which `is_own` holds; calls it once for each.
template <typename IsOwn>
void LeaveOut(const YamlNode& root, std::initializer_list<const char*> keys, OwnNames* own,
              const IsOwn& is_own) {
  const YamlNode* group = At(root, keys);
  if (group == nullptr || group->kind != Kind::kMap) return;
  std::string path;
  for (const char* key : keys) path += std::string(key) + ".";
  for (const YamlNode& item : group->items) {
    if (item.kind == Kind::kScalar && is_own(item)) {
      own->overrides.push_back({.key = path + item.key, .value = "", .leave_out = true});
    }
  }
}

// Options of methods, of which one unknown leaves out all: none changes what is read here.
void FindOwnOptions(const YamlNode& root, const std::vector<std::string>& known, OwnNames* own) {
  const YamlNode* group = At(root, {"smoothing", "own"});
  if (group == nullptr || group->kind != Kind::kMap) return;
  const size_t told = own->told.size();
  for (const YamlNode& item : group->items) {
    if (!Has(known, item.key)) own->told.push_back("the options " + item.key);
  }
  if (own->told.size() > told) {
    own->overrides.push_back({.key = "smoothing.own", .value = "", .leave_out = true});
  }
}

}  // namespace

OwnNames FindOwnNames(const std::string& path, const std::string& text, const Toolbox& tools) {
  OwnNames own;
  YamlNode root;
  try {
    YamlComplaints complaints(path);
    root = ParseYaml(text, "", &complaints);
  } catch (const InputError&) {
    return own;
  }
  const KnownNames known = NamesOfConfigs(tools);
  FindMethods(root, known.methods, &own);
  FindOwnOptions(root, known.own_options, &own);
  const YamlNode* robot = At(root, {"robot"});
  if (robot != nullptr && robot->kind == Kind::kScalar) own.robot = robot->text;
  const YamlNode* planner = At(root, {"planner", "name"});
  if (planner != nullptr && planner->kind == Kind::kScalar && !Has(known.planners, planner->text)) {
    own.told.push_back("the planner " + planner->text);
    own.overrides.push_back({"planner.name", known.planners.front()});
  }
  if (!known.has_own_margins) {
    LeaveOut(root, {"smoothing", "margins"}, &own, [&](const YamlNode& item) {
      if (item.key != known.own_margin) return false;
      own.own_margin = ParseNumber(item.text).value;
      return true;
    });
  }
  LeaveOut(root, {"smoothing", "optimizer", "weights"}, &own, [&](const YamlNode& item) {
    if (Has(known.weights, item.key)) return false;
    own.told.push_back("the weight " + item.key);
    return true;
  });
  return own;
}

}  // namespace halfstep::verify
