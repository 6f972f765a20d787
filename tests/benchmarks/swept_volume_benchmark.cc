// Is a half-step free? Baked volumes against what others do, on the same scenes and half-steps:
// FCL's triangle BVH of the volume's surface, and sampling the half-step. One thread.
// Counters: free, the fraction called free; volumes are kept in a cache folder beside other
// temporary files.

#include <benchmark/benchmark.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <vector>

#include "planner/collision/collision_world.h"
#include "planner/swept/box_tree_obj.h"
#include "planner/swept/swept_volume_cache.h"
#include "tests/benchmarks/wavy_ball.h"
#include "tests/planner/swept_volume_draws.h"
#include "wpg/motion/half_step_tracks.h"
#include "wpg/motion/lipm.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Bvh = fcl::BVHModel<fcl::OBBd>;

constexpr double kRoom = 3.0;       // half of its width [m]
constexpr int kCompared = 24;       // elements that FCL has room for
constexpr double kFclCell = 0.017;  // of the volumes given to FCL: about 16 000 to 26 000 triangles

const SweptVolumes& Volumes(double cell, bool few) {
  static std::map<std::pair<double, bool>, SweptVolumes> all;
  const auto known = all.find({cell, few});
  if (known != all.end()) return known->second;
  static const StepSet every = WalkableSet(SweptRobot());
  StepSet set = every;
  if (few) {
    set.placements.clear();
    for (int i = 0; i < kCompared; ++i) {
      set.placements.push_back(every.placements[static_cast<size_t>(i * every.size() / kCompared)]);
    }
  }
  const std::string folder =
      (std::filesystem::temp_directory_path() / "halfstep-swept-study").string();
  CachedVolumes cached =
      LoadOrBakeSweptVolumes(SweptRobot(), LipmOf(SweptRobot()), set, {.cell = cell}, folder);
  return all.emplace(std::pair(cell, few), *std::move(cached.volumes)).first->second;
}

enum Kind { kBoxes, kMixed, kMeshes };

// Fifty boxes; fifty of all primitives; twelve meshes of 5000 triangles.
Scene Room(Kind kind) {
  SweptDraw draw(11);
  Scene scene = DrawBoxes(kind == kMeshes ? 12 : 50, kRoom, true, &draw);
  for (size_t i = 0; i < scene.obstacles.size(); ++i) {
    Obstacle& o = scene.obstacles[i];
    const double radius = draw.Uniform(0.03, 0.2), length = draw.Uniform(0.05, 0.8);
    if (kind == kMeshes) o.shape = WavyBall(51, 0.2);
    if (kind != kMixed) continue;
    if (i % 4 == 1) o.shape = Sphere{radius};
    if (i % 4 == 2) o.shape = Capsule{radius, length};
    if (i % 4 == 3) o.shape = Cylinder{radius, length};
    if (i % 8 >= 4) o.X_WO.linear() = draw.Turn(false);
  }
  return scene;
}

struct Asked {
  int element;
  Side support;
  Foothold X_WS;
};
std::vector<Asked> Questions(int elements, int count) {
  SweptDraw draw(12);
  std::vector<Asked> questions;
  for (int i = 0; i < count; ++i) {
    const int element = draw.Index(elements);
    const Side support = draw.AnySide();
    questions.push_back({element, support, Foothold::Level(draw.Floor(kRoom))});
  }
  return questions;
}

void Report(benchmark::State& state, size_t free, size_t asked) {
  state.counters["free"] = static_cast<double>(free) / static_cast<double>(asked);
  state.SetItemsProcessed(static_cast<int64_t>(asked));
}

// Arguments: kind of room, cell [mm], few elements (as FCL) or the whole set.
void BM_SweptVolumeQuery(benchmark::State& state) {
  const SweptVolumes& volumes = Volumes(1e-3 * static_cast<double>(state.range(1)), state.range(2));
  const SweptVolumeQuery query(volumes, SweptRobot().sole_outline,
                               Room(static_cast<Kind>(state.range(0))));
  const auto questions = Questions(volumes.set.size(), 1 << 15);
  size_t asked = 0, free = 0;
  for (auto _ : state) {
    const Asked& q = questions[asked++ & (questions.size() - 1)];
    free += query.DownIsFree(q.element, q.support, q.X_WS) ? 1 : 0;
  }
  Report(state, free, asked);
}
BENCHMARK(BM_SweptVolumeQuery)
    ->ArgNames({"room", "cell_mm", "few"})
    ->ArgsProduct({{kBoxes, kMixed, kMeshes}, {10}, {0}})
    ->ArgsProduct({{kBoxes, kMixed, kMeshes}, {10, 17}, {1}});

std::shared_ptr<Bvh> MakeBvh(const std::vector<Vector3d>& points,
                             const std::vector<fcl::Triangle>& triangles) {
  auto bvh = std::make_shared<Bvh>();
  bvh->beginModel(static_cast<int>(triangles.size()), static_cast<int>(points.size()));
  bvh->addSubModel(points, triangles);
  bvh->endModel();
  return bvh;
}

// The volume's outer surface, mirrored for a right support.
std::shared_ptr<Bvh> SurfaceBvh(const BoxTree& tree, bool mirrored, size_t* count) {
  std::istringstream text(BoxTreeObj(tree));
  std::vector<Vector3d> points;
  std::vector<fcl::Triangle> triangles;
  std::string word;
  while (text >> word) {
    if (word == "v") {
      Vector3d v;
      text >> v.x() >> v.y() >> v.z();
      if (mirrored) v.y() = -v.y();
      points.push_back(v);
    } else {
      size_t k[4];
      for (size_t& i : k) text >> i;
      triangles.emplace_back(k[0] - 1, k[1] - 1, k[2] - 1);
      triangles.emplace_back(k[0] - 1, k[2] - 1, k[3] - 1);
    }
  }
  *count = triangles.size();
  return MakeBvh(points, triangles);
}

std::shared_ptr<fcl::CollisionGeometryd> FclShape(const Obstacle& obstacle) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&obstacle.shape)) {
    std::vector<Vector3d> points(mesh->vertices.colwise().begin(), mesh->vertices.colwise().end());
    std::vector<fcl::Triangle> triangles;
    for (const Eigen::Vector3i& t : mesh->triangles.colwise()) {
      triangles.emplace_back(static_cast<size_t>(t[0]), static_cast<size_t>(t[1]),
                             static_cast<size_t>(t[2]));
    }
    return MakeBvh(points, triangles);
  }
  const ConvexBody& body = std::get<ConvexBody>(obstacle.shape);
  const Vector3d size = 2 * body.vertices.rowwise().maxCoeff();
  if (body.vertices.cols() == 8) return std::make_shared<fcl::Boxd>(size);
  if (body.vertices.cols() == 1) return std::make_shared<fcl::Sphered>(body.ball_radius);
  if (body.disc_radius > 0) return std::make_shared<fcl::Cylinderd>(body.disc_radius, size.z());
  return std::make_shared<fcl::Capsuled>(body.ball_radius, size.z());
}

// Obstacles are culled in the support frame by their bounding spheres against the volume's bounds,
// as FCL's own bounds of a rotated body would be wider.
void BM_FclObbQuery(benchmark::State& state) {
  const SweptVolumes& volumes = Volumes(kFclCell, true);
  const Scene scene = Room(static_cast<Kind>(state.range(0)));
  static std::array<std::vector<std::shared_ptr<Bvh>>, 2> surfaces;
  static size_t least = 1u << 30, most = 0;
  if (surfaces[0].empty()) {
    for (const bool mirrored : {false, true}) {
      for (const auto& tree : volumes.down) {
        size_t count = 0;
        surfaces[mirrored].push_back(SurfaceBvh(*tree, mirrored, &count));
        least = std::min(least, count);
        most = std::max(most, count);
      }
    }
  }
  std::vector<std::shared_ptr<fcl::CollisionGeometryd>> shapes;
  for (const Obstacle& o : scene.obstacles) {
    shapes.push_back(FclShape(o));
    shapes.back()->computeLocalAABB();
  }
  const auto questions = Questions(volumes.set.size(), 1 << 15);
  const auto ask = [&](const Asked& q) {
    const bool mirrored = q.support == Side::kRight;
    const BoxTree& tree = *volumes.down[static_cast<size_t>(q.element)];
    const auto& surface = surfaces[mirrored][static_cast<size_t>(q.element)];
    Vector3d middle = 0.5 * (tree.Lower() + tree.Upper());
    const Vector3d half = 0.5 * (tree.Upper() - tree.Lower());
    if (mirrored) middle.y() = -middle.y();
    const Isometry3d X_SW = ToIsometry(q.X_WS.Inverse());
    for (size_t i = 0; i < shapes.size(); ++i) {
      const Isometry3d X_SO = X_SW * scene.obstacles[i].X_WO;
      const Vector3d off = (X_SO * shapes[i]->aabb_center - middle).cwiseAbs() - half;
      if ((off.array() > shapes[i]->aabb_radius).any()) continue;
      const fcl::CollisionRequestd request;
      fcl::CollisionResultd result;
      if (fcl::collide(surface.get(), Isometry3d::Identity(), shapes[i].get(), X_SO, request,
                       result) > 0) {
        return false;
      }
    }
    return true;
  };
  size_t asked = 0, free = 0;
  for (auto _ : state) free += ask(questions[asked++ & (questions.size() - 1)]) ? 1 : 0;
  Report(state, free, asked);
  state.counters["least_triangles"] = static_cast<double>(least);
  state.counters["most_triangles"] = static_cast<double>(most);
}
BENCHMARK(BM_FclObbQuery)->ArgName("room")->DenseRange(kBoxes, kMeshes);

// 300 configurations × leg bodies, their poses in S prepared; stops at the first contact.
void BM_SampledQuery(benchmark::State& state) {
  const SweptVolumes& volumes = Volumes(kFclCell, true);
  const RobotModel& robot = SweptRobot();
  const CollisionWorld world(Room(static_cast<Kind>(state.range(0))));
  std::vector<size_t> bodies;
  std::vector<CollisionShape> shapes;
  for (size_t b = 0; b < robot.bodies.size(); ++b) {
    if (robot.bodies[b].leg < 0) continue;
    bodies.push_back(b);
    shapes.emplace_back(robot.bodies[b].shape);
  }
  std::map<std::pair<int, Side>, std::vector<Isometry3d>> poses;
  for (int i = 0; i < volumes.set.size(); ++i) {
    for (const Side support : {Side::kLeft, Side::kRight}) {
      const HalfStep half_step = volumes.set.Down(i, support);
      const HalfStepTracks tracks(half_step, LipmOf(robot));
      for (int n = 0; n < 300; ++n) {
        const Posture posture = SolvePosture(robot, tracks.At(half_step.duration * n / 299).value);
        for (size_t b : bodies) poses[{i, support}].push_back(posture.OfBody(robot.bodies[b]));
      }
    }
  }
  const auto questions = Questions(volumes.set.size(), 1 << 15);
  const auto ask = [&](const Asked& q) {
    const Isometry3d X_WS = ToIsometry(q.X_WS);
    std::vector<CollisionWorld::Scratch> scratch(bodies.size());
    const auto& posed = poses[{q.element, q.support}];
    for (size_t k = 0; k < posed.size(); ++k) {
      const size_t b = k % bodies.size();
      if (!world.Clears(shapes[b], X_WS * posed[k], 0.0, 0.0, &scratch[b])) return false;
    }
    return true;
  };
  size_t asked = 0, free = 0;
  for (auto _ : state) free += ask(questions[asked++ & (questions.size() - 1)]) ? 1 : 0;
  Report(state, free, asked);
}
BENCHMARK(BM_SampledQuery)->ArgName("room")->DenseRange(kBoxes, kMeshes);

// One obstacle of fifty moves, and one query after it.
void BM_MoveOneObstacle(benchmark::State& state) {
  const SweptVolumes& volumes = Volumes(0.01, false);
  const Scene scene = Room(static_cast<Kind>(state.range(0)));
  SweptVolumeQuery query(volumes, SweptRobot().sole_outline, scene);
  Isometry3d X_WO = scene.obstacles[3].X_WO;
  size_t asked = 0;
  for (auto _ : state) {
    X_WO.translation().x() = 1e-3 * static_cast<double>(asked++ % 1000);
    query.SetObstaclePose(3, X_WO);
    benchmark::DoNotOptimize(query.DownIsFree(0, Side::kLeft, {}));
  }
}
BENCHMARK(BM_MoveOneObstacle)->ArgName("room")->Arg(kBoxes)->Arg(kMeshes);

void BM_BakeElement(benchmark::State& state) {
  const StepSet set = FewHalfSteps();
  const SweptVolumeBaker baker(SweptRobot(), {.cell = 1e-3 * static_cast<double>(state.range(0))});
  for (auto _ : state) {
    benchmark::DoNotOptimize(baker.Bake(set.Down(0, Side::kLeft), LipmOf(SweptRobot())));
  }
}
BENCHMARK(BM_BakeElement)->ArgName("cell_mm")->Arg(10)->Arg(20)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace halfstep
