#include "experiments/live/walk_tail.h"

#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep {

double WalkTail::end() const {
  const HomotopyParameters& of = plan.parameters;
  double start = begin;
  for (size_t i = 0; i < of.overlaps.size(); ++i) start += of.durations[i] - of.overlaps[i];
  return start + of.durations.back();
}

WalkTail TailOf(const WalkPlan& plan, const SuperposedWalk& walk, int first) {
  HALFSTEP_CHECK(first >= 0 && first % 2 == 0 && first < plan.sequence.size(),
                 "half-step " << first);
  WalkTail tail{.first = first,
                .begin = walk.start_of(first),
                .overlap = first > 0 ? Nth(plan.parameters.overlaps, first - 1) : 0.0,
                .plan = plan};
  tail.plan.sequence = PlannedPart(plan.sequence, first, plan.sequence.size());
  for (const ParameterFamily family : AllParameterFamilies()) {
    std::vector<double>& values = tail.plan.parameters.of(family);
    values.erase(values.begin(), values.begin() + Traits(family).index_at(first));
  }
  return tail;
}

void Join(const WalkTail& tail, WalkPlan* walk) {
  HALFSTEP_CHECK(tail.first <= walk->sequence.size(),
                 "half-step " << tail.first << " of " << walk->sequence.size());
  if (tail.first == 0) {
    *walk = tail.plan;
    return;
  }
  std::vector<PlacedHalfStep>& half_steps = walk->sequence.half_steps;
  half_steps.resize(static_cast<size_t>(tail.first));
  const std::vector<PlacedHalfStep>& more = tail.plan.sequence.half_steps;
  half_steps.insert(half_steps.end(), more.begin(), more.end());
  for (const ParameterFamily family : AllParameterFamilies()) {
    std::vector<double>& values = walk->parameters.of(family);
    values.resize(static_cast<size_t>(Traits(family).index_at(tail.first)));
    if (family == ParameterFamily::kOverlap) values.back() = tail.overlap;
    const std::vector<double>& of_tail = tail.plan.parameters.of(family);
    values.insert(values.end(), of_tail.begin(), of_tail.end());
  }
}

}  // namespace halfstep
