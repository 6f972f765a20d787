#include "experiments/live/overlap_search.h"

#include <algorithm>
#include <memory>

#include "smoothing/methods/accepted_in_parts.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/proof/sampled_feasibility.h"
#include "smoothing/proof/stoppable_feasibility.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

struct Next {
  std::vector<int> junctions;
  double cap = 1.0;  // of their natural bounds
};

// The next junctions whose overlaps were not found yet and which leave room for one.
Next NextJunctions(const SuperposedWalk& walk, const LiveOptions& live, double from, int begun,
                   int ahead, const Proposal& proposal) {
  constexpr double kLeastRoom = 0.05;  // [s]
  const int junctions = std::min(walk.num_half_steps() - 1, begun + ahead);
  std::vector<int> next;
  double cap = 1.0;
  for (int j = begun; j < junctions && cap == 1.0; ++j) {
    if (Nth(proposal.smoothed, j)) continue;
    // Half-step j + 1 must not begin before `from`.
    const double room = walk.end_of(j) - from;
    if (walk.start_of(j + 1) <= from || room < kLeastRoom) continue;
    const double bound = NaturalOverlapBound(walk.parameters(), j);
    if (room < bound && !next.empty()) break;
    cap = std::min(1.0, room / bound);
    next.push_back(j);
    if (static_cast<int>(next.size()) == live.smooth_at_once) break;
  }
  return {next, cap};
}

// Every parameter of a walk but the overlaps of some junctions, at its value.
std::vector<FixedParameter> AllBut(const std::vector<int>& next, const WalkPlan& plan) {
  std::vector<FixedParameter> fixed;
  for (const ParameterFamily family : AllParameterFamilies()) {
    for (int i = 0; i < Traits(family).count(plan.sequence); ++i) {
      const HomotopyParameter parameter{family, i};
      const bool free =
          family == ParameterFamily::kOverlap && std::ranges::find(next, i) != next.end();
      if (!free) fixed.push_back({parameter, parameter.in(plan.parameters)});
    }
  }
  return fixed;
}

}  // namespace

bool FindOverlaps(const SafetyCheck& safety, const LiveConfig& config, double from, int begun,
                  int ahead, Proposal* proposal, std::stop_token stop) {
  constexpr double kSampled = 0.04;  // [s]
  const SuperposedWalk walk = proposal->plan.Walk();
  const auto [next, cap] = NextJunctions(walk, config.live, from, begun, ahead, *proposal);
  if (next.empty() || stop.stop_requested()) return false;
  // Half-steps that end later are not under way where these overlaps count, and only meet the same
  // world earlier, when less is uncertain.
  const int last = std::min(next.back() + 4, walk.num_half_steps() - 1);
  const CertificationScope scope{.since = std::max(from, walk.start_of(next.front())),
                                 .until = walk.end_of(last)};
  const auto test = std::make_shared<StoppableFeasibility>(
      std::make_shared<CertifiedFeasibility>(safety.evaluator(),
                                             config.experiment.smoothing.certification, scope),
      StopBranches::kAll);
  const auto sampled = std::make_shared<StoppableFeasibility>(
      std::make_shared<SampledFeasibility>(safety.evaluator(), kSampled), StopBranches::kAll);
  const WalkProblem problem(proposal->plan.sequence, test, AllBut(next, proposal->plan));
  SmoothingMonitor monitor({.stop = stop, .stop_proof = stop});
  const SmoothingResult result =
      Dichotomy(problem,
                {.tolerance = config.live.tolerance,
                 .up_down_cap = cap,
                 .down_up_cap = std::min(cap, config.live.down_up_cap),
                 .accepted_start = AcceptedInParts::Walk(proposal->plan.parameters),
                 .cheaper = sampled},
                monitor);
  proposal->effort.smooth += result.work.effort();
  if (stop.stop_requested()) return false;
  proposal->plan.parameters = result.parameters;
  for (const int j : next) Nth(proposal->smoothed, j) = true;
  proposal->first_changed = next.front() + 1;
  return true;
}

}  // namespace halfstep
