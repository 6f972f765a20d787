#include "experiments/run/stepping_over.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>
#include <vector>

#include "experiments/run/obstacle_footprint.h"
#include "planner/swept/swept_volume_query.h"
#include "wpg/elementary.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/geometry/convex_body.h"

namespace halfstep {
namespace {

// A half-step turned against the obstacle's narrower side.
struct TurnedElement {
  int element;
  Side support;
  double yaw;     // of the support sole against `across` [rad]
  double way;     // from sole to sole across [m]
  double before;  // from the support sole's centre to its end in front [m]
  double behind;  // from the landing sole's centre back to its end [m]
  double room() const { return way - before - behind; }  // between the soles [m]
};

std::vector<TurnedElement> TurnedHalfSteps(const RobotModel& robot, const StepSet& set) {
  constexpr int kYaws = 24;
  const auto end = [&](double yaw, double sign) {
    const Eigen::RowVectorXd x =
        Eigen::RowVector2d(Cos(yaw), -Sin(yaw)) * robot.sole_outline;  // across
    return (sign * x).maxCoeff();
  };
  std::vector<TurnedElement> all;
  for (int i = 0; i < set.size(); ++i) {
    for (const Side support : {Side::kLeft, Side::kRight}) {
      const Foothold X_SF = set.Placement(i, support);
      for (int j = 0; j < kYaws; ++j) {
        const double yaw = 2.0 * std::numbers::pi * j / kYaws;
        all.push_back({.element = i,
                       .support = support,
                       .yaw = yaw,
                       .way = Cos(yaw) * X_SF.x - Sin(yaw) * X_SF.y,
                       .before = end(yaw, 1.0),
                       .behind = end(yaw + X_SF.yaw, -1.0)});
      }
    }
  }
  return all;
}

// How far a sole at X_WF reaches in a direction, seen from above [m].
double SoleReach(const RobotModel& robot, const Foothold& X_WF, const Eigen::Vector2d& direction) {
  const Pose2 X_W = X_WF.Planar();
  return direction.dot(X_W.position()) +
         (direction.transpose() * X_W.rotation() * robot.sole_outline).maxCoeff();
}

// Half-steps over an obstacle alone in a scene: a foot comes from before it and lands beyond, first
// the one that goes ahead, then the one that follows.
class StepsOver {
 public:
  StepsOver(const Obstacle& obstacle, const ObstacleFootprint& print, const RobotModel& robot,
            const SweptVolumes& volumes, double clearance)
      : print_(print),
        robot_(robot),
        set_(volumes.set),
        clearance_(clearance),
        query_(volumes, robot.sole_outline, Alone(obstacle)) {}

  // Whether some of the half-steps lead a foot ahead, and some one after it.
  bool Any(const std::vector<TurnedElement>& half_steps) {
    constexpr int kPlaces = 5;
    const double turn = Atan2(print_.across.y(), print_.across.x());
    for (const TurnedElement& half_step : half_steps) {
      const double last = print_.near - clearance_ - half_step.before;
      const double first = print_.far + clearance_ + half_step.behind - half_step.way;
      for (int j = 0; j < kPlaces && !(leads_ && follows_); ++j) {
        const Eigen::Vector2d p_W = (first + (last - first) * j / (kPlaces - 1)) * print_.across +
                                    0.5 * (print_.left + print_.right) * print_.along;
        Look(half_step, Foothold({p_W.x(), p_W.y(), turn + half_step.yaw}, 0.0));
      }
    }
    return leads_ && follows_;
  }

 private:
  static Scene Alone(const Obstacle& obstacle) {
    Scene scene;
    scene.obstacles = {obstacle};
    return scene;
  }

  void Look(const TurnedElement& half_step, const Foothold& X_WS) {
    const int i = half_step.element;
    const Side foot = half_step.support, other = Opposite(foot);
    if (!leads_ && query_.DownIsFree(i, foot, X_WS)) {
      for (int k = 0; k < set_.size() && !leads_; ++k) {
        const Foothold X_WA = X_WS * set_.Placement(k, other).Inverse();
        leads_ = SoleReach(robot_, X_WA, print_.across) <= print_.near - clearance_ &&
                 query_.UpIsFree(k, other, X_WA);
      }
    }
    if (!follows_ && query_.UpIsFree(i, foot, X_WS)) {
      const Foothold X_WF = X_WS * set_.Placement(i, foot);
      for (int k = 0; k < set_.size() && !follows_; ++k) {
        const Foothold X_WB = X_WF * set_.Placement(k, other);
        follows_ = -SoleReach(robot_, X_WB, -print_.across) >= print_.far + clearance_ &&
                   query_.DownIsFree(k, other, X_WF);
      }
    }
  }

  const ObstacleFootprint& print_;
  const RobotModel& robot_;
  const StepSet& set_;
  double clearance_;
  SweptVolumeQuery query_;
  bool leads_ = false, follows_ = false;
};

// Why no half-step leads over anything of a depth, however low.
std::string TooShort(const std::vector<TurnedElement>& half_steps, double depth, double clearance) {
  const TurnedElement* ahead = nullptr;
  for (const TurnedElement& one : half_steps) {
    if (one.yaw == 0.0 && (ahead == nullptr || one.room() > ahead->room())) ahead = &one;
  }
  const double room = depth + 2.0 * clearance;
  const std::string deep = Formatted(" and %.3g m deep: ", depth);
  if (ahead == nullptr || ahead->room() >= room) {
    return deep + "no half-step here leads over that depth, however low";
  }
  return deep + Formatted(
                    "straight over it a half-step needs %.3g m from sole to sole, the longest here "
                    "has %.3g m, and sideways none leads over it (longer ones: step_set, "
                    "half_step.duration_s)",
                    ahead->before + ahead->behind + room, ahead->way);
}

}  // namespace

std::string NoHalfStepOver(const Obstacle& obstacle, const RobotModel& robot,
                           const SweptVolumes& volumes, double clearance) {
  const ObstacleFootprint print = FootprintOf(obstacle);
  if (!obstacle.rests() || volumes.set.on_levels || !(print.top > 0.0)) return "";
  if (print.top >= volumes.set.prototype.via_height) return "";
  std::vector<TurnedElement> half_steps = TurnedHalfSteps(robot, volumes.set);
  const std::string it = Quote(obstacle.name) + " is " + Formatted("%.3g m high", print.top);
  const std::string too_short = it + TooShort(half_steps, print.depth(), clearance);
  const double room = print.depth() + 2.0 * clearance;
  std::erase_if(half_steps, [room](const TurnedElement& one) { return one.room() < room; });
  if (half_steps.empty()) return too_short;
  if (StepsOver(obstacle, print, robot, volumes, clearance).Any(half_steps)) return "";
  // How high it might be, as a box.
  Obstacle box = obstacle;
  const Eigen::Vector2d middle =
      0.5 * ((print.near + print.far) * print.across + (print.left + print.right) * print.along);
  box.X_WO.linear().setIdentity();
  box.X_WO.linear().topLeftCorner<2, 2>() << print.across, print.along;
  double low = 0.0, high = print.top;
  while (high - low > 1e-3) {
    const double height = 0.5 * (low + high);
    box.shape = Box{{print.depth(), print.right - print.left, height}};
    box.X_WO.translation() = Eigen::Vector3d(middle.x(), middle.y(), 0.5 * height);
    (StepsOver(box, print, robot, volumes, clearance).Any(half_steps) ? low : high) = height;
  }
  if (low == 0.0) return too_short;
  return it + Formatted(
                  ": half-steps here lead over %.3g m of height at its depth of %.3g m (higher "
                  "ones: half_step.via_height_m)",
                  low, print.depth());
}

}  // namespace halfstep
