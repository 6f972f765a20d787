#include "experiments/run/failure_words.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "experiments/run/crouched_forms.h"
#include "experiments/run/obstacle_footprint.h"
#include "experiments/run/stepping_over.h"
#include "planner/swept/swept_volume_query.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep {
namespace {

constexpr size_t kAsked = 300;  // half-steps that one obstacle is asked about

using Refused = AskedHalfStep;

// At most `most` of them, evenly.
std::vector<Refused> SomeOf(const std::vector<Refused>& all, size_t most) {
  std::vector<Refused> some;
  const size_t count = std::min(all.size(), most);
  for (size_t j = 0; j < count; ++j) some.push_back(all[j * all.size() / count]);
  return some;
}

// How many of them something alone in the scene refuses.
int CountMet(const std::vector<Refused>& refused, const SweptVolumeQuery& query) {
  return static_cast<int>(std::ranges::count_if(refused, [&query](const Refused& one) {
    return one.up ? !query.UpIsFree(one.element, one.support, one.X_WS)
                  : !query.DownIsFree(one.element, one.support, one.X_WS);
  }));
}

// Whether an obstacle is as near to one of them as a half-step may reach.
bool IsNear(const Obstacle& obstacle, const std::vector<Refused>& refused, double reach) {
  if (!obstacle.rests()) return true;
  const Eigen::AlignedBox3d bounds = BoundsOf(obstacle.shape, obstacle.X_WO);
  const Eigen::AlignedBox2d seen(bounds.min().head<2>(), bounds.max().head<2>());
  return std::ranges::any_of(refused, [&](const Refused& one) {
    return seen.exteriorDistance(one.X_WS.Planar().position()) <= reach;
  });
}

// What no foot steps over, whatever its half-steps are.
bool IsTooHigh(double top, const RobotModel& robot) {
  constexpr double kMostOfLeg = 0.4;
  return top >= kMostOfLeg * LegLengthOf(robot);
}

// An obstacle, and how many half-steps it refuses.
struct Met {
  const Obstacle* obstacle = nullptr;
  int count = 0;
};

// The one that refuses most of them, each alone in the scene, of those that `counts` names: at most
// 200 are looked at.
Met MostMet(const std::vector<Refused>& refused, const SweptVolumes& volumes, const Place& place,
            const std::function<bool(const Obstacle&)>& counts) {
  constexpr int kObstacles = 200;
  Scene alone = place.scene.Emptied();
  Met most;
  int looked_at = 0;
  for (const Obstacle& obstacle : place.scene.obstacles) {
    if (looked_at == kObstacles) break;
    if (!counts(obstacle)) continue;
    ++looked_at;
    alone.obstacles = {obstacle};
    const int met = CountMet(refused, {volumes, place.robot.sole_outline, alone});
    if (met > most.count) most = {&obstacle, met};
  }
  return most;
}

std::string Share(int of, size_t all) {
  return Formatted("%d of the %zu half-steps refused nearest to the goal", of, all);
}

}  // namespace

std::string BudgetWords(const PlannerConfig& config, const PlanResult& plan, double proof_effort) {
  if (plan.status != PlanStatus::kBudget || plan.stop != StopReason::kBudget) return "";
  if (plan.nodes >= config.max_nodes) {
    return Formatted("`planner.max_nodes`, %d, ended it after an effort of %.3g", config.max_nodes,
                     plan.effort() + proof_effort);
  }
  return Formatted("`planner.effort`, %.4g, ended it after %lld nodes", config.effort,
                   static_cast<long long>(plan.nodes));
}

std::string NearestWords(const WatchedQuery& watched, const PlanRequest& request) {
  if (!std::isfinite(watched.nearest())) return "";
  double begin = std::numeric_limits<double>::infinity();
  for (const Foothold& sole : request.start) {
    begin = std::min(begin, request.goal.Distance(sole.Planar().position()));
  }
  return Formatted("a foot came within %.3g m of the goal, from %.3g m at the start",
                   watched.nearest(), begin);
}

Hindrance FindBlocking(const WatchedQuery& watched, const SweptVolumes& volumes, const Place& place,
                       const MarginLimits& limits) {
  const std::vector<Refused> refused = SomeOf(watched.refused().all(), kAsked);
  if (refused.empty()) return {};
  const double no_step = limits.demanded_of(MarginFamily::kNoStep);
  const RobotMeasures measures = MeasuresOf(place.robot);
  const Met most = MostMet(refused, volumes, place, [&](const Obstacle& obstacle) {
    return IsNear(obstacle, refused, 2.0 * measures.leg_length);
  });
  const Obstacle* const blocking = most.obstacle;
  Scene areas = place.scene.Emptied();
  areas.no_step = place.scene.no_step;
  const int on_area = areas.no_step.empty()
                          ? 0
                          : CountMet(refused, {volumes, place.robot.sole_outline, areas, no_step});
  if (on_area > most.count) return {Share(on_area, refused.size()) + " land on no-step areas"};
  if (blocking == nullptr) return {};
  Hindrance found{Share(most.count, refused.size()) + " meet " + Quote(blocking->name)};
  if (!blocking->rests()) {
    found.words += ", which counts everywhere that it ever is (`planner.moving`)";
    return found;
  }
  const std::string over =
      NoHalfStepOver(*blocking, place.robot, volumes, limits.demanded_of(MarginFamily::kClearance));
  const std::string hangs =
      HangsTooLow(*blocking, place.robot, limits.demanded_of(MarginFamily::kClearance));
  if (over.empty() && !hangs.empty()) {
    found.words += "; " + hangs;
    return found;
  }
  const double top = BoundsOf(blocking->shape, blocking->X_WO).max().z();
  const double lift = volumes.set.prototype.via_height;
  if (!over.empty()) {
    found.words += "; " + over;
  } else if (top >= lift) {
    found.words += Formatted(
        ", which is %.3g m high where feet rise to %.3g m: a way leads past it or there is none",
        top, lift);
  } else {
    return found;
  }
  if (!IsTooHigh(top, place.robot)) found.in_the_way = blocking;
  return found;
}

std::string MovingWords(const WatchedTimes& watched, const SweptVolumes& volumes,
                        const Place& place) {
  const std::vector<Refused> refused = SomeOf(watched.refused().all(), kAsked);
  const Met most =
      MostMet(refused, volumes, place, [](const Obstacle& obstacle) { return !obstacle.rests(); });
  const Obstacle* const blocking = most.obstacle;
  if (blocking == nullptr) return "";
  const std::string text =
      Formatted("of %zu half-steps near the goal that are not always free %d meet the way of ",
                refused.size(), most.count) +
      Quote(blocking->name);
  const auto& waypoints = blocking->motion.waypoints;
  if (blocking->motion.speed > 0.0 || waypoints.empty()) return text;
  return text + Formatted(", which rests from %.4g s on", waypoints.back().t);
}

Hindrance FindDetour(const PlanRequest& request, const PlanResult& plan,
                     const SweptVolumes& volumes, const Place& place, const MarginLimits& limits) {
  constexpr double kDetour = 1.25;
  const Eigen::Vector2d begin =
      MidFeet(request.start[0].Planar(), request.start[1].Planar()).position();
  const Eigen::Vector2d end = request.goal.X_WG.position();
  Eigen::Vector2d at = begin;
  std::array<Foothold, 2> feet = request.start;
  double way = 0.0;
  for (const Footstep& footstep : plan.footsteps) {
    feet[static_cast<size_t>(Index(footstep.side))] = footstep.X_WF;
    const Eigen::Vector2d next = MidFeet(feet[0].Planar(), feet[1].Planar()).position();
    way += (next - at).norm();
    at = next;
  }
  if (way < kDetour * (at - begin).norm()) return {};
  // Narrower than what a leg might step over, were it to step as far as it is long.
  const double narrow = LegLengthOf(place.robot);
  const Obstacle* higher = nullptr;  // than feet rise
  for (const Obstacle& obstacle : place.scene.obstacles) {
    if (!obstacle.rests()) continue;
    const Eigen::AlignedBox3d bounds = BoundsOf(obstacle.shape, obstacle.X_WO);
    if (IsTooHigh(bounds.max().z(), place.robot)) continue;
    if (bounds.sizes().head<2>().minCoeff() > narrow) continue;
    if (!LiesAcross(FootprintOf(obstacle), begin, end)) continue;
    if (bounds.max().z() >= volumes.set.prototype.via_height) {
      if (higher == nullptr) higher = &obstacle;
      continue;
    }
    const std::string over = NoHalfStepOver(obstacle, place.robot, volumes,
                                            limits.demanded_of(MarginFamily::kClearance));
    if (!over.empty()) return {over, &obstacle};
  }
  return {"", higher};
}

}  // namespace halfstep
