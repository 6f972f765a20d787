#include "planner/scene/scene.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "planner/scene/motion_fields.h"
#include "planner/scene/simple_polygon.h"
#include "wpg/files/input_error.h"
#include "wpg/files/mesh_file.h"
#include "wpg/files/text.h"
#include "wpg/files/yaml_fields.h"
#include "wpg/geometry/simplified_hull.h"

namespace halfstep {
namespace {

// Of a mesh's points from the world's origin [m]: a town fits. Doubles there are 2e-12 m apart, and
// what is taken off distances for rounding, 1e-12 of the coordinates, is 1e-8 m.
constexpr double kFarthestPoint = 10e3;
constexpr double kSmallest = 1e-6;      // of any size [m]
constexpr size_t kMostVertices = 1000;  // of a polygon
// 100,000 obstacles: a box that stands turned takes about 22 values and 110 bytes.
constexpr YamlLimits kLimits{.bytes = std::size_t{16} << 20, .values = 2'500'000};

NumberSpec Size(const char* meaning) {
  return {
      .meaning = meaning, .unit = "m", .min = kSmallest, .max = kFarthestPlace, .required = true};
}

// What the text says of an obstacle; exactly one of the shapes is present.
struct ObstacleFields {
  std::string name;
  bool has_box = false, has_cylinder = false, has_sphere = false, has_capsule = false,
       has_mesh = false;
  std::vector<double> size;
  double radius = 0.0;
  double length = 0.0;
  TriangleMesh mesh;
  InputFile mesh_file;
  std::optional<ConvexBody> hull;  // in place of the mesh
  std::string told;                // of the hull
  std::vector<double> xyz{0.0, 0.0, 0.0};
  std::vector<double> rpy{0.0, 0.0, 0.0};
  ObstacleMotion motion;
};

struct NoStepFields {
  std::string name;
  Eigen::Matrix2Xd polygon;
};

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
  const auto [first, is_new] = taken->emplace(*name, item);
  if (!is_new) fields.Complain("name", Quote(*name) + " is the name of " + first->second + " too");
}

// The hull of the mesh, or one around it with fewer vertices.
void TakeHull(Fields& fields, int vertices, ObstacleFields* obstacle) {
  if (vertices < kFewestHullVertices) {
    fields.Complain("hull_vertices", std::to_string(vertices) +
                                         " are too few (valid: 0, or at least " +
                                         std::to_string(kFewestHullVertices) + ")");
    return;
  }
  try {
    const ConvexBody hull = MakeHull(obstacle->mesh.vertices);
    SimplifiedHull simplified = SimplifyOutward(hull, vertices);
    if (simplified.body.vertices.cols() < hull.vertices.cols()) {
      obstacle->told = Formatted(
          "the hull of the mesh has %d vertices; a simpler one around it, with %d, is at most %.2g "
          "mm larger",
          static_cast<int>(hull.vertices.cols()), static_cast<int>(simplified.body.vertices.cols()),
          1e3 * simplified.excess);
    }
    obstacle->hull = std::move(simplified.body);
  } catch (const std::runtime_error& error) {
    fields.Complain("hull_vertices", error.what());
  }
}

void DeclareMesh(Fields& fields, ObstacleFields* obstacle) {
  std::string file;
  double scale = 1.0;
  int hull_vertices = 0;
  fields.Text("file", &file, {.meaning = "STL or OBJ file, beside the scene", .required = true});
  fields.Number("scale", &scale,
                {.meaning = "metres per unit of the file", .min = 1e-6, .max = 1e6});
  fields.Integer("hull_vertices", &hull_vertices,
                 {.meaning = "not 0: in place of the triangles their convex hull, or a hull around "
                             "that with at most so many vertices",
                  .min = 0,
                  .max = 1e6});
  if (file.empty()) {
    fields.Complain("file", "no file name (valid: an STL or OBJ file)");
    return;
  }
  try {
    const std::filesystem::path path = std::filesystem::path(fields.directory()) / file;
    LoadedMesh loaded = LoadMesh(path.string());
    obstacle->mesh = {scale * loaded.vertices, std::move(loaded.triangles)};
    obstacle->mesh_file = std::move(loaded.file);
    obstacle->mesh_file.name = file;
    if (hull_vertices != 0) TakeHull(fields, hull_vertices, obstacle);
  } catch (const InputError& error) {
    for (const std::string& complaint : error.complaints()) fields.Complain("file", complaint);
  }
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
                       [&](Fields& mesh) { DeclareMesh(mesh, obstacle); });
  const int shapes = obstacle->has_box + obstacle->has_cylinder + obstacle->has_sphere +
                     obstacle->has_capsule + obstacle->has_mesh;
  if (shapes != 1) {
    std::string what = std::to_string(shapes);
    what += " shapes (valid: exactly one of box, cylinder, sphere, capsule, mesh)";
    fields.Complain("", what);
  }
}

// X_WO of a position and turns about the fixed axes: R = Rz·Ry·Rx.
Eigen::Isometry3d MakePose(const std::vector<double>& xyz, const std::vector<double>& rpy) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = (Eigen::AngleAxisd(rpy[2], Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(rpy[1], Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(rpy[0], Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
  X.translation() = Eigen::Vector3d(xyz[0], xyz[1], xyz[2]);
  return X;
}

// Complains about a mesh that reaches too far, scaled and posed.
void CheckReach(Fields& fields, const ObstacleFields& obstacle) {
  if (obstacle.mesh.vertices.cols() == 0) return;
  const Eigen::Isometry3d X_WO = MakePose(obstacle.xyz, obstacle.rpy);
  const Eigen::Matrix3Xd points_W =
      (X_WO.linear() * obstacle.mesh.vertices).colwise() + X_WO.translation();
  double farthest = points_W.colwise().norm().maxCoeff();
  const double radius = obstacle.mesh.vertices.colwise().norm().maxCoeff();
  for (const ObstacleMotion::Waypoint& waypoint : obstacle.motion.waypoints) {
    farthest = std::max(farthest, waypoint.translation.norm() + radius);
  }
  if (farthest <= kFarthestPoint) return;
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", farthest);
  fields.Complain("mesh", std::string("reaches ") + text +
                              " m from the world's origin (valid: at most 10000 m; look at "
                              "`scale`, and for stray vertices)");
}

void DeclareObstacle(Fields& fields, ObstacleFields* obstacle) {
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
  CheckReach(fields, *obstacle);
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
  if (from->hull) return *std::move(from->hull);
  return std::move(from->mesh);
}

}  // namespace

double Obstacle::speed() const {
  const double by_waypoints =
      motion.waypoints.empty() ? 0.0 : motion.WaypointSpeed(X_WO, RadiusAboutOrigin(shape));
  return by_waypoints + motion.speed;
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
  std::map<std::string, std::string> obstacle_names, area_names;
  ReadYamlText(
      text, yaml_path, path.parent_path().string(), {},
      [&](Fields& fields) {
        DeclareName(fields, &scene.name, false, "", nullptr);
        fields.List("obstacles", {.meaning = "bodies in the way"}, &obstacles,
                    [&](Fields& item, ObstacleFields* obstacle) {
                      const auto index = obstacle - obstacles.data();
                      DeclareName(item, &obstacle->name, true,
                                  "obstacles[" + std::to_string(index) + "]", &obstacle_names);
                      DeclareObstacle(item, obstacle);
                    });
        fields.List("no_step", {.meaning = "areas of the floor that no sole may touch"}, &areas,
                    [&](Fields& item, NoStepFields* area) {
                      const auto index = area - areas.data();
                      DeclareName(item, &area->name, true, "no_step[" + std::to_string(index) + "]",
                                  &area_names);
                      DeclareNoStep(item, area);
                    });
      },
      kLimits);
  if (scene.name.empty()) scene.name = path.stem().string();
  scene.files = {RecordOf(yaml_path, text)};
  for (ObstacleFields& from : obstacles) {
    if (from.has_mesh) scene.files.push_back(from.mesh_file);
    if (!from.told.empty()) {
      scene.warnings.push_back(yaml_path + ": obstacle " + from.name + ": " + from.told);
    }
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
