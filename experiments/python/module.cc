// The module _halfstep: what the Python package `halfstep` is written on. It checks shapes and
// values; names, units and explanations for users are the package's.
#include "experiments/about/build_info.h"
#include "experiments/python/bindings.h"

PYBIND11_MODULE(_halfstep, module) {
  using namespace halfstep::python;
  module.doc() = "The compiled part of the package halfstep. Use `import halfstep`.";
  module.attr("version") = halfstep::kVersion;
  module.attr("commit") = halfstep::kCommit;
  const auto tools = std::make_shared<halfstep::Toolbox>();
  BindExceptions(module);
  BindConfig(module, tools);
  BindPlace(module);
  BindWalk(module);
  BindExperiment(module, tools);
  BindProgram(module);
  BindRun(module, tools);
  BindReplay(module, tools);
  BindExtension(module, tools);
  BindCheck(module);
}
