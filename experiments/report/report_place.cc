#include "experiments/report/report_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "experiments/report/drawn_mesh.h"
#include "experiments/report/drawn_rods.h"
#include "planner/scene/solid_body.h"
#include "wpg/files/number_text.h"
#include "wpg/nth.h"
#include "wpg/robot/robot_legs.h"

namespace halfstep {
namespace {

using nlohmann::json;

constexpr double kDecimals = 1e4;      // of metres
constexpr int kMostTriangles = 20000;  // of all meshes of a scene
constexpr size_t kMostObstacles = 2000;

json Vector(const Eigen::Vector3d& v) {
  return {Shortened(v.x(), 12), Shortened(v.y(), 12), Shortened(v.z(), 12)};
}

// A leg's joints, its sole at q = 0 as the rows of a 3×4 matrix, and what its reach goes by: null
// where its hip or ankle axes do not meet.
json LegJson(const Leg& leg) {
  json joints = json::array(), sole = json::array();
  for (const LegJoint& joint : leg.joints) {
    joints.push_back({{"name", joint.name},
                      {"axis", Vector(joint.axis_B)},
                      {"point", Vector(joint.point_B)},
                      {"lower", Shortened(joint.lower)},
                      {"upper", Shortened(joint.upper)},
                      {"speed", Shortened(joint.max_speed)}});
  }
  const auto matrix = leg.X_BSole.matrix();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) sole.push_back(Shortened(matrix(row, column), 12));
  }
  json made = {{"joints", std::move(joints)}, {"sole", std::move(sole)}, {"reach", nullptr}};
  for (const double q : leg.standing_q) made["standing"].push_back(Shortened(q, 12));
  if (leg.closed_form()) {
    made["reach"] = {{"hip", Vector(leg.hip_B)},
                     {"ankle", Vector(leg.ankle_B)},
                     {"length", Shortened(StretchedLength(leg), 12)}};
  }
  return made;
}

// Coordinates as integers of 0.1 mm: x, y, z of each vertex in a row.
json MeshJson(const TriangleMesh& mesh, const Eigen::Isometry3d& X) {
  json vertices = json::array(), triangles = json::array();
  for (const auto& vertex : mesh.vertices.colwise()) {
    const Eigen::Vector3d p = X * vertex;
    for (int k = 0; k < 3; ++k) vertices.push_back(std::lround(p[k] * kDecimals));
  }
  for (const auto& triangle : mesh.triangles.colwise()) {
    for (int k = 0; k < 3; ++k) triangles.push_back(triangle[k]);
  }
  return {{"vertices", std::move(vertices)}, {"triangles", std::move(triangles)}};
}

// [t, x, y, z, yaw] at t = 0 and at each waypoint; straight and steady between them.
json PlacesJson(const Obstacle& obstacle) {
  json places = json::array();
  const auto add = [&places](double t, const Eigen::Vector3d& p, double yaw) {
    places.push_back({Shortened(t, 8), Shortened(p.x(), 8), Shortened(p.y(), 8),
                      Shortened(p.z(), 8), Shortened(yaw, 8)});
  };
  add(0.0, obstacle.X_WO.translation(), 0.0);
  for (const ObstacleMotion::Waypoint& waypoint : obstacle.motion.waypoints) {
    add(waypoint.t, waypoint.translation, waypoint.yaw);
  }
  return places;
}

}  // namespace

json RobotJson(const RobotModel& robot) {
  json legs = json::array(), bodies = json::array();
  for (const Leg& leg : robot.legs) legs.push_back(LegJson(leg));
  for (const RobotBody& body : robot.bodies) {
    Eigen::Isometry3d X_BBody = Eigen::Isometry3d::Identity();
    if (body.leg >= 0) {
      const Leg& leg = Nth(robot.legs, body.leg);
      X_BBody = Nth(leg.joints, body.link).X_BLink;
    }
    json drawn = MeshJson(DrawnMesh(body.shape), X_BBody);
    drawn["name"] = body.name;
    drawn["leg"] = body.leg;
    drawn["link"] = body.link;
    bodies.push_back(std::move(drawn));
  }
  json rods = json::array();
  for (const DrawnRod& rod : DrawnRods(robot)) {
    rods.push_back({{"leg", rod.leg},
                    {"link", rod.link},
                    {"from", Vector(rod.from_B)},
                    {"to", Vector(rod.to_B)},
                    {"radius", Shortened(rod.radius, 6)}});
  }
  return {{"name", robot.name},
          {"sole", {Shortened(robot.sole_size.x()), Shortened(robot.sole_size.y())}},
          {"legs", std::move(legs)},
          {"bodies", std::move(bodies)},
          {"rods", std::move(rods)}};
}

TriangleMesh Surface(const ConvexBody& body) { return DrawnMesh(body); }
TriangleMesh Surface(const TriangleMesh& mesh) { return mesh; }

namespace {

// In their order.
std::vector<const Obstacle*> Nearest(const std::vector<Obstacle>& obstacles,
                                     const Eigen::Vector2d& middle_W) {
  std::vector<const Obstacle*> nearest;
  for (const Obstacle& obstacle : obstacles) nearest.push_back(&obstacle);
  if (nearest.size() <= kMostObstacles) return nearest;
  const auto far = [&](const Obstacle* o) {
    return (o->X_WO.translation().head<2>() - middle_W).squaredNorm();
  };
  const auto end = nearest.begin() + kMostObstacles;
  std::nth_element(nearest.begin(), end, nearest.end(), [&](const Obstacle* a, const Obstacle* b) {
    return std::pair(far(a), a) < std::pair(far(b), b);
  });
  nearest.erase(end, nearest.end());
  std::sort(nearest.begin(), nearest.end());
  return nearest;
}

// " (3 of 5 solids drawn)" where some are left out.
std::string LeftOut(size_t drawn, size_t all, const char* what) {
  if (drawn == all) return "";
  return " (" + std::to_string(drawn) + " of " + std::to_string(all) + " " + what + " drawn)";
}

// What stands out of the floor, and whether there is a floor.
json GroundJson(const Ground& ground, const std::vector<const Obstacle*>& drawn) {
  json solids = json::array();
  for (const Obstacle* solid : drawn) {
    const TriangleMesh surface =
        std::visit([](const auto& shape) { return Surface(BodyOf(shape)); }, solid->shape);
    solids.push_back(MeshJson(surface, solid->X_WO));
  }
  return {{"floor", std::isfinite(ground.Floor())}, {"solids", std::move(solids)}};
}

}  // namespace

json SceneJson(const Scene& scene, const Eigen::Vector2d& middle_W) {
  json obstacles = json::array(), areas = json::array();
  const std::vector<const Obstacle*> drawn_ones = Nearest(scene.obstacles, middle_W);
  const auto meshes = std::count_if(drawn_ones.begin(), drawn_ones.end(), [](const Obstacle* o) {
    return std::holds_alternative<TriangleMesh>(o->shape);
  });
  const int most = kMostTriangles / std::max(1, static_cast<int>(meshes));
  for (const Obstacle* one : drawn_ones) {
    const Obstacle& obstacle = *one;
    const auto* mesh = std::get_if<TriangleMesh>(&obstacle.shape);
    const TriangleMesh surface =
        mesh != nullptr
            ? Coarsened(*mesh, most)
            : std::visit([](const auto& s) { return Surface(BodyOf(s)); }, obstacle.shape);
    const bool moves = !obstacle.motion.waypoints.empty();
    // One that moves is drawn about its frame's origin, which is then put where it is.
    Eigen::Isometry3d X = obstacle.X_WO;
    if (moves) X.translation().setZero();
    json drawn = MeshJson(surface, X);
    drawn["name"] = obstacle.name;
    if (moves) drawn["places"] = PlacesJson(obstacle);
    obstacles.push_back(std::move(drawn));
  }
  for (const Eigen::Matrix2Xd& polygon : scene.no_step) {
    json corners = json::array();
    for (const auto& corner : polygon.colwise()) {
      corners.push_back({Shortened(corner.x(), 6), Shortened(corner.y(), 6)});
    }
    areas.push_back(std::move(corners));
  }
  std::vector<Obstacle> solids;
  for (const GroundSolid& solid : scene.ground->Solids()) solids.push_back(BodyOf(solid));
  const std::vector<const Obstacle*> drawn_solids = Nearest(solids, middle_W);
  json made = {
      {"name", scene.name + LeftOut(drawn_ones.size(), scene.obstacles.size(), "obstacles") +
                   LeftOut(drawn_solids.size(), solids.size(), "solids of the ground")},
      {"obstacles", std::move(obstacles)},
      {"no_step", std::move(areas)}};
  // The plane z = 0 says nothing.
  if (!solids.empty()) made["ground"] = GroundJson(*scene.ground, drawn_solids);
  return made;
}

json ShapesJson(Scene scene) {
  for (Obstacle& obstacle : scene.obstacles) {
    obstacle.X_WO.setIdentity();
    obstacle.motion.waypoints.clear();
  }
  return SceneJson(scene);
}

}  // namespace halfstep
