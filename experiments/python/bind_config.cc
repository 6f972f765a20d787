#include <pybind11/stl.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <string>

#include "experiments/config/data_folder.h"
#include "experiments/config/experiment.h"
#include "experiments/config/experiment_config.h"
#include "experiments/python/bindings.h"
#include "opt/adapters/solver_registry.h"
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

py::dict SolverReasons(const Toolbox& tools) {
  py::dict reasons;
  for (const std::string& name : opt::SolverNames()) {
    const auto solver = opt::MakeSolver(name);
    reasons[py::str(name)] = solver->available() ? "" : solver->WhyUnavailable();
  }
  for (const auto& own : tools.methods.own_solvers()) reasons[py::str(own->name())] = "";
  return reasons;
}

py::dict Meanings(const Toolbox& tools) {
  py::dict methods;
  for (const auto& method : tools.methods.all())
    methods[py::str(method->name())] = method->meaning();
  return methods;
}

// The groups that hold the options of a method: where they are below `smoothing`, and their keys.
py::list OptionGroups(const Toolbox& tools, const std::string& method) {
  py::list groups;
  const std::vector<DeclaredGroup> own = tools.methods.OwnGroups();
  for (const DeclaredGroup& group : tools.methods.Find(method).groups()) {
    std::vector<std::string> path, keys;
    if (std::ranges::find(own, group.key, &DeclaredGroup::key) != own.end()) path = {"own"};
    path.push_back(group.key);
    MethodOptions options;
    for (const KeyDescription& key :
         DescribeKeys([&](Fields& fields) { group.declare(fields, &options); })) {
      keys.push_back(key.key());
    }
    groups.append(py::make_tuple(path, keys));
  }
  return groups;
}

}  // namespace

py::object ConfigToPython(ExperimentConfig config) {
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

void BindConfig(py::module_& module, const ModuleTools& tools) {
  module.def("load_config", [tools](const std::string& path, const Overrides& overrides) {
    return ConfigToPython(LoadConfig(path, ToOverrides(overrides), *tools));
  });
  module.def("resolve_config", [tools](const std::string& path, const std::string& text) {
    return ConfigToPython(ParseConfig(path, text, {}, *tools));
  });
  module.def("data_folder", [] { return DataFolder().string(); });
  module.def("robots", [] { return Stems(RobotsFolder()); });
  module.def("scenes", [] { return Stems(ScenesFolder()); });
  module.def("configs", [] { return Stems(DataFolder() / "configs"); });
  module.def("methods", [tools] { return Meanings(*tools); });
  module.def("option_groups",
             [tools](const std::string& method) { return OptionGroups(*tools, method); });
  module.def("solvers", [tools] { return SolverReasons(*tools); });
  module.def("planners", [tools] { return tools->planners.Names(); });
}

}  // namespace halfstep::python
