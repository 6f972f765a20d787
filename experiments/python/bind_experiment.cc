#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

#include "experiments/config/experiment.h"
#include "experiments/python/bindings.h"
#include "experiments/python/long_call.h"
#include "experiments/python/placed_experiment.h"
#include "experiments/run/missed_demands_text.h"
#include "experiments/run/plan_inputs.h"
#include "experiments/run/planning.h"
#include "experiments/run/smoothing_of.h"
#include "experiments/tables/ending_words.h"
#include "experiments/tables/result_tables.h"
#include "smoothing/margins/not_covered_by.h"
#include "smoothing/methods/overlap_prices.h"
#include "smoothing/methods/run_smoother.h"
#include "smoothing/proof/missed_demands.h"

namespace py = pybind11;

namespace halfstep::python {
namespace {

PlacedWalk WalkAt(const PlacedExperiment& placed, const py::dict& given) {
  const auto setting = placed.Setting();
  return WalkWith(setting, setting->problem.Start(), given);
}

// (status, sentence, footsteps as rows (foot, x, y, z, yaw), wall time [s], config of the plan).
py::tuple Plan(const PlacedExperiment& placed, const py::object& progress) {
  if (!placed.config.has_goal) throw std::invalid_argument("plan: the config has no goal");
  PlannedWalk walk;
  CallLong(progress, [&](const LongCallHooks& hooks) {
    walk = PlanWalk(placed.config, {placed.experiment.robot, placed.experiment.scene},
                    {.progress = hooks.progress, .stop = hooks.stop});
  });
  py::list footsteps;
  for (const Footstep& step : walk.plan.footsteps) {
    const Foothold& at = step.X_WF;
    footsteps.append(py::make_tuple(std::string(Name(step.side)), at.x, at.y, at.height, at.yaw));
  }
  return py::make_tuple(std::string(Name(walk.plan.status)), walk.plan.sentence, footsteps,
                        walk.plan.time, ConfigToPython(walk.config));
}

// What Python knows of a method's result.
py::dict ResultOf(const std::shared_ptr<const WalkSetting>& setting, const std::string& method,
                  SmoothingResult result) {
  MethodRun run(method);
  const MarginEvaluator& evaluator = setting->problem.evaluator();
  AddPrices(SuperposedWalk(setting->problem.sequence(), result.parameters), evaluator,
            &result.junctions);
  run.result = std::move(result);
  run.duration = DurationOf(run.result.parameters);
  py::dict dict;
  dict["method"] = method;
  dict["status"] = std::string(opt::Name(run.result.ending));
  dict["message"] = run.result.message;
  dict["feasible"] = run.result.feasible;
  dict["judged_by"] = std::string(Name(run.result.evidence));
  dict["cost"] = run.result.cost;
  dict["wall"] = run.result.wall;
  dict["instants"] = run.result.work.evaluated();
  dict["effort"] = run.result.work.effort();
  dict["repeatable"] = NotRepeatable(run.result.ending, run.result.message).empty();
  dict["walk"] =
      PlacedWalk{setting, SuperposedWalk(setting->problem.sequence(), run.result.parameters)};
  dict["iterates"] = ToPython(IteratesCsv(run));
  dict["overlaps"] = run.result.junctions.empty()
                         ? py::object(py::none())
                         : py::object(ToPython(OverlapsCsv(evaluator, run)));
  py::list pareto;
  for (const ParetoPoint& point : run.result.pareto) {
    pareto.append(py::make_tuple(
        point.duration, point.least_slack,
        PlacedWalk{setting, SuperposedWalk(setting->problem.sequence(), point.parameters)}));
  }
  dict["pareto"] = pareto;
  return dict;
}

py::dict Smooth(const Toolbox& tools, const PlacedExperiment& placed, const std::string& method,
                const std::string& text, double deadline, const py::object& progress) {
  const auto setting = placed.Setting();
  const Smoother& smoother = tools.methods.Find(method);
  const ExperimentConfig config =
      text.empty() ? placed.config : ParseConfig(placed.path, text, {}, tools);
  const MethodOptions options = config.smoothing.options;
  SmoothingResult result;
  CallLong(progress, [&](const LongCallHooks& hooks) {
    SmoothingMonitor monitor({.progress = [&](double done) { hooks.progress(method, done); },
                              .stop = hooks.stop,
                              .stop_proof = hooks.stop,
                              .deadline = deadline,
                              .workers = WorkersOf(config)});
    result = RunSmoother(smoother, setting->problem, options, monitor);
  });
  return ResultOf(setting, method, std::move(result));
}

// Sentences on what the inputs may have wrong and what the planned motion misses, the worst first.
std::vector<std::string> Missed(const PlacedExperiment& placed) {
  const auto setting = placed.Setting();
  std::vector<std::string> lines;
  CallLong(py::none(), [&](const LongCallHooks& hooks) {
    const WalkProblem& problem = setting->problem;
    MarginEvaluator::Scratch scratch = problem.evaluator().MakeScratch();
    scratch.stop = hooks.stop;
    const SuperposedWalk walk(problem.sequence(), problem.Start());
    const Feasibility answer = problem.test().Check(walk, {0.0, walk.duration()}, &scratch);
    if (answer.verdict == Verdict::kFeasible || answer.stopped) return;
    lines = LookAtFootsteps(placed.experiment, problem.evaluator());
    for (std::string& line :
         MissedDemandsText(problem.evaluator(), problem.sequence(),
                           FindMissedDemands(problem.evaluator(), walk, answer.witness))) {
      lines.push_back(std::move(line));
    }
  });
  return lines;
}

}  // namespace

PlacedExperiment::PlacedExperiment(const std::string& file, const std::string& text,
                                   const Scene* scene, const Toolbox& tools)
    : path(file), config(ParseConfig(file, text, {}, tools)) {
  Place place = LoadPlace(config);
  if (scene != nullptr) place.scene = *scene;
  experiment = Prepare(config, std::move(place));
  config.smoothing.limits = experiment.config.smoothing.limits;
  if (const auto stepped_on = FootholdOnNoStep(experiment)) {
    throw std::invalid_argument("the plan is not feasible: " + *stepped_on);
  }
  if (config.has_goal) return;
  setting = std::make_shared<const WalkSetting>(
      WalkSetting{ProblemOf(experiment), config.smoothing.certification});
}

std::shared_ptr<const WalkSetting> PlacedExperiment::Setting() const {
  if (!setting) {
    throw std::invalid_argument(
        "the config has a goal and no footsteps yet (valid: plan().experiment, which has them)");
  }
  return setting;
}

void BindExperiment(py::module_& module, const ModuleTools& tools) {
  py::class_<PlacedExperiment, std::shared_ptr<PlacedExperiment>>(module, "Experiment")
      .def(py::init([tools](const std::string& path, const std::string& text, const Scene* scene) {
             return std::make_shared<PlacedExperiment>(path, text, scene, *tools);
           }),
           py::call_guard<py::gil_scoped_release>())
      .def_property_readonly("robot", [](const PlacedExperiment& p) { return p.experiment.robot; })
      .def_property_readonly("scene", [](const PlacedExperiment& p) { return p.experiment.scene; })
      .def_property_readonly("not_covered",
                             [](const PlacedExperiment& p) {
                               return ToPython(NotCoveredBy(p.experiment.robot, p.experiment.scene,
                                                            p.config.smoothing.limits));
                             })
      .def("walk", &WalkAt)
      .def("missed", &Missed)
      .def("plan", &Plan)
      .def("smooth", [tools](const PlacedExperiment& placed, const std::string& method,
                             const std::string& text, double deadline, const py::object& progress) {
        return Smooth(*tools, placed, method, text, deadline, progress);
      });
}

}  // namespace halfstep::python
