// Whether what the query calls free over levels is certified: random elements of the certified set
// at random places among random blocks, from level to level.
//   level_soundness_study [N [SEED [ROBOT]]]     default: 50000 half-steps, seed 1, hrp2
// Prints the figures of planner/README.md, "On levels". Exit status 1: a contradiction. Blocks of
// 5, 10 and 15 cm for HRP-2, of other robots' size for these. A coarse set without turned steps, so
// that baking it takes little; baked where the user's cache does not have it. Not a test.

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "experiments/config/experiment.h"
#include "experiments/run/planning.h"
#include "planner/ground/level_ground.h"
#include "planner/swept/swept_volume_query.h"
#include "tests/places.h"
#include "tests/planner/swept_volume_draws.h"
#include "tests/wpg/shipped_robots.h"
#include "wpg/files/number_text.h"

namespace {

using namespace halfstep;

constexpr double kReach = 2.0;       // half the edge of the field [m]
constexpr double kDisplaced = 0.05;  // of the control [m]
constexpr int kHalfStepsInAScene = 200;

LevelSurface Block(const std::string& name, double rise, int level, double size, SweptDraw* draw) {
  const Pose2 at{size * draw->Uniform(-kReach, kReach), size * draw->Uniform(-kReach, kReach),
                 draw->Uniform(-3.2, 3.2)};
  const double a = size * draw->Uniform(0.15, 0.7), b = size * draw->Uniform(0.15, 0.7);
  LevelSurface block{.name = name, .polygon = Eigen::Matrix2Xd(2, 4), .height = level * rise};
  block.polygon << a, -a, -a, a, b, b, -b, -b;
  block.polygon = (Eigen::Rotation2Dd(at.yaw).toRotationMatrix() * block.polygon).colwise() +
                  Eigen::Vector2d(at.x, at.y);
  // Some are slabs over the floor.
  if (draw->Index(4) == 0) block.bottom = block.height * draw->Uniform(0.2, 0.9);
  return block;
}

Scene DrawBlocks(double rise, double size, SweptDraw* draw) {
  std::vector<LevelSurface> blocks;
  for (int k = 0; k < 18; ++k) {
    blocks.push_back(Block("block " + std::to_string(k), rise, 1 + k % 3, size, draw));
  }
  Scene scene;
  for (int k = 0; k < 8; ++k) {
    Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
    X_WO.linear() = draw->Turn(draw->Index(2) == 0);
    X_WO.translation() = size * draw->Point({-kReach, -kReach, 0}, {kReach, kReach, 0.9});
    scene.obstacles.push_back({"obstacle " + std::to_string(k),
                               Box{size * draw->Point({0.02, 0.02, 0.02}, {0.2, 0.2, 0.4})}, X_WO});
  }
  scene.ground = std::make_shared<const LevelGround>(blocks, true);
  return scene;
}

// A place of a foot on a level, near a border of one as often as not.
std::optional<Foothold> DrawFoothold(const Scene& scene, const RobotModel& robot, double size,
                                     SweptDraw* draw) {
  Pose2 at{size * draw->Uniform(-kReach, kReach), size * draw->Uniform(-kReach, kReach),
           draw->Uniform(-3.2, 3.2)};
  const auto& solids = scene.ground->Solids();
  const Eigen::Matrix2Xd& polygon =
      solids[static_cast<size_t>(draw->Index(static_cast<int>(solids.size())))].polygon;
  if (draw->Index(4) > 0) {
    const double s = draw->Uniform(0, 1);
    const Eigen::Index k = draw->Index(static_cast<int>(polygon.cols()));
    const Eigen::Vector2d p = (1 - s) * polygon.col(k) + s * polygon.col((k + 1) % polygon.cols());
    const double way = draw->Uniform(-3.2, 3.2), off = size * draw->Uniform(0.05, 0.3);
    at.x = p.x() + off * std::cos(way);
    at.y = p.y() + off * std::sin(way);
    // Towards the edge or along it.
    const Eigen::Vector2d edge = polygon.col((k + 1) % polygon.cols()) - polygon.col(k);
    at.yaw = std::atan2(edge.y(), edge.x()) + draw->Index(4) * 0.5 * std::numbers::pi +
             draw->Uniform(-0.3, 0.3);
  }
  const auto level = scene.ground->LevelUnder(robot.sole_outline, at, 1e9);
  if (!level) return std::nullopt;
  return Foothold(at, level->height);
}

struct Counts {
  long asked = 0, free = 0, not_certified = 0;
  long refused = 0, certified_refused = 0;
  long controls = 0, refuted_controls = 0;
  std::map<long, std::array<long, 2>> by_rise;  // [mm]: asked, free
};

}  // namespace

int main(int argc, char** argv) {
  const long wanted = argc > 1 ? std::atol(argv[1]) : 50000;
  SweptDraw draw(argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1);
  const std::string name = argc > 3 ? argv[3] : "hrp2";
  const RobotModel robot = ShippedRobot(name);
  const double size = LegScale(robot), rise = std::round(50 * size) * 1e-3;
  const auto scaled = [&](double length) { return ShortestText(length * size); };
  const ExperimentConfig config = LoadConfig(InSources("experiments/configs/island.yaml"),
                                             {{"robot", name},
                                              {"half_step.via_height_m", scaled(0.22)},
                                              {"half_step.foot_delay", "0.16"},
                                              {"half_step.duration_s", "2.4"},
                                              {"half_step.crouch_m", scaled(0.01)},
                                              {"step_set.spacing_m", scaled(0.09)},
                                              {"step_set.yaws_rad", "[0]"}});
  const Scene first = DrawBlocks(rise, size, &draw);
  const BakedHalfSteps baked = BakeHalfSteps(robot, config, *first.ground, {});
  const SweptVolumes& volumes = *baked.cached.volumes;
  const double foothold = config.smoothing.limits.demanded_of(MarginFamily::kFoothold);
  std::fprintf(stderr, "%d elements\n", volumes.set.size());
  Counts n;
  while (n.asked < wanted) {
    const Scene scene = DrawBlocks(rise, size, &draw);
    const SweptVolumeQuery query(volumes, robot.sole_outline, scene, 0.0,
                                 std::numeric_limits<double>::infinity(), foothold);
    const HalfStepCertifier certifier(robot, scene, config);
    for (int k = 0; k < kHalfStepsInAScene && n.asked < wanted;) {
      const auto drawn = DrawFoothold(scene, robot, size, &draw);
      if (!drawn || !query.Bears(*drawn)) continue;
      const Foothold& X_WS = *drawn;
      const Side side = draw.AnySide();  // of the foot on which the element lands the other
      int i = -1;
      for (int tries = 0; tries < 40 && i < 0; ++tries) {
        const int any = draw.Index(volumes.set.size());
        const Foothold placed = X_WS * volumes.set.Placement(any, side);
        const auto under = scene.ground->LevelUnder(robot.sole_outline, placed.Planar(), 1e9);
        if (under && std::abs(under->height - placed.height) < 1e-9 &&
            query.Bears({placed.Planar(), under->height})) {
          i = any;
        }
      }
      if (i < 0) continue;
      ++k;
      const bool down = draw.Index(2) == 0;
      const auto free_at = [&](const Foothold& at) {
        return down ? query.DownIsFree(i, side, at) : query.UpIsFree(i, side, at);
      };
      const HalfStep half_step = down ? volumes.set.Down(i, side) : volumes.set.Up(i, side);
      const Foothold placement = volumes.set.Placement(i, side);
      Foothold X_WSupport = X_WS;
      if (!down) {  // of its level, to the bit
        X_WSupport = X_WS * placement;
        X_WSupport.height =
            scene.ground->LevelUnder(robot.sole_outline, X_WSupport.Planar(), 1e9)->height;
      }
      ++n.asked;
      auto& by_rise = n.by_rise[std::lround(1e3 * placement.height)];
      ++by_rise[0];
      if (free_at(X_WS)) {
        ++n.free;
        ++by_rise[1];
        if (!certifier.Certifies(half_step, X_WSupport)) {
          ++n.not_certified;
          std::printf("contradiction: element %d, %s, %s, x %.17g y %.17g z %.17g yaw %.17g\n", i,
                      down ? "down" : "up", std::string(Name(side)).c_str(), X_WS.x, X_WS.y,
                      X_WS.height, X_WS.yaw);
        }
      } else if (n.asked % 10 == 0) {
        ++n.refused;
        n.certified_refused += certifier.Certifies(half_step, X_WSupport);
      }
      // A control: the same asked beside the place must be wrong now and then.
      const Foothold beside({X_WS.x + size * kDisplaced, X_WS.y, X_WS.yaw}, X_WS.height);
      if (n.asked % 20 == 0 && free_at(beside)) {
        ++n.controls;
        n.refuted_controls += !certifier.Certifies(half_step, X_WSupport);
      }
    }
    if (n.asked % 2000 == 0) {
      std::fprintf(stderr, "%ld asked, %ld free, %ld not certified\n", n.asked, n.free,
                   n.not_certified);
    }
  }
  const double free_share = static_cast<double>(n.free) / static_cast<double>(n.asked);
  const double refused_free = (1.0 - free_share) * static_cast<double>(n.certified_refused) /
                              static_cast<double>(std::max(n.refused, 1L));
  std::printf(
      "%s: %ld half-steps of %d elements, 18 blocks and 8 boxes: %ld called free, %ld of them not "
      "certified\n",
      name.c_str(), n.asked, volumes.set.size(), n.free, n.not_certified);
  for (const auto& [mm, counts] : n.by_rise) {
    std::printf("  landing %ld mm higher: %ld, free %ld\n", mm, counts[0], counts[1]);
  }
  std::printf("of %ld refused ones looked at, %ld are certified: %.2f %% of what is free\n",
              n.refused, n.certified_refused, 100.0 * refused_free / (free_share + refused_free));
  std::printf("control: of %ld called free %.0f mm beside, %ld not certified\n", n.controls,
              1e3 * size * kDisplaced, n.refuted_controls);
  return n.not_certified == 0 ? 0 : 1;
}
