#include "experiments/export/ompl_log.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "experiments/tables/json_file.h"
#include "experiments/tables/run_record.h"
#include "planner/search/footstep_planner.h"
#include "smoothing/methods/smoothing_result.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// A run folder as a log tells it.
struct LoggedRun {
  RunRecord record;
  json manifest;
  json plan;  ///< null: it did not plan
};

/// The runs of one planner: a line of values each, and, where there is any, a line of progress.
struct LoggedPlanner {
  std::string name;
  std::vector<std::string> settings;    ///< "key = value"
  std::vector<std::string> properties;  ///< "name TYPE"
  std::vector<std::string> runs;
  std::vector<std::string> progress;
};

LoggedRun ReadLogged(const std::string& run) {
  LoggedRun logged{ReadRun(run), ReadJsonObject(fs::path(run) / "manifest.json"), nullptr};
  const fs::path plan = fs::path(run) / "plan.json";
  if (fs::exists(plan)) logged.plan = ReadJsonObject(plan);
  return logged;
}

std::string Number(double value) {
  return std::isfinite(value) ? ShortestText(value) : std::isnan(value) ? "nan" : "inf";
}

// A member of a manifest or plan as the log has it: numbers bare, null as nan.
std::string Member(const json& object, const char* key) {
  if (!object.contains(key) || object[key].is_null()) return "nan";
  return object[key].is_string() ? object[key].get<std::string>() : object[key].dump();
}

// One word, as the reader of a log takes the last one of a line.
std::string Word(std::string text) {
  std::replace(text.begin(), text.end(), ' ', '_');
  return text;
}

// Both programs' endings in one enumeration: a log knows one of the name `status`.
std::vector<std::string> Statuses() {
  std::vector<std::string> names;
  for (const opt::Ending ending : opt::kEndings) names.emplace_back(Name(ending));
  for (const auto status : {PlanStatus::kSolved, PlanStatus::kNoPlan, PlanStatus::kStartBlocked,
                            PlanStatus::kBudget, PlanStatus::kRefused}) {
    names.emplace_back(Name(status));
  }
  return names;
}

std::string StatusIndex(const std::string& name) {
  const std::vector<std::string> statuses = Statuses();
  const auto found = std::find(statuses.begin(), statuses.end(), name);
  if (found == statuses.end()) {
    std::string valid;
    for (const std::string& status : statuses) valid += (valid.empty() ? "" : ", ") + status;
    throw InputError({"status: " + Quote(name) + " (valid: " + valid + ")"});
  }
  return std::to_string(found - statuses.begin());
}

std::string ValueLine(const std::vector<std::string>& values) {
  std::string line;
  for (const std::string& value : values) line += value + "; ";
  return line;
}

// The incumbent whenever it became better, and at the end.
std::string ProgressLine(const MethodRecord& method, double raw_duration) {
  std::string line;
  double time = -1.0, duration = 0.0;
  const auto sample = [&](const IncumbentRecord& at) {
    if (at.wall <= time) return;
    time = at.wall;
    duration = at.duration;
    line += Number(at.wall) + "," + Number(at.duration) + "," + Number(at.instants) + "," +
            Number(at.effort) + ",;";
  };
  sample({.duration = raw_duration});
  for (const IncumbentRecord& incumbent : method.incumbents) {
    if (incumbent.duration == duration) continue;
    sample(incumbent);
  }
  sample({method.wall, method.instants, method.effort, method.duration});
  return line;
}

LoggedPlanner& PlannerOf(const std::string& name, std::vector<LoggedPlanner>* planners) {
  for (LoggedPlanner& planner : *planners) {
    if (planner.name == name) return planner;
  }
  planners->push_back({name, {}, {}, {}, {}});
  return planners->back();
}

void AddPlan(const json& plan, std::vector<LoggedPlanner>* planners) {
  LoggedPlanner& planner = PlannerOf("plan/" + Word(Member(plan, "planner")), planners);
  planner.settings = {"cost = " + Member(plan, "cost_kind")};
  planner.properties = {"status ENUM",       "solved BOOLEAN",
                        "time REAL",         "plan cost REAL",
                        "footsteps INTEGER", "graph states INTEGER",
                        "queries INTEGER",   "time to first solution REAL"};
  const std::string status = Member(plan, "status");
  planner.runs.push_back(
      ValueLine({StatusIndex(status), status == "solved" ? "1" : "0", Member(plan, "plan_wall_s"),
                 Member(plan, "cost"), Member(plan, "footsteps"), Member(plan, "nodes"),
                 Member(plan, "queries"), Member(plan, "time_to_first_s")}));
}

void AddMethods(const RunRecord& record, std::vector<LoggedPlanner>* planners) {
  const double raw_duration = record.methods.front().duration;
  for (const MethodRecord& method : record.methods) {
    LoggedPlanner& planner = PlannerOf(method.name, planners);
    planner.settings = {"objective = " + method.objective,
                        "variables = " + (method.raw() ? "none" : method.variables)};
    planner.properties = {
        "status ENUM",        "solved BOOLEAN", "time REAL",        "best cost REAL",
        "walk duration REAL", "speedup REAL",   "instants INTEGER", "collision queries INTEGER",
        "effort REAL"};
    planner.runs.push_back(ValueLine(
        {StatusIndex(std::string(Name(method.ending))), method.solved() ? "1" : "0",
         Number(method.wall), Number(method.cost), Number(method.duration), Number(method.speedup),
         Number(method.instants), Number(method.collision_queries), Number(method.effort)}));
    if (!method.raw()) planner.progress.push_back(ProgressLine(method, raw_duration));
  }
}

std::string PlannerText(const LoggedPlanner& planner) {
  const auto block = [](const std::vector<std::string>& lines, const std::string& what) {
    std::string text = std::to_string(lines.size()) + " " + what + "\n";
    for (const std::string& line : lines) text += line + "\n";
    return text;
  };
  std::string text = planner.name + "\n" + block(planner.settings, "common properties");
  text += block(planner.properties, "properties for each run") + block(planner.runs, "runs");
  if (!planner.progress.empty()) {
    text += block({"time REAL", "best cost REAL", "instants INTEGER", "effort REAL"},
                  "progress properties for each run");
    text += block(planner.progress, "runs");
  }
  return text + ".\n";
}

std::string ScenarioLog(const std::string& scenario, const std::vector<LoggedRun>& runs) {
  std::vector<LoggedPlanner> planners;
  double limit = 0.0, total = 0.0;
  std::string setup;
  for (const LoggedRun& run : runs) {
    if (!run.plan.is_null()) AddPlan(run.plan, &planners);
    AddMethods(run.record, &planners);
    total += run.manifest.value("wall_s", 0.0);
    setup += run.record.run + ": robot " + Member(run.manifest, "robot") + ", scene " +
             Member(run.manifest, "scene") + ", seed " + Member(run.manifest, "seed") +
             ", accepted when " + Member(run.manifest, "acceptance") + "\n";
    for (const json& method : run.manifest["methods"]) {
      limit = std::max(limit, method["requested"].value("effort", 0.0));  // about a second each
    }
  }
  const json& first = runs.front().manifest;
  std::string text = "halfstep version " + Member(first, "version") + "\n";
  text += "Experiment " + Word(scenario) + "\n0 experiment properties\n";
  text += "Running on " + Word(Member(first["host"], "machine")) + "\n";
  text += "Starting at " + Member(first, "written") + "\n<<<|\n" + setup + "|>>>\n";
  text += "<<<|\n" + Member(first["host"], "system") + " " + Member(first["host"], "release") +
          ", " + Member(first["host"], "cores") + " cores\n|>>>\n";
  text += Member(first, "seed") + " is the random seed\n";
  text += Number(limit) + " seconds per run\n0 MB per run\n";
  text += std::to_string(runs.size()) + " runs per planner\n";
  text += Number(total) + " seconds spent to collect the data\n1 enum type\nstatus";
  for (const std::string& status : Statuses()) text += "|" + status;
  text += "\n" + std::to_string(planners.size()) + " planners\n";
  for (const LoggedPlanner& planner : planners) text += PlannerText(planner);
  return text;
}

}  // namespace

std::map<std::string, std::string> OmplLogs(const std::vector<std::string>& runs) {
  std::map<std::string, std::vector<LoggedRun>> scenarios;
  for (const std::string& run : runs) {
    LoggedRun logged = ReadLogged(run);
    scenarios[logged.record.scenario].push_back(std::move(logged));
  }
  std::map<std::string, std::string> logs;
  for (const auto& [scenario, logged] : scenarios) logs[scenario] = ScenarioLog(scenario, logged);
  return logs;
}

}  // namespace halfstep
