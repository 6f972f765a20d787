// What swept volumes contain, by how much they are too large, and what that costs. Prints the
// figures of planner/README.md, "Swept volumes". Not a test.
//
//   contain N [ROBOT]  random points of the moving robot in their volumes
//   inflate K          distance of K surface points from the robot, over elements
//   refuse N           free half-steps refused, by resolution; N half-steps each
//   exact N            verdicts against all solid boxes one by one, in double
//
// ROBOT: hrp2, or another one, or NAME-unequal or NAME-offset, whose legs differ
// (tests/oracle/unequal_legs.h).
// The volumes of the whole set are kept in a cache folder beside other temporary files.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "planner/collision/collision_world.h"
#include "planner/collision/convex_distance.h"
#include "planner/swept/swept_volume_cache.h"
#include "tests/oracle/unequal_legs.h"
#include "tests/planner/swept_volume_draws.h"
#include "tests/temporary_folder.h"
#include "wpg/motion/half_step_tracks.h"
#include "wpg/motion/lipm.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

double Seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double Quantile(std::vector<double> values, double fraction) {
  const size_t k = static_cast<size_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<long>(k), values.end());
  return values[k];
}

SweptVolumes Get(const StepSet& set, const SweptVolumeOptions& options,
                 const RobotModel& robot = SweptRobot()) {
  const std::string folder =
      (std::filesystem::temp_directory_path() / "halfstep-swept-study").string();
  const double begin = Seconds();
  CachedVolumes cached = LoadOrBakeSweptVolumes(robot, LipmOf(robot), set, options, folder);
  const double took = Seconds() - begin;
  size_t nodes = 0, boxes = 0, none = 0;
  double volume = 0;
  for (const auto* all : {&cached.volumes->down, &cached.volumes->up}) {
    for (const auto& tree : *all) {
      none += !tree;
      if (!tree) continue;
      nodes += tree->nodes.size();
      boxes += tree->SolidBoxes().size();
      volume += tree->Volume();
    }
  }
  const double count = static_cast<double>(2 * set.placements.size() - none);
  std::printf(
      "%d elements, cell %.4g m, displacement %.4g m, clearance %.4g m: %s in %.2f s, file %.1f "
      "MB, "
      "nodes %.1f MB; a volume: %.0f boxes, %.4f m3; without volume: %zu\n",
      set.size(), options.cell, options.displacement, options.clearance,
      cached.baked ? "baked" : "read", took,
      1e-6 * static_cast<double>(std::filesystem::file_size(cached.path)),
      1e-6 * static_cast<double>(nodes * sizeof(BoxNode)), static_cast<double>(boxes) / count,
      volume / count, none);
  std::fflush(stdout);
  return *std::move(cached.volumes);
}

HalfStep Choose(const SweptVolumes& volumes, SweptDraw* draw, const BoxTree** tree) {
  while (true) {
    const int i = draw->Index(volumes.set.size());
    const bool down = draw->Index(2) == 0;
    const auto& volume = (down ? volumes.down : volumes.up)[static_cast<size_t>(i)];
    if (!volume) continue;
    *tree = &*volume;
    return down ? volumes.set.Down(i, Side::kLeft) : volumes.set.Up(i, Side::kRight);
  }
}

void Contain(long draws, const std::string& name) {
  const TemporaryFolder folder;
  const RobotModel robot = LoadRobot(oracle::StudiedRobot(name, folder.path().string()));
  const SweptVolumeOptions options;
  const SweptVolumes volumes = Get(WalkableSet(robot), options, robot);
  SweptDraw draw(1);
  long outside = 0, outside_clearance = 0, done = 0;
  while (done < draws) {
    const BoxTree* tree = nullptr;
    HalfStep half_step = Choose(volumes, &draw, &tree);
    const bool mirrored = draw.Index(2) == 0;  // a right support
    if (mirrored) half_step = half_step.Mirrored();
    const HalfStepTracks tracks(half_step, LipmOf(robot));
    for (int k = 0; k < 100 && done < draws; ++k, ++done) {
      BodyPoint point = DrawBodyPoint(robot, half_step, tracks, &draw);
      if (mirrored) point.p_S.y() = -point.p_S.y();
      outside += !tree->Contains(point.p_S);
      outside_clearance += !tree->Contains(point.p_S + options.clearance * draw.Direction());
    }
  }
  std::printf("%ld draws: %ld points of the robot outside, %ld points at the clearance outside\n",
              done, outside, outside_clearance);
}

// Distance of a point from the robot over densely sampled time, at most `enough` needed.
class Truth {
 public:
  explicit Truth(const HalfStep& half_step) {
    const RobotModel& robot = SweptRobot();
    const HalfStepTracks tracks(half_step, LipmOf(robot));
    constexpr int kInstants = 1000;  // at 1 m/s, 1 mm from the nearest one
    for (int n = 0; n <= kInstants; ++n) {
      const double tau = half_step.duration * n / kInstants;
      const Posture posture = SolvePosture(robot, tracks.At(tau).value);
      for (const RobotBody& body : robot.bodies) {
        poses_.push_back(
            {&body.shape, posture.OfBody(body), posture.OfBody(body) * body.shape.center});
      }
    }
  }
  double Distance(const Vector3d& p, double enough) const {
    ConvexBody point;
    point.vertices = p;
    point.center = p;
    double nearest = 1e9;
    for (const Posed& posed : poses_) {
      if ((posed.center - p).norm() - posed.shape->radius >= nearest) continue;
      const Vector3d first = p - posed.center;
      if (FindConvexDistance(point, *posed.shape, posed.X_SBody, first, nearest).lower >= nearest) {
        continue;
      }
      const ConvexDistance here =
          FindConvexDistance(point, *posed.shape, posed.X_SBody, first, kConverge);
      nearest = std::min(nearest, std::max(here.upper, 0.0));
      if (nearest <= enough) return nearest;
    }
    return nearest;
  }

 private:
  struct Posed {
    const ConvexBody* shape;
    Eigen::Isometry3d X_SBody;
    Vector3d center;
  };
  std::vector<Posed> poses_;
};

// Points on the outer faces: a point of a solid box's face with nothing beyond.
Vector3d SurfaceOf(const BoxTree& tree, const std::vector<BoxTree::CellBox>& boxes,
                   SweptDraw* draw) {
  while (true) {
    const auto& box = boxes[static_cast<size_t>(draw->Index(static_cast<int>(boxes.size())))];
    const Vector3d lower = tree.Corner(box.lower), upper = tree.Corner(box.upper);
    Vector3d p = draw->Point(lower, upper);
    const int axis = draw->Index(3);
    const bool above = draw->Index(2) == 0;
    p[axis] = above ? upper[axis] : lower[axis];
    Vector3d beyond = p;
    beyond[axis] += (above ? 1e-6 : -1e-6);
    // Small faces are drawn as often as large ones: keep in proportion to the area.
    const Vector3d size = upper - lower;
    const double area = size.prod() / size[axis];
    if (!tree.Contains(beyond) && draw->Uniform(0, 1) < area / 0.04) return p;
  }
}

void Inflate(int points) {
  const RobotModel& robot = SweptRobot();
  const StepSet all = WalkableSet(robot);
  StepSet few{.prototype = all.prototype, .placements = {}};
  for (int i = 0; i < all.size(); i += std::max(1, all.size() / 12)) {
    few.placements.push_back(all.placements[static_cast<size_t>(i)]);
  }
  for (const double cell : {0.005, 0.01, 0.015, 0.02, 0.03}) {
    const SweptVolumeOptions options{.cell = cell};
    const SweptVolumes volumes = Get(few, options);
    SweptDraw draw(1);
    std::vector<double> over, ratios;
    for (int i = 0; i < few.size(); ++i) {
      const auto& tree = volumes.down[static_cast<size_t>(i)];
      if (!tree) continue;
      const Truth truth(few.Down(i, Side::kLeft));
      const auto boxes = tree->SolidBoxes();
      for (int k = 0; k < points; ++k) {
        over.push_back(truth.Distance(SurfaceOf(*tree, boxes, &draw), 0.0) - options.clearance);
      }
      int inside = 0, needed = 0;
      while (inside < points) {
        const Vector3d p = draw.Point(tree->Lower(), tree->Upper());
        if (!tree->Contains(p)) continue;
        ++inside;
        needed += truth.Distance(p, options.clearance) <= options.clearance;
      }
      ratios.push_back(static_cast<double>(inside) / needed);
    }
    std::printf(
        "  beyond the clearance: least %.1f, median %.1f, 95 %% %.1f, largest %.1f mm; volume "
        "ratio: "
        "median %.3f, largest %.3f\n",
        1e3 * Quantile(over, 0), 1e3 * Quantile(over, 0.5), 1e3 * Quantile(over, 0.95),
        1e3 * Quantile(over, 1), Quantile(ratios, 0.5), Quantile(ratios, 1));
    std::fflush(stdout);
  }
}

// Free by 300 instants of all bodies at the demanded clearance.
bool SampledFree(const CollisionWorld& world, const std::vector<CollisionShape>& shapes,
                 const HalfStep& half_step, const Foothold& X_WS, double clearance) {
  const RobotModel& robot = SweptRobot();
  const HalfStepTracks tracks(half_step, LipmOf(robot));
  std::vector<CollisionWorld::Scratch> scratch(robot.bodies.size());
  for (int n = 0; n < 300; ++n) {
    const double tau = half_step.duration * n / 299;
    const Posture posture = SolvePosture(robot, Transformed(X_WS, tracks.At(tau).value));
    for (size_t b = 0; b < robot.bodies.size(); ++b) {
      if (!world.Clears(shapes[b], posture.OfBody(robot.bodies[b]), 0.0, clearance, &scratch[b])) {
        return false;
      }
    }
  }
  return true;
}

void Refuse(long draws) {
  const RobotModel& robot = SweptRobot();
  const StepSet all = WalkableSet(robot);
  StepSet few{.prototype = all.prototype, .placements = {}};
  for (int i = 0; i < all.size(); i += std::max(1, all.size() / 24)) {
    few.placements.push_back(all.placements[static_cast<size_t>(i)]);
  }
  std::vector<CollisionShape> shapes;
  for (const RobotBody& body : robot.bodies) shapes.emplace_back(body.shape);
  for (const double cell : {0.005, 0.01, 0.015, 0.02, 0.03}) {
    const SweptVolumeOptions options{.cell = cell};
    const SweptVolumes volumes = Get(few, options);
    SweptDraw draw(1);
    long free = 0, refused = 0, unsound = 0;
    for (long done = 0; done < draws;) {
      const Scene scene = DrawBoxes(50, 3.0, draw.Index(2) == 0, &draw);
      const CollisionWorld world(scene);
      const SweptVolumeQuery query(volumes, robot.sole_outline, scene);
      for (int k = 0; k < 200 && done < draws; ++k, ++done) {
        const int i = draw.Index(few.size());
        const Side support = draw.AnySide();
        const Foothold X_WS = Foothold::Level(draw.Floor(3.0));
        const bool said = query.DownIsFree(i, support, X_WS);
        const bool true_free =
            SampledFree(world, shapes, few.Down(i, support), X_WS, options.clearance);
        free += true_free;
        refused += true_free && !said;
        unsound += said && !true_free;
      }
    }
    std::printf("  %ld half-steps, %ld free: %.2f %% of them refused; called free and not: %ld\n",
                draws, free, 100.0 * static_cast<double>(refused) / static_cast<double>(free),
                unsound);
    std::fflush(stdout);
  }
}

// Separating axes of two boxes in double: the widest gap [m], negative on overlap.
double Gap(const OrientedBox& b, const Vector3d& center, const Vector3d& half) {
  const Vector3d d = b.center - center;
  double gap = -1e9;
  const auto along = [&](const Vector3d& axis) {
    const double length = axis.norm();
    if (length < 1e-9) return;
    const double reach =
        axis.cwiseAbs().dot(half) + (b.axes.transpose() * axis).cwiseAbs().dot(b.half);
    gap = std::max(gap, (std::abs(axis.dot(d)) - reach) / length);
  };
  for (int i = 0; i < 3; ++i) {
    along(Vector3d::Unit(i));
    along(b.axes.col(i));
    for (int j = 0; j < 3; ++j) along(Vector3d::Unit(i).cross(Vector3d(b.axes.col(j))));
  }
  return gap;
}

void Exact(long questions) {
  const RobotModel& robot = SweptRobot();
  const SweptVolumes volumes = Get(WalkableSet(robot), {});
  SweptDraw draw(1);
  long free = 0, differ = 0;
  double widest = 0;
  for (long done = 0; done < questions;) {
    const Scene scene = DrawBoxes(50, 3.0, draw.Index(2) == 0, &draw);
    const SweptVolumeQuery query(volumes, robot.sole_outline, scene);
    for (int k = 0; k < 200 && done < questions; ++k, ++done) {
      const int i = draw.Index(volumes.set.size());
      const Foothold X_WS = Foothold::Level(draw.Floor(3.0));
      const BoxTree& tree = *volumes.down[static_cast<size_t>(i)];
      const bool said = query.DownIsFree(i, Side::kLeft, X_WS);
      double gap = 1e9;
      const Vector3d middle = 0.5 * (tree.Lower() + tree.Upper());
      for (const Obstacle& o : scene.obstacles) {
        const Eigen::Isometry3d X_SO = ToIsometry(X_WS.Inverse()) * o.X_WO;
        const Vector3d half = std::get<ConvexBody>(o.shape).vertices.rowwise().maxCoeff();
        const OrientedBox box{X_SO.translation(), half, X_SO.linear()};
        if (Gap(box, middle, tree.Upper() - middle) > 0) continue;
        for (const auto& cells : tree.SolidBoxes()) {
          const Vector3d lower = tree.Corner(cells.lower), upper = tree.Corner(cells.upper);
          gap = std::min(gap, Gap(box, 0.5 * (lower + upper), 0.5 * (upper - lower)));
        }
      }
      free += said;
      if (said != (gap > 0)) {
        ++differ;
        widest = std::max(widest, std::abs(gap));
      }
    }
  }
  std::printf(
      "%ld questions, %ld free; verdict differs from exact in %ld, gap there at most %.1e m\n",
      questions, free, differ, widest);
}

}  // namespace
}  // namespace halfstep

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  const long number = argc > 2 ? std::atol(argv[2]) : 0;
  if (what == "contain") {
    halfstep::Contain(number > 0 ? number : 1000000, argc > 3 ? argv[3] : "hrp2");
  } else if (what == "inflate") {
    halfstep::Inflate(number > 0 ? static_cast<int>(number) : 200);
  } else if (what == "refuse") {
    halfstep::Refuse(number > 0 ? number : 5000);
  } else if (what == "exact") {
    halfstep::Exact(number > 0 ? number : 10000);
  } else {
    std::printf("swept_volume_study contain|inflate|refuse|exact [NUMBER]\n");
    return 2;
  }
}
