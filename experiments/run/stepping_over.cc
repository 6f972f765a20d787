#include "experiments/run/stepping_over.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>
#include <vector>

#include "planner/swept/swept_volume_query.h"
#include "wpg/elementary.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/geometry/convex_body.h"

namespace halfstep {
namespace {

// How far an obstacle reaches in a direction of W [m].
double Reach(const Obstacle& obstacle, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d d_O = obstacle.X_WO.linear().transpose() * direction;
  const double at = obstacle.X_WO.translation().dot(direction);
  return at + std::visit(
                  [&](const auto& shape) {
                    if constexpr (std::is_same_v<std::decay_t<decltype(shape)>, TriangleMesh>) {
                      return (d_O.transpose() * shape.vertices).maxCoeff();
                    } else {
                      return Support(BodyOf(shape), d_O);
                    }
                  },
                  obstacle.shape);
}

// The rectangle around an obstacle seen from above whose first edge is shortest.
struct Footprint {
  Eigen::Vector2d across, along;                          // unit vectors: over its narrower side
  double near = 0.0, far = 0.0, left = 0.0, right = 0.0;  // its bounds on these [m]
  double top = 0.0;                                       // [m]
  double depth() const { return far - near; }
};

Footprint FootprintOf(const Obstacle& obstacle) {
  constexpr int kDirections = 72;  // of half a turn
  Footprint best;
  double least = std::numeric_limits<double>::infinity();
  for (int j = 0; j < kDirections; ++j) {
    const double angle = std::numbers::pi * j / kDirections;
    const Eigen::Vector2d across(Cos(angle), Sin(angle)), along(-across.y(), across.x());
    const auto reach = [&](const Eigen::Vector2d& d) {
      return Reach(obstacle, {d.x(), d.y(), 0.0});
    };
    const Footprint here{across,       along, -reach(-across), reach(across), -reach(-along),
                         reach(along), 0.0};
    if (here.depth() < least - 1e-9) {
      least = here.depth();
      best = here;
    }
  }
  best.top = Reach(obstacle, Eigen::Vector3d::UnitZ());
  return best;
}

// A half-step turned against the obstacle's narrower side.
struct Turned {
  int element;
  Side support;
  double yaw;     // of the support sole against `across` [rad]
  double way;     // from sole to sole across [m]
  double before;  // from the support sole's centre to its end in front [m]
  double behind;  // from the landing sole's centre back to its end [m]
  double room() const { return way - before - behind; }  // between the soles [m]
};

std::vector<Turned> TurnedHalfSteps(const RobotModel& robot, const StepSet& set) {
  constexpr int kYaws = 24;
  const auto end = [&](double yaw, double sign) {
    const Eigen::RowVectorXd x =
        Eigen::RowVector2d(Cos(yaw), -Sin(yaw)) * robot.sole_outline;  // across
    return (sign * x).maxCoeff();
  };
  std::vector<Turned> all;
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

// Whether one of them is free over the obstacle alone.
bool SomeStepsOver(const Obstacle& obstacle, const Footprint& print, const RobotModel& robot,
                   const SweptVolumes& volumes, const std::vector<Turned>& half_steps,
                   double clearance) {
  Scene scene;
  scene.obstacles = {obstacle};
  const SweptVolumeQuery query(volumes, robot.sole_outline, scene);
  constexpr int kPlaces = 5;
  const double turn = Atan2(print.across.y(), print.across.x());
  for (const Turned& half_step : half_steps) {
    const double last = print.near - clearance - half_step.before;
    const double first = print.far + clearance + half_step.behind - half_step.way;
    for (int j = 0; j < kPlaces; ++j) {
      const Eigen::Vector2d p_W = (first + (last - first) * j / (kPlaces - 1)) * print.across +
                                  0.5 * (print.left + print.right) * print.along;
      const Foothold X_WS({p_W.x(), p_W.y(), turn + half_step.yaw}, 0.0);
      if (query.DownIsFree(half_step.element, half_step.support, X_WS) &&
          query.UpIsFree(half_step.element, half_step.support, X_WS)) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

std::string NoHalfStepOver(const Obstacle& obstacle, const RobotModel& robot,
                           const SweptVolumes& volumes, double clearance) {
  const Footprint print = FootprintOf(obstacle);
  if (!obstacle.rests() || volumes.set.on_levels || !(print.top > 0.0)) return "";
  if (print.top >= volumes.set.prototype.via_height) return "";
  const double room = print.depth() + 2.0 * clearance;
  std::vector<Turned> half_steps = TurnedHalfSteps(robot, volumes.set);
  const auto widest = std::ranges::max_element(half_steps, {}, &Turned::room);
  const std::string it = Quote(obstacle.name) + " is " + Formatted("%.3g m high", print.top);
  if (widest->room() < room) {
    return it + Formatted(
                    " and %.3g m deep: over it a half-step needs %.3g m from sole to sole, the "
                    "longest here that way has %.3g m (longer ones: step_set, "
                    "half_step.duration_s)",
                    print.depth(), widest->before + widest->behind + room, widest->way);
  }
  std::erase_if(half_steps, [room](const Turned& one) { return one.room() < room; });
  if (SomeStepsOver(obstacle, print, robot, volumes, half_steps, clearance)) return "";
  // How high it might be, as a box.
  Obstacle box = obstacle;
  const Eigen::Vector2d middle =
      0.5 * ((print.near + print.far) * print.across + (print.left + print.right) * print.along);
  box.X_WO.linear() =
      Eigen::AngleAxisd(Atan2(print.across.y(), print.across.x()), Eigen::Vector3d::UnitZ())
          .toRotationMatrix();
  double low = 0.0, high = print.top;
  while (high - low > 1e-3) {
    const double height = 0.5 * (low + high);
    box.shape = Box{{print.depth(), print.right - print.left, height}};
    box.X_WO.translation() = Eigen::Vector3d(middle.x(), middle.y(), 0.5 * height);
    (SomeStepsOver(box, print, robot, volumes, half_steps, clearance) ? low : high) = height;
  }
  return it + Formatted(
                  ": of its depth of %.3g m half-steps here lead over %.3g m (higher ones: "
                  "half_step.via_height_m)",
                  print.depth(), low);
}

bool LiesAcross(const Obstacle& obstacle, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Footprint print = FootprintOf(obstacle);
  constexpr int kPoints = 200;
  for (int j = 0; j <= kPoints; ++j) {
    const Eigen::Vector2d p_W = from + (to - from) * j / kPoints;
    const double x = p_W.dot(print.across), y = p_W.dot(print.along);
    if (x >= print.near - 0.01 && x <= print.far + 0.01 && y >= print.left && y <= print.right) {
      return true;
    }
  }
  return false;
}

}  // namespace halfstep
