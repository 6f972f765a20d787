#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/checker/prove_walk.h"
#include "experiments/config/folder_name.h"
#include "experiments/python/bindings.h"
#include "experiments/python/long_call.h"
#include "experiments/report/report.h"
#include "experiments/run/complete_manifest.h"
#include "experiments/run/experiment_run.h"
#include "experiments/verify/verify_run.h"

namespace py = pybind11;

namespace halfstep::python {
namespace {

// As `halfstep run`: "" or why there is nothing to smooth, and a sentence on each method that
// failed.
std::pair<std::string, std::vector<std::string>> RunInto(const Toolbox& tools,
                                                         const std::string& path,
                                                         const std::string& text,
                                                         const std::string& out, bool overwrite,
                                                         const py::object& progress) {
  std::string refusal;
  std::vector<std::string> failed;
  const auto work = [&](const LongCallHooks& call) {
    const ExperimentConfig config = ParseConfig(path, text, {}, tools);
    const RunHooks hooks{
        .progress = call.progress, .stop = call.stop, .stop_step = call.stop, .keep = {}};
    ExperimentRun run(config, hooks);
    if (run.refusal()) {
      refusal = run.refusal()->sentence;
      return;
    }
    RunFolder folder(out, overwrite);
    run.Smooth(hooks);
    if (call.stop.stop_requested()) return;  // nothing is written then
    run.Explain(call.stop);
    run.Certify(call.stop);
    if (call.stop.stop_requested()) return;
    run.Write(&folder);
    WriteReport(run.experiment().robot, run.experiment().scene, &folder, tools);
    CompleteManifest(run.experiment().robot, run.experiment().scene, &folder);
    folder.Publish();
    for (const MethodRun& method : run.runs()) {
      if (method.result.ending != opt::Ending::kFailed) continue;
      failed.push_back(method.method + ": failed: " + method.result.message);
    }
  };
  CallLong(progress, work, RaisedBySearch::kEndsTheMethodOnly);
  return {refusal, failed};
}

py::list VerifyFolder(const Toolbox& tools, const std::string& run,
                      const std::optional<std::string>& method,
                      const std::optional<double>& tolerance) {
  std::vector<verify::MethodVerification> results;
  CallLong(py::none(), [&](const LongCallHooks&) {
    results = verify::VerifyRun({.prove = checker::ProverOfWalks(),
                                 .run = run,
                                 .method = method,
                                 .tolerance = tolerance,
                                 .tools = tools});
  });
  py::list list;
  for (const verify::MethodVerification& result : results) {
    list.append(py::make_tuple(result.method, result.verified, verify::Describe(result),
                               result.complaints));
  }
  return list;
}

}  // namespace

void BindRun(py::module_& module, const ModuleTools& tools) {
  module.def("run", [tools](const std::string& path, const std::string& text,
                            const std::string& out, bool overwrite, const py::object& progress) {
    return RunInto(*tools, path, text, out, overwrite, progress);
  });
  module.def("verify", [tools](const std::string& run, const std::optional<std::string>& method,
                               const std::optional<double>& tolerance) {
    return VerifyFolder(*tools, run, method, tolerance);
  });
  module.def("method_folder", &MethodFolder);
}

}  // namespace halfstep::python
