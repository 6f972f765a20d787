#include <pybind11/stl.h>

#include <charconv>
#include <filesystem>
#include <string>

#include "experiments/config/data_folder.h"
#include "experiments/config/experiment.h"
#include "experiments/config/experiment_config.h"
#include "experiments/python/bindings.h"
#include "opt/adapters/solver_registry.h"
#include "planner/search/planner_registry.h"
#include "wpg/files/yaml_node.h"

namespace py = pybind11;

namespace halfstep::python {
namespace {

namespace fs = std::filesystem;
using Overrides = std::vector<std::pair<std::string, std::string>>;

// A plain scalar of text that WriteYaml wrote; `none` is None.
py::object PlainValue(const std::string& text) {
  if (text == "none") return py::none();
  if (text == "true" || text == "false") return py::bool_(text == "true");
  const char* const end = text.data() + text.size();
  long long integer = 0;
  if (const auto read = std::from_chars(text.data(), end, integer);
      read.ec == std::errc{} && read.ptr == end) {
    return py::int_(integer);
  }
  double number = 0.0;
  if (const auto read = std::from_chars(text.data(), end, number);
      read.ec == std::errc{} && read.ptr == end) {
    return py::float_(number);
  }
  return py::str(text);
}

py::object NodeToPython(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::kNull:
      return py::none();
    case YamlNode::Kind::kScalar:
      return node.quoted ? py::object(py::str(node.text)) : PlainValue(node.text);
    case YamlNode::Kind::kList: {
      py::list list;
      for (const YamlNode& item : node.items) list.append(NodeToPython(item));
      return list;
    }
    case YamlNode::Kind::kMap: {
      py::dict map;
      for (const YamlNode& item : node.items) map[py::str(item.key)] = NodeToPython(item);
      return map;
    }
  }
  return py::none();
}

// The config with paths that hold in every folder, with every key.
py::object Resolved(ExperimentConfig config) {
  if (const auto scene = ScenePath(config)) config.scene = fs::absolute(*scene).string();
  const fs::path robot(config.robot);
  if (robot.has_parent_path() || robot.has_extension()) {
    config.robot = fs::absolute(RobotPath(config)).string();
  }
  if (std::string& cache = config.swept_volumes.cache; !cache.empty()) {
    cache = fs::absolute(fs::path(config.directory) / cache).lexically_normal().string();
  }
  if (std::string& out = config.output_directory; !out.empty()) {
    out = fs::absolute(fs::path(config.directory) / out).lexically_normal().string();
  }
  const std::string text = WriteYaml([&](Fields& fields) { DeclareFields(fields, &config); });
  YamlComplaints complaints("config");
  const YamlNode root = ParseYaml(text, "", &complaints);
  complaints.ThrowIfAny();
  return NodeToPython(root);
}

std::vector<YamlOverride> ToOverrides(const Overrides& overrides) {
  std::vector<YamlOverride> all;
  for (const auto& [key, value] : overrides) all.push_back({key, value});
  return all;
}

py::dict Stems(const fs::path& folder) {
  py::dict files;
  for (const fs::path& path : YamlFiles(folder)) {
    files[py::str(path.stem().string())] = path.string();
  }
  return files;
}

py::dict SolverReasons(const Methods& known) {
  py::dict reasons;
  for (const std::string& name : opt::SolverNames()) {
    const auto solver = opt::MakeSolver(name);
    reasons[py::str(name)] = solver->available() ? "" : solver->WhyUnavailable();
  }
  for (const auto& own : known.own_solvers()) reasons[py::str(own->name())] = "";
  return reasons;
}

py::dict Meanings(const Methods& known) {
  py::dict methods;
  for (const auto& method : known.all()) methods[py::str(method->name())] = method->meaning();
  return methods;
}

// The groups of `smoothing` that hold the options of a method.
std::vector<std::string> OptionGroups(const Methods& known, const std::string& method) {
  std::vector<std::string> keys;
  for (const DeclaredGroup& group : known.Find(method).groups()) keys.push_back(group.key);
  return keys;
}

}  // namespace

void BindConfig(py::module_& module, const ModuleMethods& methods) {
  module.def("load_config", [methods](const std::string& path, const Overrides& overrides) {
    return Resolved(LoadConfig(path, ToOverrides(overrides), *methods));
  });
  module.def("resolve_config", [methods](const std::string& path, const std::string& text) {
    return Resolved(ParseConfig(path, text, {}, *methods));
  });
  module.def("data_folder", [] { return DataFolder().string(); });
  module.def("robots", [] { return Stems(RobotsFolder()); });
  module.def("scenes", [] { return Stems(ScenesFolder()); });
  module.def("configs", [] { return Stems(DataFolder() / "configs"); });
  module.def("methods", [methods] { return Meanings(*methods); });
  module.def("option_groups",
             [methods](const std::string& method) { return OptionGroups(*methods, method); });
  module.def("solvers", [methods] { return SolverReasons(*methods); });
  module.def("planners", &PlannerNames);
}

}  // namespace halfstep::python
