#include "experiments/run/plan_remedies_text.h"

#include <cmath>

#include "smoothing/methods/plan_remedies.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// "a via point 0.26 m high in place of 0.25 m (`footsteps.3.via_height_m: 0.26`)"
std::string ChangeText(const ChangeablePlan& plan, const PlanChange& change) {
  const std::string key = change.step ? Formatted("footsteps.%d.", *change.step) : "half_step.";
  if (change.landing) {
    return Formatted("a landing %.0f cm %s (`%sx_m: %.3g`, `%sy_m: %.3g`)",
                     100.0 * std::abs(change.farther), change.farther > 0.0 ? "farther" : "nearer",
                     key.c_str(), change.landing->x(), key.c_str(), change.landing->y());
  }
  PlanChange planned = plan.usual;
  if (change.step) {
    const HalfStep& up = Nth(plan.sequence.half_steps, 2 * *change.step).half_step;
    planned = {.duration = up.duration, .via_height = up.via_height};
  }
  if (!change.duration) {
    return Formatted("a via point %.3g m high in place of %.3g m (`%svia_height_m: %.3g`)",
                     *change.via_height, *planned.via_height, key.c_str(), *change.via_height);
  }
  if (!change.via_height) {
    return Formatted("half-steps of %.3g s in place of %.3g s (`%sduration_s: %.3g`)",
                     *change.duration, *planned.duration, key.c_str(), *change.duration);
  }
  return Formatted(
      "a via point %.3g m high and half-steps of %.3g s (`%svia_height_m: %.3g`, "
      "`%sduration_s: %.3g`)",
      *change.via_height, *change.duration, key.c_str(), *change.via_height, key.c_str(),
      *change.duration);
}

}  // namespace

std::vector<std::string> PlanRemediesText(const Experiment& experiment, const WalkProblem& problem,
                                          const MissedDemands& missed,
                                          const std::stop_token& stop) {
  const ExperimentConfig& config = experiment.config;
  const ChangeablePlan plan{
      .sequence = problem.sequence(),
      .usual = {.duration = config.half_step.duration, .via_height = config.half_step.via_height},
      .With = [&](const std::vector<PlanChange>& changes) {
        return SequenceOf(Changed(config, changes), experiment.robot);
      }};
  const PlanRemedies remedies = FindRemedies(plan, problem.test(), missed, stop);
  std::vector<std::string> lines;
  for (const PlanChange& change : remedies.of_all) {
    lines.push_back("tried, and feasible: every footstep: " + ChangeText(plan, change));
  }
  for (const auto& [step, found] : remedies.steps) {
    const std::string whose = Formatted("footstep %d: ", step + 1);
    for (const PlanChange& change : found) {
      lines.push_back("tried, and feasible: " + whose + ChangeText(plan, change));
    }
    if (!found.empty()) continue;
    lines.push_back("tried in vain: " + whose +
                    "other heights and durations, and landings up to 8 cm off along its way");
  }
  if (remedies.together && remedies.steps.size() > 1) {
    lines.push_back("with the first of each footstep the plan is feasible");
  }
  return lines;
}

}  // namespace halfstep
