// Writes what the oracle drew for the project to read.
#include <cstdio>
#include <fstream>

#include "tests/oracle/plain_scene.h"

namespace halfstep::oracle {

std::string WriteScene(const PlainScene& scene, const std::string& folder) {
  const auto number = [](double x) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", x);
    return std::string(text);
  };
  const auto three = [&](const Eigen::Vector3d& v) {
    return "[" + number(v[0]) + ", " + number(v[1]) + ", " + number(v[2]) + "]";
  };
  std::string yaml = "name: drawn\nfriction: " + number(scene.friction) + "\n";
  if (!scene.obstacles.empty()) yaml += "obstacles:\n";
  for (const PlainObstacle& o : scene.obstacles) {
    yaml += "  - name: " + o.name + "\n    ";
    const std::string round =
        "{radius_m: " + number(o.size[0]) + ", length_m: " + number(o.size[1]) + "}";
    switch (o.kind) {
      case PlainObstacle::Kind::kBox:
        yaml += "box: {size_m: " + three(o.size) + "}";
        break;
      case PlainObstacle::Kind::kCylinder:
        yaml += "cylinder: " + round;
        break;
      case PlainObstacle::Kind::kCapsule:
        yaml += "capsule: " + round;
        break;
      case PlainObstacle::Kind::kSphere:
        yaml += "sphere: {radius_m: " + number(o.size[0]) + "}";
        break;
      case PlainObstacle::Kind::kPoints: {
        yaml += "points: {file: " + o.name + ".ply, radius_m: " + number(o.size[0]) + "}";
        std::ofstream ply(folder + "/" + o.name + ".ply");
        ply << "ply\nformat ascii 1.0\nelement vertex " << o.vertices.size()
            << "\nproperty double x\nproperty double y\nproperty double z\nend_header\n";
        for (const Eigen::Vector3d& v : o.vertices) {
          ply << number(v[0]) << " " << number(v[1]) << " " << number(v[2]) << "\n";
        }
        break;
      }
      case PlainObstacle::Kind::kMesh: {
        yaml += "mesh: {file: " + o.name + ".obj, scale: " + number(o.scale) + "}";
        std::ofstream obj(folder + "/" + o.name + ".obj");
        for (const Eigen::Vector3d& v : o.vertices) {
          obj << "v " << number(v[0]) << " " << number(v[1]) << " " << number(v[2]) << "\n";
        }
        for (const auto& t : o.triangles) {
          obj << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
        }
        break;
      }
    }
    yaml += "\n    pose: {xyz: " + three(o.xyz) + ", rpy_deg: " + three(o.rpy_deg) + "}\n";
    if (o.has_motion()) {
      yaml += "    motion:\n      error_m: " + number(o.error) +
              "\n      speed_m_s: " + number(o.speed) +
              "\n      measured_at_s: " + number(o.measured_at) + "\n";
      if (o.horizon >= 0) yaml += "      horizon_s: " + number(o.horizon) + "\n";
      if (!o.waypoints.empty()) yaml += "      waypoints:\n";
      for (const PlainObstacle::Waypoint& w : o.waypoints) {
        yaml += "        - {t_s: " + number(w.t) + ", xyz: " + three(w.xyz) +
                ", yaw_deg: " + number(w.yaw_deg) + "}\n";
      }
    }
  }
  if (!scene.no_step.empty()) yaml += "no_step:\n";
  for (size_t i = 0; i < scene.no_step.size(); ++i) {
    yaml += "  - name: area" + std::to_string(i) + "\n    polygon_m: [";
    for (size_t k = 0; k < scene.no_step[i].size(); ++k) {
      const Eigen::Vector2d& p = scene.no_step[i][k];
      yaml += (k == 0 ? "[" : ", [") + number(p.x()) + ", " + number(p.y()) + "]";
    }
    yaml += "]\n";
  }
  const std::string path = folder + "/scene.yaml";
  std::ofstream(path) << yaml;
  return path;
}

}  // namespace halfstep::oracle
