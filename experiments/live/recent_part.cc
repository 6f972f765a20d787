#include "experiments/live/recent_part.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr int kKept = 12;      // half-steps before the latest that has begun, at least
constexpr int kMostPast = 40;  // fewer are not worth cutting

// The step of half-steps 0 and 1, and a rest before half-step 2 that begins at `begin` [s], to the
// bit. False where rounding does not allow that.
bool RestUntil(double begin, WalkPlan* plan) {
  double& overlap = Nth(plan->parameters.overlaps, 1);
  const SuperposedWalk walk = plan->Walk();
  const double duration = walk.tracks(1).duration(), from = walk.start_of(1);
  double rest = duration - (begin - from);
  // As SuperposedWalk adds up.
  const auto reached = [&] { return from + (duration - rest); };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 16 && reached() != begin; ++i) {
    rest = std::nextafter(rest, reached() < begin ? -kInfinity : kInfinity);
  }
  overlap = rest;
  return reached() == begin && rest <= 0.0 && rest > -kLongestRest;
}

}  // namespace

std::optional<RecentPart> RecentPart::Of(const Situation& s) {
  if (s.begun < kMostPast) return std::nullopt;
  RecentPart part;
  part.first_ = (s.begun - kKept) / 2 * 2 - 2;
  const int first = part.first_;
  const SuperposedWalk walk = s.plan.Walk();
  // What is cut is over when the next half-steps begin that count.
  for (int i = 0; i < first + 2; ++i) {
    if (walk.end_of(i) > walk.start_of(s.begun - 2)) return std::nullopt;
  }
  Situation& recent = part.recent_ = s;
  recent.plan.sequence = PlannedPart(s.plan.sequence, first, s.plan.sequence.size());
  for (const ParameterFamily family : AllParameterFamilies()) {
    std::vector<double>& values = recent.plan.parameters.of(family);
    values.erase(values.begin(), values.begin() + Traits(family).index_at(first));
  }
  if (!RestUntil(walk.start_of(first + 2), &recent.plan)) return std::nullopt;
  recent.smoothed.erase(recent.smoothed.begin(), recent.smoothed.begin() + first);
  recent.grant.through -= first;
  for (int& near : recent.grant.near) near -= first;
  recent.robot_through -= first;
  recent.begun -= first;
  part.past_ = s.plan;
  part.smoothed_ = s.smoothed;
  return part;
}

Proposal RecentPart::Whole(Proposal proposal) const {
  WalkPlan& plan = proposal.plan;
  std::vector<PlacedHalfStep> half_steps = past_.sequence.half_steps;
  half_steps.resize(static_cast<size_t>(first_));
  half_steps.insert(half_steps.end(), plan.sequence.half_steps.begin(),
                    plan.sequence.half_steps.end());
  plan.sequence.start = past_.sequence.start;
  plan.sequence.half_steps = std::move(half_steps);
  Nth(plan.parameters.overlaps, 1) = Nth(past_.parameters.overlaps, first_ + 1);
  for (const ParameterFamily family : AllParameterFamilies()) {
    const std::vector<double>& past = past_.parameters.of(family);
    std::vector<double>& values = plan.parameters.of(family);
    values.insert(values.begin(), past.begin(), past.begin() + Traits(family).index_at(first_));
  }
  proposal.smoothed.insert(proposal.smoothed.begin(), smoothed_.begin(),
                           smoothed_.begin() + first_);
  proposal.grant.through += first_;
  for (int& near : proposal.grant.near) near += first_;
  proposal.robot_through += first_;
  if (proposal.first_changed >= 0) proposal.first_changed += first_;
  return proposal;
}

}  // namespace halfstep
