#include <pybind11/stl.h>

#include <optional>
#include <string>

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

// As `halfstep run`. "" or why there is nothing to smooth.
std::string RunInto(const std::string& path, const std::string& text, const std::string& out,
                    bool overwrite, const py::object& progress) {
  std::string refusal;
  CallLong(progress, [&](const LongCallHooks& call) {
    const ExperimentConfig config = ParseConfig(path, text, {});
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
    run.Certify(call.stop);
    if (call.stop.stop_requested()) return;
    run.Write(&folder);
    WriteReport(run.experiment().robot, run.experiment().scene, &folder);
    CompleteManifest(run.experiment().robot, run.experiment().scene, &folder);
    folder.Publish();
  });
  return refusal;
}

py::list VerifyFolder(const std::string& run, const std::optional<std::string>& method,
                      const std::optional<double>& tolerance) {
  std::vector<verify::MethodVerification> results;
  CallLong(py::none(), [&](const LongCallHooks&) {
    results = verify::VerifyRun({.run = run, .method = method, .tolerance = tolerance});
  });
  py::list list;
  for (const verify::MethodVerification& result : results) {
    list.append(py::make_tuple(result.method, result.verified, verify::Describe(result),
                               result.complaints));
  }
  return list;
}

}  // namespace

void BindRun(py::module_& module) {
  module.def("run", &RunInto);
  module.def("verify", &VerifyFolder);
  module.def("method_folder", &MethodFolder);
}

}  // namespace halfstep::python
