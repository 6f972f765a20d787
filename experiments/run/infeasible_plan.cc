#include "experiments/run/infeasible_plan.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "experiments/run/missed_demands_text.h"
#include "experiments/run/plan_inputs.h"
#include "experiments/run/plan_remedies_text.h"

namespace halfstep {

InfeasibleWalk ExplainPlan(const Experiment& experiment, const WalkProblem& problem,
                           MissedDemands missed, const std::stop_token& stop) {
  InfeasibleWalk walk{.method = "raw",
                      .inputs = LookAtFootsteps(experiment, problem.evaluator()),
                      .missed = std::move(missed),
                      .help = {}};
  walk.help = PlanRemediesText(experiment, problem, walk.missed, stop);
  if (!experiment.config.smoothing.repair_plan) {
    walk.help.push_back(
        "`smoothing.repair_plan: true` looks for durations and heights of single steps that help");
  }
  return walk;
}

std::vector<std::string> InfeasibleText(const WalkProblem& problem, const InfeasibleWalk& walk) {
  std::vector<std::string> lines = walk.inputs;
  for (std::string& line :
       MissedDemandsText(problem.evaluator(), problem.sequence(), walk.missed)) {
    lines.push_back(std::move(line));
  }
  lines.insert(lines.end(), walk.help.begin(), walk.help.end());
  return lines;
}

nlohmann::ordered_json InfeasibleJson(const WalkProblem& problem, const InfeasibleWalk& walk) {
  std::vector<std::string> help = FamilyRemedies(problem.evaluator(), walk.missed);
  help.insert(help.end(), walk.help.begin(), walk.help.end());
  return {{"inputs", walk.inputs},
          {"instants", walk.missed.instants},
          {"missed", MissedDemandsJson(problem.evaluator(), problem.sequence(), walk.missed)},
          {"help", help}};
}

std::string InfeasibleJsonText(const WalkProblem& problem,
                               const std::vector<InfeasibleWalk>& walks) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const InfeasibleWalk& walk : walks) json[walk.method] = InfeasibleJson(problem, walk);
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace halfstep
