#include "experiments/report/nearest_pairs.h"

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "experiments/report/trajectory_states.h"
#include "experiments/tables/margin_columns.h"
#include "smoothing/margins/body_clearances.h"
#include "wpg/files/number_text.h"
#include "wpg/motion/posture.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using nlohmann::json;

struct NearPair {
  double margin = MarginLimits{}.clearance_cap;  // [m]
  std::array<std::string, 2> names;
  Separation separation;
};

json PointJson(const Eigen::Vector3d& p) {
  return {Shortened(p.x(), 6), Shortened(p.y(), 6), Shortened(p.z(), 6)};
}

json PairJson(MarginFamily family, double t, const NearPair& pair) {
  return {{"family", Name(family)},
          {"t_s", Shortened(t, 8)},
          {"margin_m", Shortened(pair.margin, 6)},
          {"between", pair.names},
          {"points", {PointJson(pair.separation.point_a_W), PointJson(pair.separation.point_b_W)}}};
}

// The row with the least value, if one has a number.
std::optional<size_t> LeastRow(const std::vector<double>& values) {
  std::optional<size_t> least;
  for (size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i]) && (!least || values[i] < values[*least])) least = i;
  }
  return least;
}

class PairSearch {
 public:
  PairSearch(const RobotModel& robot, const Scene& scene)
      : robot_(robot),
        scene_(scene),
        clearances_(robot, scene),
        scratch_(clearances_.MakeScratch()) {}

  std::optional<NearPair> ToScene(const Posture& posture, double t) {
    std::optional<NearPair> found;
    NearPair best;
    for (size_t body = 0; body < clearances_.num_bodies(); ++body) {
      const auto nearest = clearances_.NearestTo(body, posture, t, best.margin, &scratch_);
      if (nearest.obstacle < 0 || nearest.margin >= best.margin) continue;
      best = {nearest.margin,
              {robot_.bodies[body].name, scene_.NameOf(nearest.obstacle)},
              nearest.separation};
      found = best;
    }
    return found;
  }

  std::optional<NearPair> ToItself(const Posture& posture) {
    std::optional<NearPair> found;
    NearPair best;
    for (size_t pair = 0; pair < clearances_.num_pairs(); ++pair) {
      const Separation separation = clearances_.SeparationOf(pair, posture, &scratch_);
      if (separation.distance >= best.margin) continue;
      const auto [a, b] = robot_.self_pairs[pair];
      best = {separation.distance,
              {Nth(robot_.bodies, a).name, Nth(robot_.bodies, b).name},
              separation};
      found = best;
    }
    return found;
  }

 private:
  const RobotModel& robot_;
  const Scene& scene_;
  BodyClearances clearances_;
  BodyClearances::Scratch scratch_;
};

}  // namespace

json NearestPairsJson(const RobotModel& robot, const Scene& scene, const CsvTable& trajectory) {
  const std::vector<double> t = trajectory.Numbers("t_s");
  const std::vector<WalkState> states = StatesOf(robot, trajectory);
  PairSearch search(robot, scene);
  json pairs = json::array();
  for (const MarginFamily family : {MarginFamily::kClearance, MarginFamily::kSelfClearance}) {
    const std::optional<size_t> row = LeastRow(trajectory.Numbers(*TrajectoryColumnOf(family)));
    if (!row) continue;
    const Posture posture = SolvePosture(robot, states[*row]);
    if (!posture.reachable) continue;
    const std::optional<NearPair> pair = family == MarginFamily::kClearance
                                             ? search.ToScene(posture, t[*row])
                                             : search.ToItself(posture);
    if (pair) pairs.push_back(PairJson(family, t[*row], *pair));
  }
  return pairs;
}

}  // namespace halfstep
