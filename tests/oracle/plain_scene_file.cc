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
  const auto polygon = [&](const Polygon& corners) {
    std::string text;
    for (const Eigen::Vector2d& p : corners) {
      text += (text.empty() ? "[" : ", [") + number(p.x()) + ", " + number(p.y()) + "]";
    }
    return "    polygon_m: [" + text + "]\n";
  };
  std::string yaml = "name: drawn\nfriction: " + number(scene.friction) + "\n";
  if (!scene.has_floor) yaml += "floor: none\n";
  if (!scene.surfaces.empty()) yaml += "surfaces:\n";
  for (const PlainSurface& s : scene.surfaces) {
    yaml += "  - name: " + s.name + "\n";
    if (!s.polygon.empty()) {
      yaml += polygon(s.polygon) + "    height_m: " + number(s.height) + "\n";
      if (s.thickness >= 0) yaml += "    thickness_m: " + number(s.thickness) + "\n";
      continue;
    }
    yaml += "    stairs: {at: {x_m: " + number(s.at.x()) + ", y_m: " + number(s.at.y()) +
            ", z_m: " + number(s.at.z()) + ", yaw_deg: " + number(s.yaw_deg) +
            "}, rise_m: " + number(s.rise) + ", run_m: " + number(s.run) +
            ", width_m: " + number(s.width) + ", count: " + std::to_string(s.count) + "}\n";
  }
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
    yaml += "  - name: area" + std::to_string(i) + "\n" + polygon(scene.no_step[i]);
  }
  const std::string path = folder + "/scene.yaml";
  std::ofstream(path) << yaml;
  return path;
}

}  // namespace halfstep::oracle
