#include "smoothing/methods/walk_window.h"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "smoothing/walk/footstep_families.h"
#include "smoothing/walk/splice.h"
#include "wpg/check.h"
#include "wpg/motion/moved_footsteps.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// At most four half-steps are under way at once (smoothing/README.md, "Band"), so no more than
// these before and behind a window bear on it. Even, since parts begin with an up half-step.
constexpr int kNeighbours = 4;

// Half-steps begin … end − 1 of a walk.
struct Part {
  int begin, end;

  int first_of(ParameterFamily family) const { return Traits(family).index_at(begin); }
  int count_of(ParameterFamily family) const {
    const ParameterFamilyTraits& traits = Traits(family);
    return traits.index_at(end - 1) + (traits.joins() ? 0 : 1) - traits.index_at(begin);
  }
};

// The plan of a part. It begins on footsteps of the two steps before it, where the walk `at` has
// them; its own are where they are planned.
HalfStepSequence SequenceOf(const Part& part, const HalfStepSequence& walk,
                            const HomotopyParameters& at) {
  const int from = std::max(0, part.begin - 4), before = (part.begin - from) / 2;
  std::vector<Pose2> moves = MovesOfFootsteps(at);
  if (moves.empty() || before == 0) return PlannedPart(walk, part.begin, part.end);
  moves.erase(moves.begin(), moves.begin() + from / 2);
  moves.resize(static_cast<size_t>(before));
  moves.resize(static_cast<size_t>((part.end - from) / 2));
  return PlannedPart(WithFootstepsMoved(PlannedPart(walk, from, part.end), moves), 2 * before,
                     part.end - from);
}

// By family and index in the part: whether a parameter is to stay.
using Stays = std::array<std::vector<bool>, kNumParameterFamilies>;

Stays WhatStays(const Part& part, const WalkProblem& problem, int first, int last) {
  Stays stays;
  for (const ParameterFamily family : AllParameterFamilies()) {
    const ParameterFamilyTraits& traits = Traits(family);
    for (int i = 0; i < part.count_of(family); ++i) {
      const auto [from, to] = traits.half_steps(part.first_of(family) + i);
      const bool before = traits.joins() && to == first;
      Nth(stays, family).push_back(to > last || (from < first && !before));
    }
  }
  for (const FixedParameter& one : problem.fixed()) {
    const ParameterFamily family = one.parameter.family;
    const int i = one.parameter.index - part.first_of(family);
    if (i < 0 || i >= part.count_of(family)) continue;
    Nth(Nth(stays, family), i) = true;
  }
  return stays;
}

// Beside an overlap that stays, the ZMP's shifts stay, and where it is too long for the planned
// durations, these stay, too.
void KeepWhatBoundsOverlaps(const HalfStepSequence& sequence, const HomotopyParameters& at,
                            Stays* stays) {
  std::vector<bool>& durations = Nth(*stays, ParameterFamily::kDuration);
  std::vector<bool>& shifts = Nth(*stays, ParameterFamily::kZmpShift);
  const std::vector<bool>& overlaps = Nth(*stays, ParameterFamily::kOverlap);
  const std::vector<double> planned = PlannedMotion(sequence).durations;
  for (size_t i = 0; i < overlaps.size(); ++i) {
    if (!overlaps[i]) continue;
    const int junction = static_cast<int>(i);
    if (KindOfJunction(junction) == JunctionKind::kUpDown) shifts[i] = shifts[i + 1] = true;
    HomotopyParameters beside = at;
    for (const size_t k : {i, i + 1}) {
      if (!durations[k]) beside.durations[k] = planned[k];
    }
    if (at.overlaps[i] <= NaturalOverlapBound(beside, junction)) continue;
    durations[i] = durations[i + 1] = true;
  }
}

}  // namespace

WalkWindow WindowOf(const WalkProblem& problem, const HomotopyParameters& at, int first, int last) {
  const int n = problem.sequence().size();
  HALFSTEP_CHECK(first >= 0 && first % 2 == 0 && last % 2 == 1 && first < last && last < n,
                 "half-steps " << first << " to " << last << " of " << n);
  // Where the window ends at rest, nothing behind it depends on it.
  const bool to_rest = last + 1 == n || Nth(at.overlaps, last) <= 0.0;
  const bool local = problem.scene().rests();
  const Part part = {
      local ? std::max(0, first - kNeighbours) : 0,
      local ? std::min(n, last + 1 + (to_rest ? 0 : kNeighbours)) : n,
  };
  HalfStepSequence sequence = SequenceOf(part, problem.sequence(), at);
  HomotopyParameters parameters;
  for (const ParameterFamily family : AllParameterFamilies()) {
    const auto from = at.of(family).begin() + part.first_of(family);
    parameters.of(family).assign(from, from + part.count_of(family));
  }
  Stays stays = WhatStays(part, problem, first, last);
  KeepWhatBoundsOverlaps(sequence, parameters, &stays);
  std::vector<FixedParameter> fixed;
  for (const ParameterFamily family : AllParameterFamilies()) {
    for (int i = 0; i < part.count_of(family); ++i) {
      if (!Nth(Nth(stays, family), i)) continue;
      const HomotopyParameter parameter{family, i};
      fixed.push_back({parameter, parameter.in(parameters)});
    }
  }
  const int size = part.end - part.begin;
  // The last neighbour is there only so that the stretch before it ends where it does.
  const bool cut = part.end < n && !to_rest;
  return {.begin = part.begin,
          .proved_first = std::max(0, first - part.begin - 1),
          .proved_last = size - (cut ? 2 : 1),
          .parameters = parameters,
          .problem = WalkProblem(
              std::move(sequence),
              std::shared_ptr<const FeasibilityTest>(std::shared_ptr<void>(), &problem.test()),
              std::move(fixed))};
}

HomotopyParameters WalkWindow::Cut(const HomotopyParameters& walk) const {
  HomotopyParameters part = parameters;
  for (const ParameterFamily family : AllParameterFamilies()) {
    std::vector<double>& values = part.of(family);
    std::copy_n(walk.of(family).begin() + Traits(family).index_at(begin), values.size(),
                values.begin());
  }
  return part;
}

void WalkWindow::Paste(const HomotopyParameters& part, HomotopyParameters* walk) const {
  for (const ParameterFamily family : AllParameterFamilies()) {
    const std::vector<double>& values = part.of(family);
    std::copy(values.begin(), values.end(),
              walk->of(family).begin() + Traits(family).index_at(begin));
  }
}

}  // namespace halfstep
