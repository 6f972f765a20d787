// Cost of the collision queries that the planner and the smoother ask millions of times.

#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <random>

#include "planner/collision/collision_world.h"
#include "planner/collision/separation.h"
#include "tests/benchmarks/wavy_ball.h"
#include "tests/draws.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

// `count` vertices on an ellipsoid of the size of a shank.
ConvexBody Hull(int count, std::mt19937* random) {
  Eigen::Matrix3Xd points(3, count);
  for (int i = 0; i < count; ++i) {
    const double x = Uniform(random, -1, 1), y = Uniform(random, -1, 1);
    const double z = Uniform(random, -1, 1);
    points.col(i) = Vector3d(x, y, z).normalized().cwiseProduct(Vector3d(0.07, 0.07, 0.2));
  }
  return MakeHull(points);
}

Isometry3d At(double x, double y, double z, double yaw) {
  return Eigen::Translation3d(x, y, z) * Eigen::AngleAxisd(yaw, Vector3d::UnitZ());
}

Scene BoxRoom(int count, std::mt19937* random) {
  Scene scene;
  for (int i = 0; i < count; ++i) {
    const double x = Uniform(random, -3, 3), y = Uniform(random, -3, 3);
    const double height = Uniform(random, 0.05, 1), yaw = Uniform(random, -3, 3);
    const Vector3d size(Uniform(random, 0.05, 0.4), Uniform(random, 0.05, 0.4), height);
    scene.obstacles.push_back({"box " + std::to_string(i), Box{size}, At(x, y, height / 2, yaw)});
  }
  return scene;
}

// 40-vertex hulls 0.2 m apart, a little farther along x with every query.
void BM_SeparationAlong(benchmark::State& state) {
  std::mt19937 random(1);
  const ConvexBody a = Hull(40, &random), b = Hull(40, &random);
  const Isometry3d X_Wb = At(0.1, 0.2, 0.3, 0.4);
  Isometry3d X_Wa = At(0.4, 0.1, 0.3, 0.7);
  for (auto _ : state) {
    X_Wa.translation().x() += 1e-9;
    benchmark::DoNotOptimize(SeparationAlong(a, X_Wa, b, X_Wb, Vector3d::UnitX()));
  }
}
BENCHMARK(BM_SeparationAlong);

void BM_Separate(benchmark::State& state) {
  std::mt19937 random(2);
  const CollisionShape a(Hull(40, &random)), b(Hull(40, &random)), box(MakeBox({0.3, 0.2, 0.1}));
  const CollisionShape& other = state.range(0) == 0 ? b : box;
  const Isometry3d X_Wb = At(0, 0, 0, 0.4);
  for (auto _ : state) {
    state.PauseTiming();
    const double yaw = Uniform(&random, -3, 3), distance = Uniform(&random, 0.35, 0.6);
    const Isometry3d X_Wa = At(distance * std::cos(yaw), distance * std::sin(yaw), 0, yaw);
    state.ResumeTiming();
    benchmark::DoNotOptimize(Separate(a, X_Wa, other, X_Wb));
  }
}
BENCHMARK(BM_Separate)->Arg(0)->Arg(1)->Iterations(200000);

// A shank beside one box, moved by less than the cached direction notices.
void BM_ClearsAlongCachedAccepted(benchmark::State& state) {
  std::mt19937 random(3);
  const CollisionShape shank(Hull(40, &random)), box(MakeBox({0.3, 0.2, 0.1}));
  const Isometry3d X_Wb = At(0, 0, 0.05, 0.4);
  Isometry3d X_Wa = At(0.26, 0.05, 0.2, 0.7);
  Vector3d normal_W = Vector3d::Zero();
  bool clears = true;
  for (auto _ : state) {
    X_Wa.translation().x() += 1e-9;
    clears = clears && ClearsAlongCached(shank, X_Wa, box, X_Wb, 0.01, &normal_W);
  }
  if (!clears) state.SkipWithError("the shank meets the box");
}
BENCHMARK(BM_ClearsAlongCachedAccepted);

// The same pair without a cached direction.
void BM_ClearsAlongFresh(benchmark::State& state) {
  std::mt19937 random(3);
  const CollisionShape shank(Hull(40, &random)), box(MakeBox({0.3, 0.2, 0.1}));
  const Isometry3d X_Wb = At(0, 0, 0.05, 0.4), X_Wa = At(0.26, 0.05, 0.2, 0.7);
  for (auto _ : state) {
    Vector3d normal_W = Vector3d::Zero();
    benchmark::DoNotOptimize(ClearsAlongCached(shank, X_Wa, box, X_Wb, 0.01, &normal_W));
  }
}
BENCHMARK(BM_ClearsAlongFresh);

// A shank carried through a 6 × 6 m room: along a line that meets nothing, or at random places.
void BM_ClearsRoom(benchmark::State& state) {
  std::mt19937 random(4);
  const CollisionWorld world(BoxRoom(static_cast<int>(state.range(0)), &random));
  const CollisionShape shank(Hull(40, &random));
  const bool at_random = state.range(1) == 1;
  std::vector<Isometry3d> places;
  for (int i = 0; i < 4096; ++i) {
    const double x = at_random ? Uniform(&random, -3, 3) : -3 + 6 * i / 4096.0;
    const double y = at_random ? Uniform(&random, -3, 3) : 0.4 * std::sin(x);
    places.push_back(At(x, y, 0.3, x));
  }
  CollisionWorld::Scratch scratch;
  size_t i = 0, free = 0, asked = 0;
  for (auto _ : state) {
    free += world.Clears(shank, places[i++ & 4095], 0.0, 0.01, &scratch) ? 1 : 0;
    ++asked;
  }
  state.counters["free"] = static_cast<double>(free) / static_cast<double>(asked);
}
BENCHMARK(BM_ClearsRoom)->Args({50, 0})->Args({50, 1})->Args({500, 0});

void BM_FindNearestRoom(benchmark::State& state) {
  std::mt19937 random(4);
  const CollisionWorld world(BoxRoom(50, &random));
  const CollisionShape shank(Hull(40, &random));
  for (auto _ : state) {
    state.PauseTiming();
    const Isometry3d X_WB = At(Uniform(&random, -3, 3), Uniform(&random, -3, 3), 0.3, 0);
    state.ResumeTiming();
    benchmark::DoNotOptimize(world.FindNearest(shank, X_WB, 0.0, 0.3));
  }
}
BENCHMARK(BM_FindNearestRoom)->Iterations(200000);

void BM_SeparateFromMesh(benchmark::State& state) {
  std::mt19937 random(5);
  const CollisionShape mesh(WavyBall(static_cast<int>(state.range(0)), 0.25));
  const CollisionShape shank(Hull(40, &random));
  const Isometry3d X_Wm = At(0, 0, 0.25, 0);
  double angle = 0;
  for (auto _ : state) {
    angle += 0.01;
    const Isometry3d X_Wa = At(0.4 * std::cos(angle), 0.4 * std::sin(angle), 0.3, angle);
    benchmark::DoNotOptimize(Separate(shank, X_Wa, mesh, X_Wm));
  }
}
BENCHMARK(BM_SeparateFromMesh)->Arg(20)->Arg(70);

}  // namespace
}  // namespace halfstep
