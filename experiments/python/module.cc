// The module _halfstep: what the Python package `halfstep` is written on. It checks shapes and
// values; names, units and explanations for users are the package's.
#include "experiments/build_info.h"
#include "experiments/python/bindings.h"

PYBIND11_MODULE(_halfstep, module) {
  using namespace halfstep::python;
  module.doc() = "The compiled part of the package halfstep. Use `import halfstep`.";
  module.attr("version") = halfstep::kVersion;
  module.attr("commit") = halfstep::kCommit;
  const auto methods = std::make_shared<halfstep::Methods>(halfstep::Methods::Standard());
  BindExceptions(module);
  BindConfig(module, methods);
  BindPlace(module);
  BindWalk(module);
  BindExperiment(module, methods);
  BindProgram(module);
  BindRun(module, methods);
  BindExtension(module, methods);
}
