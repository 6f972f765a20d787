#include "experiments/report/report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "experiments/config/experiment.h"
#include "experiments/config/folder_name.h"
#include "experiments/report/closed_form.h"
#include "experiments/report/nearest_pairs.h"
#include "experiments/report/report_page.h"
#include "experiments/report/report_place.h"
#include "experiments/report/report_walk.h"
#include "experiments/tables/certificate_files.h"
#include "experiments/tables/certificate_statement.h"
#include "experiments/tables/csv_reader.h"
#include "experiments/tables/ending_words.h"
#include "experiments/tables/json_file.h"
#include "experiments/tables/margin_columns.h"
#include "opt/solvers/ending.h"
#include "smoothing/margins/family_traits.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"

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

json FamilyJson(MarginFamily family) {
  const FamilyTraits& traits = Traits(family);
  json row = {
      {"name", traits.name}, {"unit", traits.unit}, {"scale", traits.scale}, {"key", traits.key}};
  if (const auto column = TrajectoryColumnOf(family)) row["column"] = *column;
  return row;
}

// Those that every walk has.
json FamiliesJson(const Methods& methods) {
  json families = json::array();
  for (const MarginFamily family : FamiliesWith(methods.own_margins())) {
    if (!Traits(family).may_be_absent) families.push_back(FamilyJson(family));
  }
  return families;
}

// Adds the families that only some walks have, if this run's have them, and names them in the
// statement.
void AddFamilies(const fs::path& run, json* report) {
  const fs::path path = run / "raw" / "certificate.json";
  if (!fs::exists(path)) return;
  const json certificate = ReadJsonObject(path);
  const json demanded = certificate.value("demanded", json::object());
  for (const MarginFamily family : AllMarginFamilies()) {
    if (!Traits(family).may_be_absent || !demanded.contains(Name(family))) continue;
    IndexIn(&(*report)["families"], FamilyJson(family));
    (*report)["statement"] = certificate.at("statement");
  }
}

// What is shown of each status.
json EndingsJson() {
  json endings = json::object();
  for (opt::Ending ending : opt::kEndings) endings[Name(ending)] = FullMeaning(ending);
  return endings;
}

json EmptyReport(const char* kind, const Methods& methods) {
  return {{"kind", kind},
          {"families", FamiliesJson(methods)},
          {"endings", EndingsJson()},
          {"statement", kCertificateStatement},
          {"robots", json::array()},
          {"scenes", json::array()},
          {"cases", json::array()}};
}

// The middle of a run's footsteps on the floor.
Eigen::Vector2d MiddleOf(const fs::path& footsteps) {
  const CsvTable table = ReadCsv(footsteps.string());
  const std::vector<double> x = table.Numbers("x_m"), y = table.Numbers("y_m");
  Eigen::Vector2d sum(0, 0);
  for (size_t i = 0; i < x.size(); ++i) sum += Eigen::Vector2d(x[i], y[i]);
  return sum / std::max<double>(1.0, static_cast<double>(x.size()));
}

json CaseOf(const std::string& scenario, const fs::path& run, const RobotModel& robot,
            const Scene& scene, json* report) {
  AddFamilies(run, report);
  return {
      {"scenario", scenario},
      {"robot", IndexIn(&(*report)["robots"], RobotJson(robot))},
      {"scene", IndexIn(&(*report)["scenes"], SceneJson(scene, MiddleOf(run / "footsteps.csv")))},
      {"footsteps", RowsJson(run / "footsteps.csv")}};
}

json SummaryOf(const MethodRecord& record) {
  json row = {{"method", record.name},
              {"status", Name(record.ending)},
              {"own", HasOwnResult(record.ending)},
              {"certified", record.certified},
              {"duration_s", Shortened(record.duration, 6)},
              {"speedup", Shortened(record.speedup, 6)},
              {"cost", Shortened(record.cost, 6)},
              {"effort", Shortened(record.effort, 6)},
              {"not_repeatable", NotRepeatable(record.ending, record.message)},
              {"wall_s", Shortened(record.wall, 6)}};
  if (record.gap_lipm) row["gap_lipm"] = Shortened(*record.gap_lipm, 6);
  return row;
}

// A row of a run's summary.csv, with whether the walk is the method's own, and is the same each
// time: the manifest's `message` tells.
json WithOwn(json row, const std::string& message, const fs::path& summary) {
  const auto status = row.at("status").get<std::string>();
  const std::optional<opt::Ending> ending = opt::EndingOf(status);
  if (!ending) {
    throw InputError(
        {summary.string() + ": status: " + Quote(status) + " (valid: " + opt::EndingNames() + ")"});
  }
  row["own"] = HasOwnResult(*ending);
  row["not_repeatable"] = NotRepeatable(*ending, message);
  return row;
}

// What the manifest says of how each method ended.
std::map<std::string, std::string> MessagesOf(const json& manifest) {
  std::map<std::string, std::string> messages;
  if (!manifest.contains("methods")) return messages;
  for (const json& method : manifest["methods"]) {
    if (!method.is_object()) continue;
    const json name = method.value("name", json()), message = method.value("message", json());
    if (name.is_string() && message.is_string()) messages[name] = message;
  }
  return messages;
}

// Walks are drawn with today's files; these must be those that they were made for.
void CheckSame(const std::vector<InputFile>& files, const std::string& what, const fs::path& run) {
  const fs::path path = run / "raw" / "certificate.json";
  const json hash = ReadJsonObject(path).value(json::json_pointer("/sha256/" + what), json());
  if (hash == CombinedSha256(files)) return;
  throw InputError({path.string() + ": the files of the " + what +
                    " are not those of this run (valid: as they were when it was made)"});
}

// The method's folder in its run, of a name that may have a label.
fs::path FolderOf(const MethodRecord& record) {
  const std::string name = record.name.substr(record.name.find(':') + 1);
  return fs::path(record.run) / MethodFolder(name);
}

// [wall time, duration] of each incumbent that is shorter than the one before [s].
json ImprovementsOf(const MethodRecord& record) {
  json improvements = json::array();
  double shortest = std::numeric_limits<double>::infinity();
  for (const IncumbentRecord& incumbent : record.incumbents) {
    if (!(incumbent.duration < shortest)) continue;
    shortest = incumbent.duration;
    improvements.push_back({Shortened(incumbent.wall), Shortened(incumbent.duration, 6)});
  }
  return improvements;
}

// A case with what is drawn of each walk; empty: nothing is.
json WithTables(json result, const ComparedCase& one, std::vector<json> drawn) {
  drawn.resize(one.methods.size(), json::object());
  for (size_t i = 0; i < drawn.size(); ++i) {
    const ComparedMethod& method = one.methods[i];
    drawn[i]["summary"] = SummaryOf(method.record);
    drawn[i]["variables"] = method.record.variables;
    drawn[i]["improvements"] = ImprovementsOf(method.record);
    drawn[i]["gap"] = std::isfinite(method.gap) ? json(Shortened(method.gap)) : json(nullptr);
  }
  result["objective"] = one.objective;
  result["walks"] = std::move(drawn);
  return result;
}

// A walk with the pairs that are nearest, as `nearest`, and the rows of its pareto.csv, if any.
json DrawnWalk(const RobotModel& robot, const Scene& scene, const fs::path& folder,
               double spacing) {
  json walk = WalkJson(robot, folder, spacing);
  walk["nearest"] = NearestPairsJson(robot, scene, ReadCsv((folder / "trajectory.csv").string()));
  const fs::path pareto = folder / "pareto.csv";
  if (fs::exists(pareto)) walk["pareto"] = RowsJson(pareto);
  return walk;
}

json ProfilesJson(const Comparison& comparison) {
  json curves = json::array();
  for (const ProfileCurve& curve : PerformanceProfiles(comparison)) {
    json points = json::array();
    for (const auto& [ratio, fraction] : curve.points) {
      points.push_back({Shortened(ratio), Shortened(fraction)});
    }
    curves.push_back({{"target", curve.target},
                      {"by_wall", curve.by_wall},
                      {"method", curve.method.name},
                      {"variables", curve.method.variables},
                      {"objective", curve.method.objective},
                      {"points", std::move(points)}});
  }
  return curves;
}

json CaseOf(const ComparedCase& one, double spacing, const Toolbox& tools, json* report) {
  const fs::path run(one.methods.front().record.run);
  try {
    const Place place = PlaceOfRun(run, tools);
    std::vector<json> walks;
    for (const ComparedMethod& method : one.methods) {
      walks.push_back(DrawnWalk(place.robot, place.scene, FolderOf(method.record), spacing));
    }
    return WithTables(CaseOf(one.scenario, run, place.robot, place.scene, report), one,
                      std::move(walks));
  } catch (const InputError& error) {
    return WithTables({{"scenario", one.scenario}, {"not_drawn", error.what()}}, one, {});
  }
}

// Beside a run's walks what the page needs to move their parameters by itself.
void AddClosedForm(const RobotModel& robot, const Scene& scene, const fs::path& folder,
                   const Toolbox& tools, json* one) {
  const Experiment experiment =
      Prepare(LoadConfig((folder / "config.yaml").string(), {}, tools), Place{robot, scene});
  (*one)["closed_form"] = ClosedFormJson(experiment.robot, experiment.sequence);
  if ((*one)["closed_form"].is_null()) return;
  for (json& walk : (*one)["walks"]) {
    const auto method = walk["summary"].at("method").get<std::string>();
    walk["parameters"] = ParametersJson(folder / MethodFolder(method), experiment.sequence);
  }
}

}  // namespace

Place PlaceOfRun(const fs::path& run, const Toolbox& tools) {
  Place place = LoadPlace(LoadConfig((run / "config.yaml").string(), {}, tools));
  CheckSame(place.robot.files, "robot", run);
  CheckSame(place.scene.files, "scene", run);
  return place;
}

std::string RunReport(const RobotModel& robot, const Scene& scene, const fs::path& folder,
                      const Toolbox& tools) {
  const json manifest = ReadJsonObject(folder / "manifest.json");
  json report = EmptyReport("run", tools.methods);
  for (const char* key : {"name", "version", "commit", "objective", "acceptance"}) {
    if (!manifest.contains(key)) {
      throw InputError({(folder / "manifest.json").string() + ": no '" + key + "'"});
    }
    report[key] = manifest[key];
  }
  json one = CaseOf(report["name"], folder, robot, scene, &report);
  const json summary = RowsJson(folder / "summary.csv");
  std::map<std::string, std::string> messages = MessagesOf(manifest);
  double total = 0.0;
  for (double duration : ReadCsv((folder / "summary.csv").string()).Numbers("duration_s")) {
    total += duration;
  }
  for (const json& row : summary) {
    const auto method = row.at("method").get<std::string>();
    json walk = DrawnWalk(robot, scene, folder / MethodFolder(method), SpacingFor(total));
    walk["summary"] = WithOwn(row, messages[method], folder / "summary.csv");
    one["walks"].push_back(std::move(walk));
  }
  AddClosedForm(robot, scene, folder, tools, &one);
  const fs::path volumes = folder / "swept_volumes.json";
  if (fs::exists(volumes)) one["swept_volumes"] = ReadJsonObject(volumes);
  const fs::path infeasible = folder / "infeasible.json";
  if (fs::exists(infeasible)) one["infeasible"] = ReadJsonObject(infeasible);
  report["cases"].push_back(std::move(one));
  return ReportPage(report);
}

void WriteReport(const RobotModel& robot, const Scene& scene, RunFolder* folder,
                 const Toolbox& tools) {
  if (HasReport()) folder->Write("report.html", RunReport(robot, scene, folder->staging(), tools));
}

std::string ComparisonReport(const Comparison& comparison, const Toolbox& tools) {
  double total = 0.0;
  for (const ComparedCase& one : comparison.cases) {
    for (const ComparedMethod& method : one.methods) total += method.record.duration;
  }
  json report = EmptyReport("comparison", tools.methods);
  report["profiles"] = ProfilesJson(comparison);
  for (const ComparedCase& one : comparison.cases) {
    report["cases"].push_back(CaseOf(one, SpacingFor(total), tools, &report));
  }
  return ReportPage(report);
}

}  // namespace halfstep
