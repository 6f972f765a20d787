// Whether what the query calls free is certified: random elements of the certified set at random
// places among random boxes, cylinders, spheres and capsules.
//   soundness_study [N [SEED [ROBOT [CROUCH VIA [between]]]]]  default: 100000, seed 1, hrp2
//   soundness_study N SEED ROBOT moving
// With half_step.crouch_m and via_height_m [m] obstacles hang over the robot, too; `between`: also
// half-steps at the config's height and those in which the waist changes its height. `moving`: what
// ObstacleTimes call free at a time, half of these the ends of an interval.
// ROBOT may be NAME-unequal or NAME-offset, whose legs differ (tests/oracle/unequal_legs.h).
// Prints the figures of planner/README.md, "Swept volumes". Exit status 1: a contradiction. Swept
// volumes from the user's cache, baked when they are not there. Other robots than HRP-2 among
// obstacles that are smaller or larger as their legs are. Not a test.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/run/plan_between_heights.h"
#include "experiments/run/plan_by_volumes.h"
#include "experiments/run/planning.h"
#include "planner/swept/obstacle_times.h"
#include "planner/swept/swept_volume_query.h"
#include "tests/oracle/unequal_legs.h"
#include "tests/places.h"
#include "tests/planner/swept_volume_draws.h"
#include "tests/temporary_folder.h"
#include "tests/wpg/shipped_robots.h"

namespace {

using namespace halfstep;

constexpr double kReach = 3.0;       // half the edge of the room [m]
constexpr double kDisplaced = 0.05;  // of the control [m]
constexpr int kHalfStepsInAScene = 200;

Shape DrawShape(int kind, double size, SweptDraw* draw) {
  const double radius = size * draw->Uniform(0.02, 0.2), length = size * draw->Uniform(0.05, 1.0);
  switch (kind) {
    case 0:
      return Box{size * draw->Point({0.05, 0.05, 0.05}, {0.4, 0.4, 1.0})};
    case 1:
      return Cylinder{radius, length};
    case 2:
      return Sphere{radius};
    default:
      return Capsule{radius, length};
  }
}

// As many of each shape; every second one upright on the floor (a ball half sunk), the others
// tilted, up to `high` [m] above it; all lengths times `size`.
Scene DrawMixed(int count, double size, double high, SweptDraw* draw) {
  Scene scene;
  for (int i = 0; i < count; ++i) {
    const bool upright = draw->Index(2) == 0;
    Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
    X_WO.linear() = draw->Turn(upright);
    X_WO.translation() =
        size * draw->Point({-kReach, -kReach, 0}, {kReach, kReach, upright ? 0.3 : high});
    scene.obstacles.push_back(
        {"obstacle " + std::to_string(i), DrawShape(i % 4, size, draw), X_WO});
  }
  return scene;
}

// A set of two heights of the waist, as planning makes it.
BakedHalfSteps BakedBetween(const RobotModel& robot, const ExperimentConfig& config,
                            const StepSet::Form& lower) {
  PlannedWalk walk;
  walk.config = config;
  PlanBetweenHeights({robot, Scene{}}, lower, {}, &walk);
  return std::move(walk.half_steps);
}

// A few obstacles of DrawMixed, on their ways to two other places.
Scene DrawMoving(double size, SweptDraw* draw) {
  Scene scene = DrawMixed(12, size, 0.8, draw);
  for (Obstacle& obstacle : scene.obstacles) {
    double t = 0.0;
    for (int k = 0; k < 2; ++k) {
      t += draw->Uniform(1.0, 10.0);
      Eigen::Vector3d to = obstacle.X_WO.translation();
      to.head<2>() = size * draw->Point({-kReach, -kReach, 0}, {kReach, kReach, 0}).head<2>();
      obstacle.motion.waypoints.push_back({t, to, draw->Uniform(-1.0, 1.0)});
    }
  }
  return scene;
}

// The scene as it is from a time on; before 0 everything rests.
Scene From(double t, Scene scene) {
  for (Obstacle& obstacle : scene.obstacles) {
    std::vector<ObstacleMotion::Waypoint>& waypoints = obstacle.motion.waypoints;
    if (t < 0.0) waypoints.insert(waypoints.begin(), {0.0, obstacle.X_WO.translation(), 0.0});
    double yaw = 0.0, since = 0.0;
    for (const ObstacleMotion::Waypoint& waypoint : waypoints) {
      const double share = std::clamp((t - since) / (waypoint.t - since), 0.0, 1.0);
      yaw += share * (waypoint.yaw - yaw);
      since = waypoint.t;
      if (share < 1.0) break;
    }
    obstacle.X_WO = obstacle.PoseAt(t);
    std::erase_if(waypoints, [t](const auto& waypoint) { return waypoint.t <= t; });
    for (ObstacleMotion::Waypoint& waypoint : waypoints) waypoint.t -= t, waypoint.yaw -= yaw;
  }
  return scene;
}

// The mode `moving`.
int StudyMoving(long wanted, const RobotModel& robot, const ExperimentConfig& config,
                SweptDraw* draw) {
  const BakedHalfSteps baked = BakeHalfSteps(robot, config, {});
  const SweptVolumes& volumes = *baked.cached.volumes;
  const double size = LegScale(robot);
  long asked = 0, free = 0, wrong = 0, controls = 0, refuted = 0;
  while (asked < wanted) {
    const Scene scene = DrawMoving(size, draw);
    const SweptVolumeQuery always(volumes, robot.sole_outline, scene);
    const ObstacleTimes times(robot, MotionModelOf(robot, volumes.set.prototype.shape), volumes.set,
                              scene, ClearanceOf(config, robot), &always);
    for (int k = 0; k < kHalfStepsInAScene && asked < wanted; ++k, ++asked) {
      const int i = draw->Index(volumes.set.size());
      const bool down = draw->Index(2) == 0;
      const Side side = draw->AnySide();
      const Foothold X_WS = Foothold::Level(draw->Floor(size * kReach));
      const Foothold X_WF = X_WS * volumes.set.Placement(i, side);
      double t = draw->Uniform(0.0, times.settled() + 1.0);
      const TimeInterval within{std::max(0.0, t - 1.0), t + 1.0};
      const TimeIntervals starts = down ? times.DownStarts(i, side, X_WS, X_WF, within)
                                        : times.UpStarts(i, side, X_WS, X_WF, within);
      if (starts.empty()) continue;
      const TimeInterval& interval =
          starts[static_cast<size_t>(draw->Index(static_cast<int>(starts.size())))];
      if (draw->Index(2) == 0) t = std::isfinite(interval.end) ? interval.end : interval.begin;
      const bool always_free = starts.front().begin == 0.0 && !std::isfinite(starts.front().end);
      if (always_free || IntervalAt(starts, t) == nullptr) continue;
      ++free;
      const HalfStep half_step = down ? volumes.set.Down(i, side) : volumes.set.Up(i, side);
      // The certifier's down half-step begins when the one up to it has ended.
      const double before = down ? half_step.duration : 0.0;
      const auto certified = [&](double at) {
        return HalfStepCertifier(robot, From(at - before, scene), config)
            .Certifies(half_step, down ? X_WS : X_WF);
      };
      if (!certified(t)) {
        ++wrong;
        std::printf("contradiction: element %d, %s, %s, x %.17g y %.17g yaw %.17g t %.17g\n", i,
                    down ? "down" : "up", std::string(Name(side)).c_str(), X_WS.x, X_WS.y, X_WS.yaw,
                    t);
      }
      if (free % 20 != 0) continue;
      ++controls;
      refuted += !certified(t + 1.0);
    }
  }
  std::printf(
      "%s: %ld half-steps of %d elements, 12 obstacles that move: %ld called free at a time "
      "that matters, %ld of them not certified; control: of %ld one second later %ld not\n",
      robot.name.c_str(), asked, volumes.set.size(), free, wrong, controls, refuted);
  return wrong == 0 ? 0 : 1;
}

struct Counts {
  long asked = 0, free = 0, certified_free = 0;
  long refused = 0, certified_refused = 0;
  long controls = 0, refuted_controls = 0;
};

}  // namespace

int main(int argc, char** argv) {
  const long wanted = argc > 1 ? std::atol(argv[1]) : 100000;
  SweptDraw draw(argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1);
  const std::string name = argc > 3 ? argv[3] : "hrp2";
  const TemporaryFolder folder;
  const std::string path = oracle::StudiedRobot(name, folder.path().string());
  const RobotModel robot = LoadRobot(path);
  const double size = LegScale(robot);
  std::vector<YamlOverride> overrides = {{"robot", path}};
  const bool between = argc > 6;
  if (argc > 5 && !between) {
    overrides.push_back({"half_step.crouch_m", argv[4]});
    overrides.push_back({"half_step.via_height_m", argv[5]});
  }
  const double high = argc > 5 ? 2.0 : 0.8;
  const ExperimentConfig config =
      LoadConfig(InSources("experiments/configs/island.yaml"), overrides);
  if (argc == 5) return StudyMoving(wanted, robot, config, &draw);
  const BakedHalfSteps baked =
      between ? BakedBetween(robot, config, {std::atof(argv[4]), std::atof(argv[5])})
              : BakeHalfSteps(robot, config, {});
  const SweptVolumes& volumes = *baked.cached.volumes;
  Counts n;
  while (n.asked < wanted) {
    const Scene scene = DrawMixed(50, size, high, &draw);
    const SweptVolumeQuery query(volumes, robot.sole_outline, scene);
    const HalfStepCertifier certifier(robot, scene, config);
    for (int k = 0; k < kHalfStepsInAScene && n.asked < wanted; ++k) {
      const int i = draw.Index(volumes.set.size());
      const bool down = draw.Index(2) == 0;
      const Side side = draw.AnySide();  // of the foot on which the element lands the other
      const Foothold X_WS = Foothold::Level(draw.Floor(size * kReach));
      const auto free_at = [&](const Foothold& at) {
        return down ? query.DownIsFree(i, side, at) : query.UpIsFree(i, side, at);
      };
      const HalfStep half_step = down ? volumes.set.Down(i, side) : volumes.set.Up(i, side);
      const Foothold X_WSupport = down ? X_WS : X_WS * volumes.set.Placement(i, side);
      ++n.asked;
      if (free_at(X_WS)) {
        ++n.free;
        if (certifier.Certifies(half_step, X_WSupport)) {
          ++n.certified_free;
        } else {
          std::printf("contradiction: element %d, %s, %s, x %.17g y %.17g yaw %.17g\n", i,
                      down ? "down" : "up", std::string(Name(side)).c_str(), X_WS.x, X_WS.y,
                      X_WS.yaw);
        }
      } else if (n.asked % 10 == 0) {
        ++n.refused;
        n.certified_refused += certifier.Certifies(half_step, X_WSupport);
      }
      // A control: the same asked beside the place must be wrong now and then.
      if (n.asked % 20 == 0 &&
          free_at({{X_WS.x + size * kDisplaced, X_WS.y, X_WS.yaw}, X_WS.height})) {
        ++n.controls;
        n.refuted_controls += !certifier.Certifies(half_step, X_WSupport);
      }
    }
  }
  const double free_share = static_cast<double>(n.free) / static_cast<double>(n.asked);
  const double refused_free = (1.0 - free_share) * static_cast<double>(n.certified_refused) /
                              static_cast<double>(std::max(n.refused, 1L));
  std::printf(
      "%s: %ld half-steps of %d elements, 50 obstacles: %ld called free, %ld of them not "
      "certified\n",
      name.c_str(), n.asked, volumes.set.size(), n.free, n.free - n.certified_free);
  std::printf("of %ld refused ones looked at, %ld are certified: %.2f %% of what is free\n",
              n.refused, n.certified_refused, 100.0 * refused_free / (free_share + refused_free));
  std::printf("control: of %ld called free %.0f mm beside, %ld not certified\n", n.controls,
              1e3 * size * kDisplaced, n.refuted_controls);
  return n.free == n.certified_free ? 0 : 1;
}
