#include "experiments/run/manifest.h"

#include <sys/utsname.h>

#include <array>
#include <chrono>
#include <ctime>
#include <nlohmann/json.hpp>
#include <thread>

#include "experiments/about/build_info.h"
#include "experiments/run/json_fields.h"
#include "experiments/tables/not_covered_json.h"
#include "smoothing/margins/not_covered_by.h"
#include "smoothing/methods/solver_method_options.h"
#include "smoothing/proof/sampled_feasibility.h"
#include "wpg/files/sha256.h"

namespace halfstep {
namespace {

using nlohmann::ordered_json;

std::string UtcNow() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

ordered_json Host() {
  utsname names{};
  uname(&names);
  return {{"system", names.sysname},
          {"release", names.release},
          {"machine", names.machine},
          {"cores", std::thread::hardware_concurrency()}};
}

// What a method was asked for; `raw` for nothing.
ordered_json Requested(const std::string& method, const SmoothingConfig& config) {
  if (method == "raw") return ordered_json::object();
  const Smoother& smoother = config.known.Find(method);
  return JsonOf([&](Fields& fields) { smoother.DeclareRequest(fields, config.options); });
}

ordered_json WorkJson(const Work& work) {
  return {{"instants", work.instants},
          {"derivatives", work.derivatives},
          {"intervals", work.intervals},
          {"linear_algebra", work.linear_algebra},
          {"effort", work.effort()}};
}

ordered_json MethodJson(const MethodRun& run, const SmoothingConfig& config) {
  return {{"name", run.method},
          {"requested", Requested(run.method, config)},
          {"status", Name(run.result.ending)},
          {"message", run.result.message},
          {"judged_by", Name(run.result.evidence)},
          {"verdict", VerdictName(run.certified.answer.verdict)},
          {"duration_s", run.duration},
          {"work", WorkJson(run.result.work)},
          {"wall_s", run.result.wall},
          {"processor_s", run.processor}};
}

}  // namespace

std::string ManifestJson(const Experiment& experiment, const std::string& resolved_config,
                         const std::string& acceptance, const std::vector<MethodRun>& runs,
                         double total_wall) {
  ordered_json manifest = {
      {"format", 2},
      {"program", "halfstep"},
      {"version", kVersion},
      {"commit", kCommit},
      {"build_type", kBuildType},
      {"compiler", kCompiler},
      {"written", UtcNow()},
      {"name", experiment.config.name},
      {"config_sha256", Sha256(resolved_config)},
      {"seed", experiment.config.seed},
      {"robot", experiment.robot.name},
      {"scene", experiment.scene.name},
      {"half_steps", experiment.sequence.size()},
      {"objective", experiment.config.smoothing.options.Get(OptimizerGroup()).program},
      {"acceptance", acceptance},
      {"host", Host()},
      {"wall_s", total_wall}};
  manifest["not_covered"] = NotCoveredJson(
      NotCoveredBy(experiment.robot, experiment.scene, experiment.config.smoothing.limits));
  if (!experiment.scene.warnings.empty()) manifest["scene_warnings"] = experiment.scene.warnings;
  for (const auto& [library, version] : kLibraries) manifest["libraries"][library] = version;
  for (const MethodRun& run : runs) {
    manifest["methods"].push_back(MethodJson(run, experiment.config.smoothing));
  }
  return manifest.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace halfstep
