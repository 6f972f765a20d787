#include "planner/scene/cloud_fields.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <utility>

#include "planner/scene/voxel_set.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

constexpr Eigen::Index kMostTriangles = 5'000'000;  // as of a mesh

void DeclareFloor(Fields& fields, CloudFields* cloud) {
  fields.OptionalNumber(
      "floor_below_m", &cloud->floor_below,
      {.meaning = "what is not higher above z = 0 is floor and left out: a point, "
                  "or the middle of a cell",
       .unit = "m",
       .min = -1.0,
       .max = 0.1});
}

// Reads the file of `key` `file` by `load`; complaints of the file are the scene's.
template <typename Load>
void Read(Fields& fields, const std::string& file, const Load& load) {
  if (file.empty()) {
    fields.Complain("file", "no file name");
    return;
  }
  try {
    load((std::filesystem::path(fields.directory()) / file).string());
  } catch (const InputError& error) {
    for (const std::string& complaint : error.complaints()) fields.Complain("file", complaint);
  }
}

class FloorTest {
 public:
  FloorTest(const Eigen::Isometry3d& X_WO, double floor, std::optional<double> below)
      : up_O_(X_WO.linear().row(2)), height_(X_WO.translation().z() - floor), below_(below) {}
  bool IsFloor(const Eigen::Vector3d& p) const {
    return below_ && up_O_.dot(p) + height_ <= *below_;
  }

 private:
  Eigen::Vector3d up_O_;
  double height_;  // of the origin of O above the floor [m]
  std::optional<double> below_;
};

// Calls visit(cell) for the cells of a cube until it returns false.
template <typename Visit>
bool ForCells(const Eigen::Vector3i& lower, const Eigen::Vector3i& size, const Visit& visit) {
  for (int i = 0; i < size.x(); ++i) {
    for (int j = 0; j < size.y(); ++j) {
      for (int k = 0; k < size.z(); ++k) {
        if (!visit(Eigen::Vector3i(lower + Eigen::Vector3i(i, j, k)))) return false;
      }
    }
  }
  return true;
}

// The occupied cells, and the unknown ones within the bounds of what is known where these count.
// False: too many.
bool AddCells(const CloudFields& cloud, const FloorTest& floor, VoxelSet* cells, long* of_floor) {
  const LoadedOctomap& map = *cloud.map;
  const auto add = [&](const Eigen::Vector3i& cell) {
    if (floor.IsFloor(map.resolution * (cell.cast<double>().array() + 0.5).matrix())) {
      ++*of_floor;
      return true;
    }
    cells->Add(cell);
    return !cells->full();
  };
  const auto cube_of = [](int size) { return Eigen::Vector3i(size, size, size); };
  if (!cloud.unknown_is_occupied) {
    for (const LoadedOctomap::Cube& cube : map.cubes) {
      if (cube.occupied && !ForCells(cube.lower, cube_of(cube.size), add)) return false;
    }
    return true;
  }
  Eigen::AlignedBox3i known;
  VoxelSet free(map.resolution);
  for (const LoadedOctomap::Cube& cube : map.cubes) {
    known.extend(cube.lower).extend(Eigen::Vector3i(cube.lower + cube_of(cube.size)));
    const auto add_free = [&free](const Eigen::Vector3i& cell) {
      free.Add(cell);
      return !free.full();
    };
    if (!cube.occupied && !ForCells(cube.lower, cube_of(cube.size), add_free)) return false;
  }
  free.Finish();
  const Eigen::Matrix<std::int64_t, 3, 1> sizes = known.sizes().cast<std::int64_t>();
  if (static_cast<double>(sizes.x()) * static_cast<double>(sizes.y()) *
          static_cast<double>(sizes.z()) >
      4.0 * VoxelSet::kMost) {
    return false;
  }
  return ForCells(known.min(), known.sizes(),
                  [&](const Eigen::Vector3i& cell) { return free.Has(cell) || add(cell); });
}

}  // namespace

void DeclarePoints(Fields& fields, CloudFields* cloud) {
  std::string file;
  fields.Text("file", &file, {.meaning = "PLY or PCD file, beside the scene", .required = true});
  fields.Number("radius_m", &cloud->radius,
                {.meaning = "radius of the ball around each point that is in the way, and edge of "
                            "the cubes that hold them",
                 .unit = "m",
                 .min = 1e-3,
                 .max = 1.0,
                 .required = true});
  DeclareFloor(fields, cloud);
  Read(fields, file, [&](const std::string& path) {
    cloud->points = LoadPoints(path);
    cloud->file = cloud->points->file;
    cloud->file.name = file;
  });
}

void DeclareOctomap(Fields& fields, CloudFields* cloud) {
  std::string file, unknown = "free";
  fields.Text("file", &file,
              {.meaning = "OctoMap file, .bt or .ot, beside the scene", .required = true});
  fields.Text("unknown", &unknown,
              {.meaning = "what is neither occupied nor free, within the bounds of what is known",
               .choices = {"free", "occupied"}});
  DeclareFloor(fields, cloud);
  cloud->unknown_is_occupied = unknown == "occupied";
  Read(fields, file, [&](const std::string& path) {
    cloud->map = LoadOctomap(path);
    cloud->file = cloud->map->file;
    cloud->file.name = file;
  });
}

TriangleMesh MeshOfCloud(Fields& obstacle, const Eigen::Isometry3d& X_WO, double floor,
                         CloudFields* cloud) {
  const bool is_map = cloud->map.has_value();
  const char* const key = is_map ? "octomap" : "points";
  const FloorTest test(X_WO, floor, cloud->floor_below);
  VoxelSet cells(is_map ? cloud->map->resolution : cloud->radius);
  long of_floor = 0;
  bool fits = true;
  if (is_map) {
    fits = AddCells(*cloud, test, &cells, &of_floor);
  } else if (cloud->radius > 0.0) {
    for (const Eigen::Vector3d& p : cloud->points->points.colwise()) {
      if (test.IsFloor(p)) {
        ++of_floor;
      } else if (!(fits = cells.AddBall(p, cloud->radius) && !cells.full())) {
        break;
      }
    }
  } else {
    return {};  // complained about
  }
  cells.Finish();
  TriangleMesh mesh;
  if (!fits || cells.size() > VoxelSet::kMost) {
    obstacle.Complain(key,
                      "too many cubes, or too far from the origin (valid: at most 20 million, "
                      "within a million of them; a larger radius, or a smaller part)");
    return mesh;
  }
  if (cells.size() == 0) {
    obstacle.Complain(key,
                      "nothing of it is in the way (valid: something that is occupied and no "
                      "floor, or no such obstacle)");
    return mesh;
  }
  mesh = cells.Surface();
  mesh.cubes = std::make_shared<const VoxelSet>(std::move(cells));
  if (mesh.triangles.cols() > kMostTriangles) {
    obstacle.Complain(key, std::to_string(mesh.triangles.cols()) +
                               " triangles around its cubes (valid: at most 5 million; a larger "
                               "radius, or a smaller part)");
    return {};
  }
  if (of_floor > 0) {
    cloud->told.push_back(Formatted("%ld %s at or below z = %.3g m are floor", of_floor,
                                    is_map ? "cells" : "points", floor + *cloud->floor_below));
  }
  if (!is_map && cloud->points->invalid > 0) {
    cloud->told.push_back(
        Formatted("%d points are nan, which marks them as none", cloud->points->invalid));
  }
  return mesh;
}

}  // namespace halfstep
