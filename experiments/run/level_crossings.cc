#include "experiments/run/level_crossings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>

#include "experiments/run/ground_steps.h"
#include "experiments/run/sole_heights.h"
#include "planner/search/plan_shortcut.h"
#include "wpg/elementary.h"
#include "wpg/nth.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep {
namespace {

constexpr double kKind = 0.03;     // [m] differences of height that count as one
constexpr double kMostRise = 0.4;  // of the leg: no humanoid's step is higher

using Edge = std::pair<Eigen::Vector2d, Eigen::Vector2d>;

std::vector<Edge> EdgesIn(const Eigen::AlignedBox2d& area, const Ground& ground) {
  std::vector<Edge> edges;
  for (const GroundSolid& solid : ground.Solids()) {
    for (Eigen::Index i = 0; solid.bears && i < solid.polygon.cols(); ++i) {
      const Eigen::Vector2d a = solid.polygon.col(i),
                            b = solid.polygon.col((i + 1) % solid.polygon.cols());
      if (area.intersects(Eigen::AlignedBox2d(a.cwiseMin(b), a.cwiseMax(b)))) {
        edges.emplace_back(a, b);
      }
    }
  }
  return edges;
}

}  // namespace

Eigen::AlignedBox2d AreaOf(const ExperimentConfig& config, const Place& place, double room) {
  if (const auto& w = config.planner.workspace; !w.empty()) {
    return {Eigen::Vector2d(w[0], w[1]), Eigen::Vector2d(w[2], w[3])};
  }
  Eigen::AlignedBox2d box(config.goal.X_WG.position());
  for (const Foothold& sole : StartOf(config, place.robot, *place.scene.ground)) {
    box.extend(sole.Planar().position());
  }
  const Eigen::Vector2d around = Eigen::Vector2d::Constant(room);
  return {box.min() - around, box.max() + around};
}

std::vector<Crossing> DrawLevelCrossings(const ExperimentConfig& config, const Place& place) {
  constexpr int kWanted = 96, kTries = 4000, kLandings = 24;
  constexpr double kAny = std::numeric_limits<double>::infinity();
  const double leg = LegLengthOf(place.robot), farthest = 0.5 * leg;
  const SoleHeights heights(place.robot, place.scene,
                            config.smoothing.limits.demanded_of(MarginFamily::kFoothold));
  const std::vector<Foothold> landings = PlacesOf(config.step_set);
  const Eigen::AlignedBox2d area = AreaOf(config, place);
  const std::vector<Edge> edges = EdgesIn(area, *place.scene.ground);
  std::vector<Crossing> crossings;
  if (edges.empty() || landings.empty()) return crossings;
  std::mt19937_64 random(static_cast<std::uint64_t>(config.seed));
  // Across the edges; when none is found so, along them.
  for (const double turned : {0.0, 0.5 * std::numbers::pi}) {
    for (int k = 0; k < kTries && std::ssize(crossings) < kWanted; ++k) {
      const auto& [a, b] = Nth(edges, Pick(static_cast<int>(edges.size()), random));
      const Eigen::Vector2d normal = Eigen::Vector2d(b.y() - a.y(), a.x() - b.x()).normalized();
      const Eigen::Vector2d at =
          a + Uniform(0.0, 1.0, random) * (b - a) + Uniform(-farthest, farthest, random) * normal;
      const double yaw =
          Atan2(normal.y(), normal.x()) + (Pick(2, random) == 0 ? 0.0 : std::numbers::pi);
      const Side support = Pick(2, random) == 0 ? Side::kLeft : Side::kRight;
      const Pose2 X_WS{at.x(), at.y(), yaw + turned};
      const double height = heights.At(X_WS, 0.0, kAny);
      if (std::isnan(height) || !area.contains(at)) continue;
      for (int n = 0; n < kLandings; ++n) {
        const Foothold& X_SF = Nth(landings, Pick(static_cast<int>(landings.size()), random));
        const Pose2 X_WF = X_WS * (support == Side::kLeft ? X_SF : X_SF.Mirrored()).Planar();
        const double landing = heights.At(X_WF, height, kMostRise * leg);
        if (std::isnan(landing) || landing == height) continue;
        const int kind = static_cast<int>(std::lround((landing - height) / kKind));
        crossings.push_back({support, {X_WS, height}, {X_WF, landing}, kind});
        break;
      }
    }
    if (!crossings.empty()) break;
  }
  return crossings;
}

}  // namespace halfstep
