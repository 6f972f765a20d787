#include "experiments/report/report.h"

#include <algorithm>
#include <cmath>

#include "experiments/certificate_files.h"
#include "experiments/certificate_statement.h"
#include "experiments/csv_reader.h"
#include "experiments/experiment.h"
#include "experiments/report/report_page.h"
#include "experiments/report/report_place.h"
#include "experiments/report/report_walk.h"
#include "smoothing/margins.h"
#include "wpg/input/input_error.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Instants of all walks together, so that the page stays below 5 MB.
constexpr double kMostInstants = 14000;
constexpr double kFinestSpacing = 0.02;  // [s]

double SpacingFor(double total_duration) {
  return std::max(kFinestSpacing, total_duration / kMostInstants);
}

// Index of a value in a list, added when it is not there: scenarios share robots and scenes.
size_t IndexIn(json* list, json value) {
  const auto found = std::find(list->begin(), list->end(), value);
  const auto index = static_cast<size_t>(found - list->begin());
  if (found == list->end()) list->push_back(std::move(value));
  return index;
}

json FamiliesJson() {
  json families = json::array();
  for (MarginFamily family : AllMarginFamilies()) {
    families.push_back({{"name", Name(family)}, {"unit", Unit(family)}, {"scale", Scale(family)}});
  }
  return families;
}

json EmptyReport(const char* kind) {
  return {{"kind", kind},
          {"families", FamiliesJson()},
          {"statement", kCertificateStatement},
          {"robots", json::array()},
          {"scenes", json::array()},
          {"cases", json::array()}};
}

json CaseOf(const std::string& scenario, const fs::path& run, const RobotModel& robot,
            const Scene& scene, json* report) {
  return {{"scenario", scenario},
          {"robot", IndexIn(&(*report)["robots"], RobotJson(robot))},
          {"scene", IndexIn(&(*report)["scenes"], SceneJson(scene))},
          {"footsteps", RowsJson(run / "footsteps.csv")},
          {"walks", json::array()}};
}

json SummaryOf(const MethodRecord& record) {
  return {{"method", record.name},
          {"status", record.status},
          {"certified", record.certified},
          {"duration_s", Shortened(record.duration, 6)},
          {"speedup", Shortened(record.speedup, 6)},
          {"cost", Shortened(record.cost, 6)},
          {"wall_s", Shortened(record.wall, 6)}};
}

// The method's folder in its run, of a name that may have a label.
fs::path FolderOf(const MethodRecord& record) {
  const std::string name = record.name.substr(record.name.find(':') + 1);
  return fs::path(record.run) / MethodFolder(name);
}

json CaseOf(const ComparedCase& one, double spacing, json* report) {
  const fs::path run(one.methods.front().record.run);
  json result;
  bool drawn = true;
  try {
    const Place place = LoadPlace(LoadConfig((run / "config.yaml").string(), {}));
    result = CaseOf(one.scenario, run, place.robot, place.scene, report);
  } catch (const InputError& error) {
    drawn = false;
    result = {{"scenario", one.scenario}, {"walks", json::array()}, {"not_drawn", error.what()}};
  }
  result["objective"] = one.objective;
  for (const ComparedMethod& method : one.methods) {
    json walk = drawn ? WalkJson(FolderOf(method.record), spacing) : json::object();
    walk["summary"] = SummaryOf(method.record);
    walk["variables"] = method.record.variables;
    walk["gap"] = std::isfinite(method.gap) ? json(Shortened(method.gap)) : json(nullptr);
    result["walks"].push_back(std::move(walk));
  }
  return result;
}

}  // namespace

std::string RunReport(const RobotModel& robot, const Scene& scene, const fs::path& folder) {
  const json manifest = ReadJsonObject(folder / "manifest.json");
  json report = EmptyReport("run");
  for (const char* key : {"name", "version", "commit", "objective", "acceptance"}) {
    if (!manifest.contains(key)) {
      throw InputError({(folder / "manifest.json").string() + ": no '" + key + "'"});
    }
    report[key] = manifest[key];
  }
  json one = CaseOf(report["name"], folder, robot, scene, &report);
  const json summary = RowsJson(folder / "summary.csv");
  double total = 0.0;
  for (double duration : ReadCsv((folder / "summary.csv").string()).Numbers("duration_s")) {
    total += duration;
  }
  for (const json& row : summary) {
    const auto method = row.at("method").get<std::string>();
    json walk = WalkJson(folder / MethodFolder(method), SpacingFor(total));
    walk["summary"] = row;
    one["walks"].push_back(std::move(walk));
  }
  report["cases"].push_back(std::move(one));
  return ReportPage(report);
}

void WriteReport(const RobotModel& robot, const Scene& scene, RunFolder* folder) {
  if (HasReport()) folder->Write("report.html", RunReport(robot, scene, folder->staging()));
}

std::string ComparisonReport(const Comparison& comparison) {
  double total = 0.0;
  for (const ComparedCase& one : comparison.cases) {
    for (const ComparedMethod& method : one.methods) total += method.record.duration;
  }
  json report = EmptyReport("comparison");
  for (const ComparedCase& one : comparison.cases) {
    report["cases"].push_back(CaseOf(one, SpacingFor(total), &report));
  }
  return ReportPage(report);
}

}  // namespace halfstep
