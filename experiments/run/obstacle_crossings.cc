#include "experiments/run/obstacle_crossings.h"

#include <numbers>
#include <optional>
#include <random>
#include <utility>

#include "experiments/run/obstacle_footprint.h"
#include "planner/search/plan_shortcut.h"
#include "wpg/elementary.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

class Astride {
 public:
  Astride(const ExperimentConfig& config, const RobotModel& robot, const Obstacle& obstacle,
          std::vector<Foothold> places)
      : robot_(robot),
        print_(FootprintOf(obstacle)),
        clearance_(config.smoothing.limits.demanded_of(MarginFamily::kClearance)),
        turn_(Atan2(print_.across.y(), print_.across.x())),
        landings_(std::move(places)) {}

  // A stance over it, if the drawn one leads over it.
  std::optional<Crossing> Draw(std::mt19937_64& random) const {
    constexpr int kYaws = 24;
    if (landings_.empty()) return std::nullopt;
    const Side support = Pick(2, random) == 0 ? Side::kLeft : Side::kRight;
    const double yaw = 2.0 * std::numbers::pi * Pick(kYaws, random) / kYaws;
    const Foothold X_SF = Landing(support, random);
    const double share = Uniform(0.0, 1.0, random);
    // Of the support sole's centre on `across`, so that both soles are off the obstacle.
    const double way = Cos(yaw) * X_SF.x - Sin(yaw) * X_SF.y;
    const double last = print_.near - clearance_ - Reach(yaw, 1.0);
    const double first = print_.far + clearance_ + Reach(yaw + X_SF.yaw, -1.0) - way;
    if (first > last) return std::nullopt;
    const Eigen::Vector2d p_W = (first + share * (last - first)) * print_.across +
                                0.5 * (print_.left + print_.right) * print_.along;
    const Foothold X_WS({p_W.x(), p_W.y(), turn_ + yaw}, 0.0), X_WF = X_WS * X_SF;
    // Where the foot that lands comes from, and where the other one goes.
    const Side other = Opposite(support);
    bool comes = false, goes = false;
    for (int n = 0; n < kTries && !(comes && goes); ++n) {
      comes = comes || IsBefore(X_WS * Landing(other, random).Inverse());
      goes = goes || IsBehind(X_WF * Landing(other, random));
    }
    if (!comes || !goes) return std::nullopt;
    return Crossing{support, X_WS, X_WF};
  }

 private:
  static constexpr int kTries = 24;

  Foothold Landing(Side support, std::mt19937_64& random) const {
    const Foothold& left = Nth(landings_, Pick(static_cast<int>(landings_.size()), random));
    return support == Side::kLeft ? left : left.Mirrored();
  }
  // How far a sole turned by `yaw` against `across` reaches beyond its centre, ahead or back.
  double Reach(double yaw, double sign) const {
    const Eigen::RowVectorXd x = Eigen::RowVector2d(Cos(yaw), -Sin(yaw)) * robot_.sole_outline;
    return (sign * x).maxCoeff();
  }
  bool IsBefore(const Foothold& X_WF) const {
    const double x = print_.across.dot(X_WF.Planar().position());
    return x + Reach(X_WF.yaw - turn_, 1.0) <= print_.near - clearance_;
  }
  bool IsBehind(const Foothold& X_WF) const {
    const double x = print_.across.dot(X_WF.Planar().position());
    return x - Reach(X_WF.yaw - turn_, -1.0) >= print_.far + clearance_;
  }

  const RobotModel& robot_;
  ObstacleFootprint print_;
  double clearance_, turn_;
  std::vector<Foothold> landings_;  // seen from a left support
};

}  // namespace

std::vector<Crossing> DrawObstacleCrossings(const ExperimentConfig& config, const RobotModel& robot,
                                            const Obstacle& obstacle,
                                            std::vector<Foothold> places) {
  constexpr int kWanted = 96, kTries = 20000;
  const Astride astride(config, robot, obstacle, std::move(places));
  std::vector<Crossing> crossings;
  std::mt19937_64 random(static_cast<std::uint64_t>(config.seed));
  for (int k = 0; k < kTries && std::ssize(crossings) < kWanted; ++k) {
    if (const auto crossing = astride.Draw(random)) crossings.push_back(*crossing);
  }
  return crossings;
}

}  // namespace halfstep
