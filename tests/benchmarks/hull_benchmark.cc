// What hulls with many vertices cost, as public robots' meshes have them: looked at one vertex
// after the other (scan), by the map of directions (map), and simplified outward to 64 vertices
// (simple).

#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <random>
#include <string>

#include "planner/collision/convex_distance.h"
#include "planner/swept/swept_volume.h"
#include "smoothing/proof/missed_demands.h"
#include "tests/places.h"
#include "tests/wpg/one_step.h"
#include "tests/wpg/random_direction.h"
#include "wpg/geometry/simplified_hull.h"
#include "wpg/motion/lipm.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

enum Kind { kScan, kMap, kSimple };

ConvexBody As(ConvexBody hull, Kind kind) {
  if (kind == kSimple) hull = SimplifyOutward(hull, 64).body;
  hull.directions = {};
  if (kind != kScan) MapDirections(&hull);
  return hull;
}

// `body` grown by a ball of `radius` [m], of which there are `count` points.
ConvexBody Dense(const ConvexBody& body, int count, double radius, std::mt19937* random) {
  Eigen::Matrix3Xd points(3, count);
  for (auto p : points.colwise()) {
    const Vector3d d = RandomDirection(random);
    p = SupportPoint(body, d) + radius * d;
  }
  return MakeHull(points);
}

// HRP-2 with such bodies. Precondition of what follows: `kind` is not kScan where shapes are made
// of the bodies, for these make the map themselves.
RobotModel DenseRobot(int count, double radius, Kind kind) {
  std::mt19937 random(1);
  RobotModel robot = LoadRobot(InSources("wpg/robots/hrp2.yaml"));
  for (RobotBody& body : robot.bodies) {
    body.shape = As(Dense(body.shape, count, radius, &random), kind);
  }
  return robot;
}

Kind KindOf(const benchmark::State& state) { return static_cast<Kind>(state.range(1)); }

void Support(benchmark::State& state) {
  std::mt19937 random(2);
  const ConvexBody hull =
      As(Dense(MakeBox({0.1, 0.1, 0.3}), static_cast<int>(state.range(0)), 0.02, &random),
         KindOf(state));
  std::vector<Vector3d> directions;
  for (int i = 0; i < 1024; ++i) directions.push_back(RandomDirection(&random));
  size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(FarthestVertex(hull, directions[i++ % directions.size()]));
  }
}
BENCHMARK(Support)->ArgsProduct({{32, 64, 200, 900}, {kScan, kMap, kSimple}});

// Two shanks, `gap_mm` between their boxes; negative: one in the other, as in an infeasible start.
void Distance(benchmark::State& state) {
  std::mt19937 random(3);
  const int count = static_cast<int>(state.range(0));
  const ConvexBody a = As(Dense(MakeBox({0.1, 0.1, 0.3}), count, 0.02, &random), KindOf(state));
  const ConvexBody b = As(Dense(MakeBox({0.1, 0.1, 0.3}), count, 0.02, &random), KindOf(state));
  Eigen::Isometry3d X_AB = Eigen::Isometry3d::Identity();
  X_AB.translation() = Vector3d(0.14 + 1e-3 * static_cast<double>(state.range(2)), 0.03, 0.05);
  for (auto _ : state) {
    X_AB.translation().z() += 1e-9;
    benchmark::DoNotOptimize(FindConvexDistance(a, b, X_AB, -X_AB.translation(), kConverge));
  }
}
BENCHMARK(Distance)
    ->ArgsProduct({{200, 900}, {kScan, kMap, kSimple}, {20, -20}})
    ->Unit(benchmark::kMicrosecond);

// One half-step.
void Bake(benchmark::State& state) {
  const RobotModel robot = DenseRobot(static_cast<int>(state.range(0)), 0.003, KindOf(state));
  const SweptVolumeBaker baker(robot, {});
  HalfStep half_step;
  half_step.X_SF = Foothold::Level({0.15, -0.21, 0.2});
  for (auto _ : state) {
    benchmark::DoNotOptimize(baker.Bake(half_step, Lipm(robot.com_height)));
  }
}
BENCHMARK(Bake)
    ->ArgsProduct({{32, 200, 900}, {kScan, kMap, kSimple}})
    ->Unit(benchmark::kMillisecond);

// All that a walk misses whose thighs meet the waist at every instant.
void InfeasibleStart(benchmark::State& state) {
  const RobotModel robot = DenseRobot(static_cast<int>(state.range(0)), 0.03, KindOf(state));
  const HalfStepSequence sequence = OneStep(robot);
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  const MarginEvaluator evaluator(robot, {}, {});
  size_t missed = 0;
  for (auto _ : state) missed = FindMissedDemands(evaluator, walk, {}).demands.size();
  state.counters["missed"] = static_cast<double>(missed);
}
BENCHMARK(InfeasibleStart)
    ->ArgsProduct({{200, 900}, {kMap, kSimple}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace halfstep
