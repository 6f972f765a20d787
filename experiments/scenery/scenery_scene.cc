#include "experiments/scenery/scenery_scene.h"

#include <cmath>
#include <numbers>
#include <set>

#include "wpg/elementary.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

constexpr double kFarthestScenery = 1000.0;  // of a place in a scene [m]

// To twelve digits, and no −0: 0.1 + 0.2 is 0.3.
std::string Place(double value) {
  return ShortestText(std::abs(value) < 1e-12 ? 0.0 : Shortened(value, 12));
}

std::string Triple(const Vector3d& v) {
  return "[" + Place(v.x()) + ", " + Place(v.y()) + ", " + Place(v.z()) + "]";
}

std::string Sizes(const Vector3d& v) {
  return "[" + ShortestText(v.x()) + ", " + ShortestText(v.y()) + ", " + ShortestText(v.z()) + "]";
}

// In single quotes as YAML has them.
std::string InQuotes(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    quoted += c;
    if (c == '\'') quoted += c;
  }
  return quoted + "'";
}

// Turns about the fixed axes x, y, z that make R [deg].
Vector3d RpyDegrees(const Eigen::Matrix3d& R) {
  const double across = Hypot(R(0, 0), R(1, 0));
  Vector3d rpy;
  rpy.y() = Atan2(-R(2, 0), across);
  if (across > 1e-9) {
    rpy.x() = Atan2(R(2, 1), R(2, 2));
    rpy.z() = Atan2(R(1, 0), R(0, 0));
  } else {  // roll and yaw turn about the same axis
    rpy.x() = Atan2(-R(1, 2), R(1, 1));
    rpy.z() = 0.0;
  }
  return 180 / std::numbers::pi * rpy;
}

class SceneMaker {
 public:
  SceneMaker(const fs::path& out, const std::vector<std::string>& head)
      : folder_(fs::absolute(out).lexically_normal().parent_path()), stem_(out.stem().string()) {
    for (const std::string& line : head) files_.text += CommentOf(line);
  }

  SceneFiles Make(const Scenery& scenery) {
    files_.text += scenery.things.empty() ? "obstacles: []\n" : "obstacles:\n";
    for (const SceneryThing& thing : scenery.things) {
      const std::string name = UniqueName(thing.name);
      const Vector3d p = thing.X_WO.translation();
      if (!(p.cwiseAbs().maxCoeff() <= kFarthestScenery)) {
        throw InputError(
            {thing.name +
             Formatted(": lies at %.4g %.4g %.4g m (valid: within 1000 m)", p.x(), p.y(), p.z())});
      }
      files_.text += "  - name: " + InQuotes(name) + "\n    ";
      files_.text +=
          std::visit([&](const auto& s) { return ShapeText(thing, name, s); }, thing.shape);
      const Vector3d rpy = RpyDegrees(thing.X_WO.linear());
      if (thing.X_WO.matrix().isIdentity(0.0)) continue;
      files_.text += "    pose: {xyz: " + Triple(p);
      if (!(rpy.cwiseAbs().maxCoeff() < 1e-10)) files_.text += ", rpy_deg: " + Triple(rpy);
      files_.text += "}\n";
    }
    return std::move(files_);
  }

 private:
  static std::string CommentOf(const std::string& line) {
    std::string comment = Printable(line);
    for (char& c : comment) c = c == '\n' || c == '\r' ? ' ' : c;
    return "# " + comment + "\n";
  }

  // A name that a scene may have, and no other obstacle has.
  std::string UniqueName(const std::string& given) {
    std::string name = Printable(given);
    for (char& c : name) c = c == '/' || c == '\n' || c == '\r' ? '_' : c;
    while (name.size() > 90) name.pop_back();
    while (FindInvalidUtf8(name) != std::string::npos) name.pop_back();
    if (name.empty() || name.front() == '.' || !NameMistake(name).empty()) name = "thing_" + name;
    int& count = names_[name];
    std::string unique = ++count == 1 ? name : name + "_" + std::to_string(count);
    while (!taken_.insert(unique).second) unique = name + "_" + std::to_string(++count);
    return unique;
  }

  std::string FileText(const fs::path& path) const {
    return InQuotes(fs::absolute(path).lexically_normal().lexically_proximate(folder_).string());
  }

  std::string ShapeText(const SceneryThing&, const std::string&, const Box& box) {
    ++files_.kinds["box"];
    return "box: {size_m: " + Sizes(box.size) + "}\n";
  }
  std::string ShapeText(const SceneryThing&, const std::string&, const Sphere& sphere) {
    ++files_.kinds["sphere"];
    return "sphere: {radius_m: " + ShortestText(sphere.radius) + "}\n";
  }
  template <typename Long>
  std::string LongText(const char* kind, const Long& shape) {
    ++files_.kinds[kind];
    return std::string(kind) + ": {radius_m: " + ShortestText(shape.radius) +
           ", length_m: " + ShortestText(shape.length) + "}\n";
  }
  std::string ShapeText(const SceneryThing&, const std::string&, const Cylinder& cylinder) {
    return LongText("cylinder", cylinder);
  }
  std::string ShapeText(const SceneryThing&, const std::string&, const Capsule& capsule) {
    return LongText("capsule", capsule);
  }
  std::string ShapeText(const SceneryThing& thing, const std::string&, const EndlessPlane&) {
    throw InputError({thing.name + ": a plane without end"});
  }

  std::string MeshText(const std::string& file, double scale, bool brings_floor) {
    ++files_.kinds["mesh"];
    return "mesh: {file: " + file + (scale == 1.0 ? "" : ", scale: " + ShortestText(scale)) +
           (brings_floor ? ", floor: in_mesh" : "") + "}\n";
  }
  std::string ShapeText(const SceneryThing& thing, const std::string&, const MeshReference& mesh) {
    return MeshText(FileText(mesh.path), mesh.scale.x(), thing.brings_floor);
  }
  std::string ShapeText(const SceneryThing& thing, const std::string& name, const OwnMesh& mesh) {
    const fs::path file = folder_ / (stem_ == name ? name + ".obj" : stem_ + "_" + name + ".obj");
    std::string& text = files_.meshes[file];
    text = "# by halfstep scene\n";
    for (const Vector3d& p : mesh.vertices.colwise()) {
      text +=
          "v " + ShortestText(p.x()) + " " + ShortestText(p.y()) + " " + ShortestText(p.z()) + "\n";
    }
    for (const Eigen::Vector3i& t : mesh.triangles.colwise()) {
      text += "f";
      for (const int corner : t) text += " " + std::to_string(corner + 1);
      text += "\n";
    }
    return MeshText(InQuotes(file.filename().string()), 1.0, thing.brings_floor);
  }
  std::string ShapeText(const SceneryThing&, const std::string&, const CloudReference& cloud) {
    ++files_.kinds[cloud.is_map ? "octomap" : "points"];
    std::string text =
        (cloud.is_map ? "octomap: {file: " : "points: {file: ") + FileText(cloud.path);
    if (!cloud.is_map) text += ", radius_m: " + ShortestText(cloud.radius);
    if (cloud.floor_below) text += ", floor_below_m: " + ShortestText(*cloud.floor_below);
    return text + "}\n";
  }

  const fs::path folder_;
  const std::string stem_;
  SceneFiles files_;
  std::map<std::string, int> names_;
  std::set<std::string> taken_;
};

}  // namespace

SceneFiles SceneFilesOf(const Scenery& scenery, const std::filesystem::path& out,
                        const std::vector<std::string>& head) {
  return SceneMaker(out, head).Make(scenery);
}

}  // namespace halfstep
