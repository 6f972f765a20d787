// Whether what the query calls free is certified: random elements of the certified set at random
// places among random boxes, cylinders, spheres and capsules.
//   soundness_study [N [SEED [ROBOT [CROUCH VIA]]]]     default: 100000 half-steps, seed 1, hrp2
// With half_step.crouch_m and via_height_m [m] obstacles hang over the robot, too.
// ROBOT may be NAME-unequal or NAME-offset, whose legs differ (tests/oracle/unequal_legs.h).
// Prints the figures of planner/README.md, "Swept volumes". Exit status 1: a contradiction. Swept
// volumes from the user's cache, baked when they are not there. Other robots than HRP-2 among
// obstacles that are smaller or larger as their legs are. Not a test.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/run/planning.h"
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
  if (argc > 5) overrides.push_back({"half_step.crouch_m", argv[4]});
  if (argc > 5) overrides.push_back({"half_step.via_height_m", argv[5]});
  const double high = argc > 5 ? 2.0 : 0.8;
  const ExperimentConfig config =
      LoadConfig(InSources("experiments/configs/island.yaml"), overrides);
  const BakedHalfSteps baked = BakeHalfSteps(robot, config, {});
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
