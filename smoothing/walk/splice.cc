#include "smoothing/walk/splice.h"

#include <algorithm>
#include <limits>

#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// The shape of the half-steps that follow, and the waist's height, is that of the last one.
HalfStepSequence Following(const HalfStepSequence& sequence, const std::array<Foothold, 2>& feet,
                           const std::vector<Footstep>& footsteps) {
  const HalfStep& like = sequence.half_steps.back().half_step;
  return MakeSequence(feet, footsteps, like.via_lateral, like.shape, sequence.model);
}

void Append(const HalfStepSequence& tail, HalfStepSequence* sequence) {
  sequence->half_steps.insert(sequence->half_steps.end(), tail.half_steps.begin(),
                              tail.half_steps.end());
}

}  // namespace

int CommonHalfSteps(const SuperposedWalk& a, const SuperposedWalk& b) {
  const int n = std::min(a.num_half_steps(), b.num_half_steps());
  int m = 0;
  while (m < n && a.half_step(m) == b.half_step(m) && a.X_WS(m) == b.X_WS(m) &&
         a.start_of(m) == b.start_of(m)) {
    ++m;
  }
  return m;
}

double AgreeUntil(const SuperposedWalk& a, const SuperposedWalk& b) {
  const int m = CommonHalfSteps(a, b);
  double until = std::numeric_limits<double>::infinity();
  for (const SuperposedWalk* walk : {&a, &b}) {
    if (m < walk->num_half_steps()) until = std::min(until, walk->start_of(m));
  }
  return until;
}

std::array<Foothold, 2> StanceAfter(const HalfStepSequence& sequence, int last) {
  HALFSTEP_CHECK(last >= 0 && last < sequence.size(), "half-step " << last);
  const auto& [down, X_WS, rest] = Nth(sequence.half_steps, last / 2 * 2 + 1);
  std::array<Foothold, 2> feet;
  Nth(feet, Index(down.support)) = X_WS;
  Nth(feet, Index(down.swing())) = X_WS * down.X_SF;
  return feet;
}

HalfStepSequence PlannedPart(const HalfStepSequence& sequence, int begin, int end) {
  HalfStepSequence part{.start = begin == 0 ? sequence.start : StanceAfter(sequence, begin - 1),
                        .half_steps = {},
                        .model = sequence.model};
  part.half_steps.assign(sequence.half_steps.begin() + begin, sequence.half_steps.begin() + end);
  return part;
}

WalkPlan Delayed(const WalkPlan& walk, int last, double begin) {
  HALFSTEP_CHECK(last >= 0 && last + 1 < walk.sequence.size(), "half-step " << last);
  WalkPlan delayed = walk;
  Nth(delayed.parameters.overlaps, last) = walk.Walk().end_of(last) - begin;
  CheckParameters(delayed.sequence, delayed.parameters);
  return delayed;
}

WalkPlan Changed(const WalkPlan& walk, int last, const std::vector<Footstep>& footsteps) {
  HALFSTEP_CHECK(last >= 0 && last < walk.sequence.size(), "half-step " << last);
  WalkPlan changed = walk;
  HalfStepSequence& sequence = changed.sequence;
  sequence.half_steps.resize(static_cast<size_t>(last + 1));
  auto next = footsteps.begin();
  std::array<Foothold, 2> feet = StanceAfter(walk.sequence, last);
  if (last % 2 == 0) {
    PlacedHalfStep down = sequence.half_steps.back();
    const Side swing = down.half_step.swing();
    HALFSTEP_CHECK(next != footsteps.end() && next->side == swing,
                   "the foot in the air has to land");
    down.half_step.kind = HalfStepKind::kDown;
    down.half_step.X_SF = down.X_WS.Inverse() * next->X_WF;
    down.half_step.duration = next->duration;
    down.rest = next->rest_on_one_foot;
    sequence.half_steps.push_back(down);
    Nth(feet, Index(swing)) = next->X_WF;
    ++next;
  }
  if (next != footsteps.end()) {
    Append(Following(sequence, feet, {next, footsteps.end()}), &sequence);
  }
  // What is kept of each family; the rest is as planned.
  const HomotopyParameters old = walk.parameters;
  changed.parameters = PlannedMotion(sequence);
  for (const ParameterFamily family : AllParameterFamilies()) {
    const ParameterFamilyTraits& traits = Traits(family);
    // The step that `last` begins lands on a footstep of its own.
    const bool lands_anew = traits.move != nullptr && last % 2 == 0;
    const int kept = traits.index_at(last) + (traits.joins() || lands_anew ? 0 : 1);
    std::copy_n(old.of(family).begin(), kept, changed.parameters.of(family).begin());
  }
  return changed;
}

std::vector<FixedParameter> FixedByBeginning(const WalkPlan& walk, int last) {
  std::vector<FixedParameter> fixed;
  for (const ParameterFamily family : AllParameterFamilies()) {
    const ParameterFamilyTraits& traits = Traits(family);
    const int count = last < 0 ? 0 : traits.index_at(last) + (traits.joins() ? 0 : 1);
    for (int i = 0; i < count; ++i) {
      const HomotopyParameter parameter{family, i};
      fixed.push_back({parameter, parameter.in(walk.parameters)});
    }
  }
  return fixed;
}

}  // namespace halfstep
