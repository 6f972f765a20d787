#include "experiments/run/obstacle_crossings.h"

#include <numbers>
#include <random>

#include "experiments/run/ground_steps.h"
#include "experiments/run/obstacle_footprint.h"
#include "planner/search/plan_shortcut.h"
#include "wpg/elementary.h"
#include "wpg/nth.h"

namespace halfstep {

std::vector<Crossing> DrawObstacleCrossings(const ExperimentConfig& config, const RobotModel& robot,
                                            const Obstacle& obstacle) {
  constexpr int kWanted = 96, kTries = 20000, kYaws = 24;
  const ObstacleFootprint print = FootprintOf(obstacle);
  const double clearance = config.smoothing.limits.demanded_of(MarginFamily::kClearance);
  const double turn = Atan2(print.across.y(), print.across.x());
  const std::vector<Foothold> landings = PlacesOf(config.step_set);
  // How far a sole turned by `yaw` against `across` reaches beyond its centre, ahead or back.
  const auto reach = [&](double yaw, double sign) {
    const Eigen::RowVectorXd x = Eigen::RowVector2d(Cos(yaw), -Sin(yaw)) * robot.sole_outline;
    return (sign * x).maxCoeff();
  };
  std::vector<Crossing> crossings;
  std::mt19937_64 random(static_cast<std::uint64_t>(config.seed));
  for (int k = 0; k < kTries && std::ssize(crossings) < kWanted; ++k) {
    const Side support = Pick(2, random) == 0 ? Side::kLeft : Side::kRight;
    const double yaw = 2.0 * std::numbers::pi * Pick(kYaws, random) / kYaws;
    const Foothold& left = Nth(landings, Pick(static_cast<int>(landings.size()), random));
    const double share = Uniform(0.0, 1.0, random);
    const Foothold X_SF = support == Side::kLeft ? left : left.Mirrored();
    const double way = Cos(yaw) * X_SF.x - Sin(yaw) * X_SF.y;
    // Of the support sole's centre on `across`, so that both soles are off the obstacle.
    const double last = print.near - clearance - reach(yaw, 1.0);
    const double first = print.far + clearance + reach(yaw + X_SF.yaw, -1.0) - way;
    if (first > last) continue;
    const Eigen::Vector2d p_W = (first + share * (last - first)) * print.across +
                                0.5 * (print.left + print.right) * print.along;
    const Foothold X_WS({p_W.x(), p_W.y(), turn + yaw}, 0.0);
    crossings.push_back({support, X_WS, X_WS * X_SF});
  }
  return crossings;
}

}  // namespace halfstep
