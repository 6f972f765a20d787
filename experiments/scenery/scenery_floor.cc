#include "experiments/scenery/scenery_floor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "planner/scene/mesh_floor.h"
#include "wpg/files/input_error.h"
#include "wpg/files/mesh_file.h"
#include "wpg/files/octomap_file.h"
#include "wpg/files/point_file.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

constexpr double kLevel = 0.9998;     // cosine of 1°
constexpr double kLeastFloor = 1.0;   // of a floor in a mesh [m²]
constexpr double kLargeTop = 4.0;     // of a thing that may be a floor elsewhere [m²]
constexpr double kLevelHeight = 2.0;  // where floors are looked for [m]
constexpr double kLeastRoom = 2.0;    // extent of a cloud in which a floor is looked for [m]
constexpr double kLeastShare = 0.03;  // of all points, in the level with most of them

// A level top that may be the floor of the scene.
struct Level {
  std::string of;
  double height = 0.0, area = 0.0;  // [m], [m²]
};

// `what` says that something lies: "a plane lies".
std::string UpSentence(const std::string& what, double height) {
  // What rounds to −0 is 0.
  return what + Formatted(" at z = %.4g m: if that is the floor, --up %.4g brings it to 0", height,
                          -height + 0.0);
}

class FloorFinder {
 public:
  explicit FloorFinder(Scenery* scenery) : scenery_(*scenery) {}

  void Find() {
    std::vector<SceneryThing> kept;
    for (SceneryThing& thing : scenery_.things) {
      const bool stays =
          std::visit([&](auto& shape) { return Stays(&thing, &shape); }, thing.shape);
      if (stays) kept.push_back(std::move(thing));
    }
    scenery_.things = std::move(kept);
    if (found_ || levels_.empty()) return;
    // The lowest one: tables stand on floors.
    const Level& lowest =
        *std::min_element(levels_.begin(), levels_.end(),
                          [](const Level& a, const Level& b) { return a.height < b.height; });
    scenery_.Tell(UpSentence(lowest.of + Formatted(": a level top of %.3g m² lies", lowest.area),
                             lowest.height));
  }

 private:
  static double HeightOf(const SceneryThing& thing) { return thing.X_WO.translation().z(); }

  bool Stays(SceneryThing* thing, EndlessPlane* plane) {
    const Vector3d normal_W = thing->X_WO.linear() * plane->normal;
    if (!(std::abs(normal_W.z()) >= kLevel)) {
      scenery_.Tell(thing->name + ": a plane that is not level is left out");
    } else if (std::abs(HeightOf(*thing)) <= kSceneryFloorTop) {
      found_ = true;
      scenery_.Tell(thing->name + ": its top lies at 0: the floor");
    } else {
      scenery_.Tell(UpSentence(thing->name + " is left out: a plane lies", HeightOf(*thing)));
    }
    return false;
  }

  // Leaves out what lies at or below the floor.
  bool Stands(const SceneryThing& thing, double top, double area) {
    if (top > kSceneryFloorTop) {
      if (area >= kLargeTop && top <= kLevelHeight) levels_.push_back({thing.name, top, area});
      return true;
    }
    if (top >= -kSceneryFloorTop) {
      found_ = true;
      scenery_.Tell(thing.name + ": its top lies at 0: the floor");
      return false;
    }
    scenery_.Tell(thing.name +
                  Formatted(" is left out: it lies below the floor, its top at %.4g m", top));
    if (area >= kLargeTop && top >= -kLevelHeight) levels_.push_back({thing.name, top, area});
    return false;
  }

  template <typename Primitive>
  bool Stays(SceneryThing* thing, Primitive* shape) {
    const Eigen::AlignedBox3d bounds = BoundsOf(Shape(*shape), thing->X_WO);
    double area = 0.0;  // of a level top
    if constexpr (std::is_same_v<Primitive, Box>) {
      for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(thing->X_WO.linear()(2, axis)) < kLevel) continue;
        area = shape->size[(axis + 1) % 3] * shape->size[(axis + 2) % 3];
      }
    }
    return Stands(*thing, bounds.max().z(), area);
  }

  bool MeshStays(SceneryThing* thing, const TriangleMesh& mesh) {
    double top = -std::numeric_limits<double>::infinity(), floor = 0.0;
    std::map<long, double> levels;  // area facing up by height [mm]
    for (const Eigen::Vector3i& t : mesh.triangles.colwise()) {
      const Vector3d a = thing->X_WO * Vector3d(mesh.vertices.col(t[0]));
      const Vector3d b = thing->X_WO * Vector3d(mesh.vertices.col(t[1]));
      const Vector3d c = thing->X_WO * Vector3d(mesh.vertices.col(t[2]));
      const Vector3d normal = 0.5 * (b - a).cross(c - a);
      const double highest = std::max({a.z(), b.z(), c.z()});
      top = std::max(top, highest);
      if (!(normal.z() >= 0.985 * normal.norm())) continue;
      const double lowest = std::min({a.z(), b.z(), c.z()});
      if (highest <= kFloorTolerance && lowest >= -kFloorTolerance) floor += normal.z();
      if (std::abs(highest) <= kLevelHeight) {
        levels[std::lround(highest / kFloorTolerance)] += normal.z();
      }
    }
    if (!Stands(*thing, top, 0.0)) return false;
    if (floor >= kLeastFloor) {
      found_ = true;
      thing->brings_floor = true;
      scenery_.Tell(
          thing->name +
          Formatted(": %.3g m² of it lie at 0, facing up: the floor, which it brings along "
                    "(floor: in_mesh); what it surrounds is room",
                    floor));
    }
    for (const auto& [level, area] : levels) {
      if (area >= kLargeTop) {
        levels_.push_back({thing->name, kFloorTolerance * static_cast<double>(level), area});
      }
    }
    return true;
  }

  bool Stays(SceneryThing* thing, OwnMesh* mesh) {
    return MeshStays(thing, {mesh->vertices, mesh->triangles});
  }
  bool Stays(SceneryThing* thing, MeshReference* mesh) {
    std::optional<LoadedMesh>& loaded = loaded_[mesh->path.string()];
    try {
      if (!loaded) loaded = LoadMesh(mesh->path.string());
    } catch (const InputError& error) {
      std::vector<std::string> complaints = error.complaints();
      complaints.push_back(mesh->path.string() + ": is named by " + Quote(thing->name) +
                           " (valid: a mesh; --without NAME leaves a thing out)");
      throw InputError(std::move(complaints));
    }
    const Vector3d scale = mesh->scale;
    const TriangleMesh scaled{scale.asDiagonal() * loaded->vertices, loaded->triangles};
    if (scale.x() != scale.y() || scale.x() != scale.z() || scale.x() < 0) {
      thing->shape = OwnMesh{scaled.vertices, scaled.triangles};
      scenery_.Tell(thing->name + ": scaled differently along its axes, so a mesh of its own");
    }
    return MeshStays(thing, scaled);
  }

  bool Stays(SceneryThing* thing, CloudReference* cloud) {
    std::map<long, double> levels;  // points, or cells, by height in `bin`
    double bin = 0.02, all = 0.0;
    Eigen::AlignedBox2d extent;
    const auto add = [&](const Vector3d& p, double weight) {
      const Vector3d p_W = thing->X_WO * p;
      const double height = p_W.z();
      extent.extend(p_W.head<2>());
      if (std::abs(height) <= kLevelHeight / 2) levels[std::lround(height / bin)] += weight;
      all += weight;
    };
    if (cloud->is_map) {
      const LoadedOctomap map = LoadOctomap(cloud->path.string());
      bin = std::max(bin, map.resolution);
      for (const LoadedOctomap::Cube& cube : map.cubes) {
        if (!cube.occupied) continue;
        const Vector3d side = Vector3d::Constant(cube.size);
        add(map.resolution * (cube.lower.cast<double>() + 0.5 * side), 1.0 * cube.size * cube.size);
      }
    } else {
      const LoadedPoints loaded = LoadPoints(cloud->path.string());
      for (const Vector3d& p : loaded.points.colwise()) add(p, 1.0);
    }
    const bool is_room = extent.isEmpty() ? false : extent.sizes().maxCoeff() >= kLeastRoom;
    if (!is_room || levels.empty() || cloud->floor_below) return true;
    const auto most =
        std::max_element(levels.begin(), levels.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    const double share = most->second / all;
    const double height = bin * static_cast<double>(most->first);
    const std::string what =
        Formatted("%.0f %% of its %s lie", 100 * share, cloud->is_map ? "cells" : "points");
    if (share < kLeastShare) {
      scenery_.Tell(thing->name +
                    ": no floor is seen in it (--floor-below M: what is not higher is floor)");
    } else if (std::abs(most->first) <= 1) {
      found_ = true;
      cloud->floor_below = Shortened2(1.5 * bin);
      scenery_.Tell(thing->name + ": " + what +
                    Formatted(" within %.2g m of 0: the floor; what is not higher than %.2g m "
                              "is left out (floor_below_m)",
                              1.5 * bin, *cloud->floor_below));
    } else {
      scenery_.Tell(UpSentence(thing->name + ": " + what, height));
    }
    return true;
  }

  // To a tenth of a millimetre.
  static double Shortened2(double metres) { return std::round(1e4 * metres) / 1e4; }

  Scenery& scenery_;
  bool found_ = false;
  std::vector<Level> levels_;
  std::map<std::string, std::optional<LoadedMesh>> loaded_;
};

}  // namespace

void TakeFloorOut(Scenery* scenery) { FloorFinder(scenery).Find(); }

}  // namespace halfstep
