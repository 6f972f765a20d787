#include "experiments/run/infeasible_plan.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "experiments/run/missed_demands_text.h"
#include "experiments/run/plan_inputs.h"
#include "smoothing/methods/plan_remedies.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// "2 cm of crouch (`half_step.crouch_m: 0.02`)"
std::string CrouchText(double crouch) {
  return Formatted("%.3g cm of crouch (`half_step.crouch_m: %.3g`)", 100.0 * crouch, crouch);
}

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
  if (change.crouch) return CrouchText(*change.crouch);
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

// FindRemedies in words: a sentence on each that was found, with the key to set, on each footstep
// for which nothing was, and whether the first of each footstep makes the whole plan feasible.
std::vector<std::string> RemediesText(const Experiment& experiment, const WalkProblem& problem,
                                      const MissedDemands& missed, const std::stop_token& stop) {
  const ExperimentConfig& config = experiment.config;
  const ChangeablePlan plan{
      .sequence = problem.sequence(),
      .usual = {.duration = config.half_step.duration,
                .via_height = config.half_step.via_height,
                .crouch = config.half_step.crouch},
      .With = [&](const std::vector<PlanChange>& changes) -> std::optional<HalfStepSequence> {
        try {
          return SequenceOf(Changed(config, changes), experiment.robot, *experiment.scene.ground);
        } catch (const InputError&) {
          return std::nullopt;
        }
      }};
  const PlanRemedies remedies = FindRemedies(plan, problem.test(), missed, stop);
  std::vector<std::string> lines;
  for (const PlanChange& change : remedies.of_all) {
    lines.push_back("tried, and feasible: every footstep: " + ChangeText(plan, change));
  }
  if (remedies.crouch_to_reach) {
    lines.push_back("tried in part: with " + CrouchText(*remedies.crouch_to_reach) +
                    " the legs reach, but other demands are missed");
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

}  // namespace

InfeasibleWalk ExplainPlan(const Experiment& experiment, const WalkProblem& problem,
                           MissedDemands missed, const std::stop_token& stop) {
  InfeasibleWalk walk{.method = "raw",
                      .inputs = LookAtFootsteps(experiment, problem.evaluator()),
                      .missed = std::move(missed),
                      .help = {}};
  walk.help = RemediesText(experiment, problem, walk.missed, stop);
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
