#include "experiments/live/refinement.h"

#include <limits>
#include <memory>

#include "smoothing/methods/improve_ahead.h"
#include "smoothing/methods/solver_method_options.h"
#include "smoothing/proof/stoppable_feasibility.h"

namespace halfstep {

void Refine(const SafetyCheck& safety, const LiveConfig& config, double from, int begun,
            Proposal* proposal) {
  const SuperposedWalk walk = proposal->plan.Walk();
  const int n = walk.num_half_steps();
  const double taken = from + config.live.budget.refine;
  int first = begun + 1;
  while (first < n && walk.start_of(first) <= taken) ++first;
  first = (first + 1) / 2 * 2;  // whole steps
  if (first >= n) return;
  const bool by_the_clock = config.live.clock == "wall";
  SmoothingMonitor monitor({.deadline = by_the_clock ? config.live.budget.refine
                                                     : std::numeric_limits<double>::infinity()});
  const auto test = std::make_shared<StoppableFeasibility>(
      std::make_shared<CertifiedFeasibility>(safety.evaluator(),
                                             config.experiment.smoothing.certification),
      StopBranches::kAll);
  proposal->refined = true;
  ParameterChoice choice =
      config.experiment.smoothing.options.Get(OptimizerGroup()).options.program.parameters;
  choice.footsteps = false;  // footsteps are the planner's while the world changes
  const auto found = ImproveAhead(proposal->plan, test, first, {.choice = choice}, monitor);
  if (!found) return;
  proposal->plan.parameters = *found;
  proposal->first_changed = first;
  proposal->kind = ProposalKind::kSmoothed;
  proposal->reason = "half-steps to come, by a program";
}

}  // namespace halfstep
