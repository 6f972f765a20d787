#include "experiments/live/near_rest.h"

#include <algorithm>
#include <utility>

#include "wpg/nth.h"

namespace halfstep {

bool BeginsAtRest(const SuperposedWalk& walk, int half_step) {
  return half_step == 0 || walk.start_of(half_step) >= walk.end_of(half_step - 1);
}

std::optional<NearRest> NearRest::Of(const Situation& s, const SuperposedWalk& walk,
                                     const SafetyCheck& among, const ExperimentConfig& config) {
  const bool under_way = std::ranges::count(s.grant.near, s.begun) > 0;
  const bool next = std::ranges::count(s.grant.near, s.begun + 1) > 0;
  const bool ends =
      s.begun + 1 == walk.num_half_steps() && !under_way && walk.duration() <= s.hand_over;
  if (!s.stopped && !under_way && !next && !ends) return std::nullopt;
  const int j = !s.stopped && under_way ? s.begun : s.begun + 1;
  if (j == walk.num_half_steps()) {
    return At(among, config, walk, j, std::max(s.hand_over, walk.duration()));
  }
  if (!BeginsAtRest(walk, j)) return std::nullopt;
  return At(among, config, walk, j, walk.start_of(j));
}

std::optional<NearRest> NearRest::AtStart(const SafetyCheck& among, const ExperimentConfig& config,
                                          const std::array<Foothold, 2>& start,
                                          const HalfStep& like) {
  // Where a walk begins does not depend on where it goes.
  const Footstep in_place{.side = Side::kRight, .X_WF = Nth(start, Index(Side::kRight))};
  WalkPlan plan;
  plan.sequence = MakeSequence(start, {in_place}, like.via_lateral, like.shape,
                               MotionModelOf(among.evaluator().robot(), like.shape));
  plan.parameters = PlannedMotion(plan.sequence);
  return At(among, config, plan.Walk(), 0, 0.0);
}

std::optional<NearRest> NearRest::At(const SafetyCheck& among, const ExperimentConfig& config,
                                     const SuperposedWalk& walk, int half_step, double begin) {
  constexpr double kNearer = 1e-3;  // [m]
  const double demanded = config.smoothing.limits.demanded_of(MarginFamily::kClearance);
  const LocalTime at = walk.Locate(std::min(begin, walk.duration()));
  std::optional<SafetyCheck> safety;
  double nearest = demanded;
  Scene scene = among.evaluator().scene();
  // One obstacle after the other, the nearest first.
  while (true) {
    const MarginEvaluator& evaluator = (safety ? *safety : among).evaluator();
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    const Margin margin = Nth(evaluator.At(walk, at, &scratch), MarginFamily::kClearance);
    if (margin.value >= demanded) break;
    if (!(margin.value >= 0.0) || margin.other < 0) return std::nullopt;
    if (scene.ObstacleAt(margin.other) == nullptr) return std::nullopt;  // the ground is known
    nearest = std::min(nearest, margin.value);
    // To demand less of an obstacle is to know better where it is.
    Nth(scene.obstacles, margin.other).motion.error -=
        demanded - std::max(0.0, margin.value - kNearer);
    safety.emplace(among.evaluator().robot(), scene, config);
  }
  if (!safety) return std::nullopt;
  return NearRest(half_step, nearest, *std::move(safety), config);
}

}  // namespace halfstep
