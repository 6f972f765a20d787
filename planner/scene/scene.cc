#include "planner/scene/scene.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "planner/scene/cloud_fields.h"
#include "planner/scene/ground_fields.h"
#include "planner/scene/mesh_fields.h"
#include "planner/scene/motion_fields.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/files/yaml_fields.h"
#include "wpg/geometry/rotation.h"
#include "wpg/geometry/simple_polygon.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// Of a mesh's points from the world's origin [m]: a town fits. Doubles there are 2e-12 m apart, and
// what is taken off distances for rounding, 1e-12 of the coordinates, is 1e-8 m.
constexpr double kFarthestPoint = 10e3;
constexpr double kSmallest = 1e-6;      // of any size [m]
constexpr size_t kMostVertices = 1000;  // of a polygon
// 100,000 obstacles: a box that stands turned takes about 20 values and 110 bytes.
constexpr YamlLimits kLimits{.bytes = std::size_t{16} << 20, .values = 2'500'000};

NumberSpec Size(const char* meaning) {
  return {
      .meaning = meaning, .unit = "m", .min = kSmallest, .max = kFarthestPlace, .required = true};
}

// What the text says of an obstacle; exactly one of the shapes is present.
struct ObstacleFields {
  std::string name;
  bool has_box = false, has_cylinder = false, has_sphere = false, has_capsule = false,
       has_mesh = false, has_points = false, has_octomap = false;
  std::vector<double> size;
  double radius = 0.0;
  double length = 0.0;
  MeshFields mesh;
  CloudFields cloud;
  std::vector<double> xyz{0.0, 0.0, 0.0};
  std::vector<double> rpy{0.0, 0.0, 0.0};
  ObstacleMotion motion;
};

struct NoStepFields {
  std::string name;
  Eigen::Matrix2Xd polygon;
};

bool TakeNameOf(Fields& fields, const std::string& name, const std::string& item,
                std::map<std::string, std::string>* taken) {
  const auto [first, is_new] = taken->emplace(name, item);
  if (!is_new) fields.Complain("name", Quote(name) + " is the name of " + first->second + " too");
  return is_new;
}

// Names become parts of paths and CSV cells.
void DeclareName(Fields& fields, std::string* name, bool required, const std::string& item,
                 std::map<std::string, std::string>* taken) {
  fields.Text("name", name, {.meaning = "unique name", .required = required});
  if (!required && name->empty()) return;
  if (name->empty() || name->front() == '.' || name->find('/') != std::string::npos) {
    fields.Complain("name", "unfit as a name: " + Quote(*name) +
                                " (valid: text without '/' that does not begin with '.')");
    return;
  }
  if (const std::string mistake = NameMistake(*name); !mistake.empty()) {
    fields.Complain("name", mistake);
  }
  if (taken == nullptr) return;
  TakeNameOf(fields, *name, item, taken);
}

void DeclareShape(Fields& fields, ObstacleFields* obstacle) {
  fields.OptionalGroup("box", &obstacle->has_box, {.meaning = "box"}, [&](Fields& box) {
    box.Numbers("size_m", &obstacle->size, 3, Size("full edge lengths"));
  });
  fields.OptionalGroup("cylinder", &obstacle->has_cylinder, {.meaning = "cylinder along z"},
                       [&](Fields& cylinder) {
                         cylinder.Number("radius_m", &obstacle->radius, Size("radius"));
                         cylinder.Number("length_m", &obstacle->length, Size("length"));
                       });
  fields.OptionalGroup("sphere", &obstacle->has_sphere, {.meaning = "ball"}, [&](Fields& sphere) {
    sphere.Number("radius_m", &obstacle->radius, Size("radius"));
  });
  fields.OptionalGroup(
      "capsule", &obstacle->has_capsule, {.meaning = "capsule along z"}, [&](Fields& capsule) {
        capsule.Number("radius_m", &obstacle->radius, Size("radius"));
        capsule.Number("length_m", &obstacle->length, Size("distance of the ball centres"));
      });
  fields.OptionalGroup("mesh", &obstacle->has_mesh, {.meaning = "triangle mesh"},
                       [&](Fields& mesh) { DeclareMesh(mesh, &obstacle->mesh); });
  fields.OptionalGroup("points", &obstacle->has_points, {.meaning = "point cloud"},
                       [&](Fields& points) { DeclarePoints(points, &obstacle->cloud); });
  fields.OptionalGroup("octomap", &obstacle->has_octomap, {.meaning = "occupancy map"},
                       [&](Fields& map) { DeclareOctomap(map, &obstacle->cloud); });
  const int shapes = obstacle->has_box + obstacle->has_cylinder + obstacle->has_sphere +
                     obstacle->has_capsule + obstacle->has_mesh + obstacle->has_points +
                     obstacle->has_octomap;
  if (shapes != 1) {
    std::string what = std::to_string(shapes);
    what +=
        " shapes (valid: exactly one of box, cylinder, sphere, capsule, mesh, "
        "points, octomap)";
    fields.Complain("", what);
  }
}

// X_WO of a position and turns about the fixed axes: R = Rz·Ry·Rx.
Eigen::Isometry3d MakePose(const std::vector<double>& xyz, const std::vector<double>& rpy) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = RollPitchYaw(rpy[0], rpy[1], rpy[2]);
  X.translation() = Eigen::Vector3d(xyz[0], xyz[1], xyz[2]);
  return X;
}

// Complains about a mesh that reaches too far, scaled and posed.
void CheckReach(Fields& fields, const ObstacleFields& obstacle) {
  const TriangleMesh& mesh = obstacle.mesh.mesh;
  if (mesh.vertices.cols() == 0) return;
  const Eigen::Isometry3d X_WO = MakePose(obstacle.xyz, obstacle.rpy);
  const Eigen::Matrix3Xd points_W = (X_WO.linear() * mesh.vertices).colwise() + X_WO.translation();
  double farthest = points_W.colwise().norm().maxCoeff();
  const double radius = mesh.vertices.colwise().norm().maxCoeff();
  for (const ObstacleMotion::Waypoint& waypoint : obstacle.motion.waypoints) {
    farthest = std::max(farthest, waypoint.translation.norm() + radius);
  }
  if (farthest <= kFarthestPoint) return;
  fields.Complain(obstacle.has_mesh ? "mesh" : "",
                  Formatted("reaches %.4g m from the world's origin (valid: at most 10000 m; look "
                            "at `scale`, and for stray vertices)",
                            farthest));
}

// `floor`: its height in W [m]; −∞: there is none.
void DeclareObstacle(Fields& fields, double floor, ObstacleFields* obstacle) {
  DeclareShape(fields, obstacle);
  fields.Group("pose", {.meaning = "of the shape in the world"}, [&](Fields& pose) {
    pose.Numbers(
        "xyz", &obstacle->xyz, 3,
        {.meaning = "position", .unit = "m", .min = -kFarthestPlace, .max = kFarthestPlace});
    pose.Numbers("rpy_deg", &obstacle->rpy, 3,
                 {.meaning = "turns about the fixed axes x, then y, then z",
                  .unit = "deg",
                  .min = -360.0,
                  .max = 360.0});
  });
  fields.Group("motion", {.meaning = "what it does while the robot walks"},
               [&](Fields& motion) { DeclareMotion(motion, &obstacle->motion); });
  const Eigen::Isometry3d X_WO = MakePose(obstacle->xyz, obstacle->rpy);
  if (obstacle->cloud.any()) {
    obstacle->mesh.mesh = MeshOfCloud(fields, X_WO, floor, &obstacle->cloud);
  }
  CheckReach(fields, *obstacle);
  const bool rests = obstacle->motion.rests() && obstacle->motion.error == 0.0;
  TakeFloor(fields, obstacle->name, X_WO, floor, rests, &obstacle->mesh);
}

void DeclareNoStep(Fields& fields, NoStepFields* area) {
  fields.Points("polygon_m", &area->polygon,
                {.meaning = "vertices of a simple polygon in order",
                 .required = true,
                 .min_items = 3,
                 .max_items = kMostVertices},
                {.unit = "m", .min = -kFarthestPlace, .max = kFarthestPlace});
  if (area->polygon.cols() == 0) return;
  const std::string mistake = WhyNotSimple(area->polygon);
  if (!mistake.empty()) {
    fields.Complain("polygon_m", mistake + " (valid: a simple polygon of at least 1 mm²)");
  }
}

Shape MakeShape(ObstacleFields* from) {
  if (from->has_box) return Box{{from->size[0], from->size[1], from->size[2]}};
  if (from->has_cylinder) return Cylinder{from->radius, from->length};
  if (from->has_sphere) return Sphere{from->radius};
  if (from->has_capsule) return Capsule{from->radius, from->length};
  if (from->mesh.hull) return *std::move(from->mesh.hull);
  return std::move(from->mesh.mesh);
}

}  // namespace

double Obstacle::speed() const {
  const double by_waypoints =
      motion.waypoints.empty() ? 0.0 : motion.WaypointSpeed(X_WO, RadiusAboutOrigin(shape));
  return by_waypoints + motion.speed;
}

const Obstacle* Scene::ObstacleAt(int index) const {
  return index < std::ssize(obstacles) ? &Nth(obstacles, index) : nullptr;
}

const std::string& Scene::NameOf(int index) const {
  const Obstacle* obstacle = ObstacleAt(index);
  return obstacle != nullptr
             ? obstacle->name
             : Nth(ground->Solids(), index - static_cast<int>(obstacles.size())).name;
}

Scene Scene::Emptied() const {
  Scene empty;
  empty.name = name;
  empty.friction = friction;
  empty.ground = ground;
  return empty;
}

bool Scene::rests() const {
  return std::all_of(obstacles.begin(), obstacles.end(),
                     [](const Obstacle& obstacle) { return obstacle.rests(); });
}

bool Scene::OnlyGrowsFrom(double since) const {
  return std::all_of(obstacles.begin(), obstacles.end(), [since](const Obstacle& obstacle) {
    const ObstacleMotion& motion = obstacle.motion;
    return motion.rests() || (motion.waypoints.empty() && motion.measured_at <= since);
  });
}

Scene LoadScene(const std::string& yaml_path) {
  return ParseScene(yaml_path, ReadYamlFile(yaml_path, kLimits));
}

Scene ParseScene(const std::string& yaml_path, const std::string& text) {
  const std::filesystem::path path(yaml_path);
  Scene scene;
  std::vector<ObstacleFields> obstacles;
  std::vector<NoStepFields> areas;
  GroundFields ground;
  std::map<std::string, std::string> obstacle_names, area_names;
  ReadYamlText(
      text, yaml_path, path.parent_path().string(), {},
      [&](Fields& fields) {
        DeclareName(fields, &scene.name, false, "", nullptr);
        const auto take_name = [&](Fields& item, const std::string& name,
                                   const std::string& where) {
          return TakeNameOf(item, name, where, &obstacle_names);
        };
        DeclareGround(
            fields,
            [&](Fields& item, const std::string& where, std::string* name) {
              DeclareName(item, name, true, where, &obstacle_names);
            },
            take_name, &ground);
        fields.List("obstacles", {.meaning = "bodies in the way"}, &obstacles,
                    [&](Fields& item, ObstacleFields* obstacle) {
                      const auto index = obstacle - obstacles.data();
                      const std::string where = "obstacles[" + std::to_string(index) + "]";
                      DeclareName(item, &obstacle->name, true, where, &obstacle_names);
                      DeclareObstacle(item, ground.Floor(), obstacle);
                      for (LevelSurface& surface : obstacle->mesh.surfaces) {
                        if (!take_name(item, surface.name, where)) break;
                        ground.surfaces.push_back(std::move(surface));
                      }
                    });
        if (!ground.has_floor && ground.said == 0 && ground.surfaces.empty()) {
          fields.Complain("floor", "none, and no surfaces (valid: surfaces, or a floor)");
        }
        fields.List("no_step", {.meaning = "areas of the floor that no sole may touch"}, &areas,
                    [&](Fields& item, NoStepFields* area) {
                      const auto index = area - areas.data();
                      DeclareName(item, &area->name, true, "no_step[" + std::to_string(index) + "]",
                                  &area_names);
                      DeclareNoStep(item, area);
                    });
        fields.Number(
            "friction", &scene.friction,
            {.meaning = "friction coefficient between soles and floor", .min = 0.01, .max = 10});
      },
      kLimits);
  if (scene.name.empty()) scene.name = path.stem().string();
  scene.files = {RecordOf(yaml_path, text)};
  scene.ground = MakeGround(ground);
  scene.files.insert(scene.files.end(), ground.files.begin(), ground.files.end());
  for (const std::string& told : ground.told) scene.warnings.push_back(yaml_path + ": " + told);
  for (ObstacleFields& from : obstacles) {
    if (from.has_mesh) scene.files.push_back(from.mesh.file);
    if (from.cloud.any()) scene.files.push_back(from.cloud.file);
    for (const std::vector<std::string>& all : {from.mesh.told, from.cloud.told}) {
      for (const std::string& told : all) {
        scene.warnings.push_back(yaml_path + ": obstacle " + from.name + ": " + told);
      }
    }
    if (from.mesh.has_levels && from.mesh.mesh.triangles.cols() == 0) continue;  // all is level
    scene.obstacles.push_back(
        {from.name, MakeShape(&from), MakePose(from.xyz, from.rpy), std::move(from.motion)});
  }
  for (NoStepFields& area : areas) {
    if (SignedArea(area.polygon) < 0.0) area.polygon = area.polygon.rowwise().reverse().eval();
    scene.no_step.push_back(std::move(area.polygon));
  }
  return scene;
}

}  // namespace halfstep
