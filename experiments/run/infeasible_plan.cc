#include "experiments/run/infeasible_plan.h"

#include "experiments/run/missed_demands_text.h"
#include "experiments/run/plan_remedies.h"

namespace halfstep {

std::vector<std::string> InfeasiblePlanText(const ExperimentRun& run, const std::stop_token& stop) {
  if (!run.missed()) return {};
  std::vector<std::string> lines =
      MissedDemandsText(run.evaluator(), run.problem().sequence(), *run.missed());
  for (std::string& line : PlanRemedies(run.experiment(), run.problem(), *run.missed(), stop)) {
    lines.push_back(std::move(line));
  }
  if (!run.config().smoothing.repair_plan) {
    lines.push_back(
        "`smoothing.repair_plan: true` looks for durations and heights of single steps that help");
  }
  return lines;
}

}  // namespace halfstep
