#include "wpg/robot/robot_bodies.h"

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "wpg/elementary.h"
#include "wpg/files/mesh_file.h"
#include "wpg/files/ros_package_path.h"
#include "wpg/files/text.h"
#include "wpg/geometry/convex_parts.h"
#include "wpg/geometry/simplified_hull.h"
#include "wpg/nth.h"
#include "wpg/robot/link_anchors.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace fs = std::filesystem;

constexpr std::string_view kPackage = "package://";
constexpr std::string_view kFile = "file://";

// What comes after "package://"; some files have a third slash.
std::string PathInPackages(const std::string& mesh) {
  const std::string path = mesh.substr(kPackage.size());
  return path.substr(std::min(path.find_first_not_of('/'), path.size()));
}

std::string PackageOf(const std::string& mesh) {
  if (!mesh.starts_with(kPackage)) return "";
  const std::string path = PathInPackages(mesh);
  return path.substr(0, path.find('/'));
}

// The folder of a ROS package that is not named by the robot file: one of ROS_PACKAGE_PATH, or one
// that the URDF is in, or beside; "" when there is none.
std::string FindPackage(const std::string& package, const std::string& urdf_file) {
  std::vector<fs::path> places = RosPackagePath();
  std::error_code ignored;
  fs::path above = fs::absolute(urdf_file, ignored).lexically_normal().parent_path();
  for (; above.has_relative_path(); above = above.parent_path()) places.push_back(above);
  for (const fs::path& place : places) {
    if (place.filename() == package && fs::is_directory(place, ignored)) return place.string();
    if (fs::is_directory(place / package, ignored)) return (place / package).string();
  }
  return "";
}

// A package whose folder is not known.
struct MissingPackage : std::runtime_error {
  MissingPackage(std::string name, const std::string& mesh)
      : std::runtime_error("package `" + name + "` of " + mesh +
                           " has no folder: name it under `packages` of the robot file (`halfstep "
                           "robot --package NAME=FOLDER`), or put its parent into "
                           "ROS_PACKAGE_PATH"),
        package(std::move(name)) {}
  std::string package;
};

// File of a mesh named in a URDF. Throws std::runtime_error with a sentence.
std::string MeshPath(const std::string& mesh, const std::string& urdf_file,
                     const std::map<std::string, std::string>& packages) {
  if (const std::string package = PackageOf(mesh); !package.empty()) {
    const auto given = packages.find(package);
    const std::string folder =
        given != packages.end() ? given->second : FindPackage(package, urdf_file);
    if (folder.empty()) {
      throw MissingPackage(package, mesh);
    }
    return folder + PathInPackages(mesh).substr(package.size());
  }
  if (mesh.starts_with(kFile)) return mesh.substr(kFile.size());
  if (mesh.find("://") != std::string::npos) {
    throw std::runtime_error(
        mesh +
        " is no mesh path (valid: package://…, file://…, or a path relative to "
        "the URDF)");
  }
  return (fs::path(urdf_file).parent_path() / mesh).string();
}

// Hull of the prism of 32 sides around a cylinder along z: at most 0.5 % of the radius larger.
ConvexBody PrismAround(double radius, double length) {
  constexpr int kSides = 32;
  const double outer = radius / Cos(std::numbers::pi / kSides);
  Eigen::Matrix3Xd points(3, 2 * kSides);
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    const double x = outer * Cos(angle), y = outer * Sin(angle);
    points.col(2 * i) = Vector3d(x, y, length / 2);
    points.col(2 * i + 1) = Vector3d(x, y, -length / 2);
  }
  return MakeHull(points);
}

ConvexBody Moved(const Isometry3d& X, ConvexBody body) {
  body.vertices = (X.linear() * body.vertices).colwise() + X.translation();
  body.normals = X.linear() * body.normals;
  body.center = X * body.center;
  return body;
}

// The convex bodies of a mesh in its own frame.
std::vector<ConvexBody> MeshShapes(const UrdfCollision& collision, const std::string& file,
                                   int parts, const BodyRequest& request,
                                   std::vector<InputFile>* meshes) {
  LoadedMesh mesh = LoadMesh(MeshPath(collision.mesh, file, request.packages));
  if (request.dae_up_axis) mesh.vertices = mesh.R_ZUp * mesh.vertices;
  mesh.file.name = collision.mesh;
  meshes->push_back(std::move(mesh.file));
  const Eigen::Matrix3Xd vertices = collision.scale.asDiagonal() * mesh.vertices;
  if (parts == 1) return {MakeHull(vertices)};
  return CutIntoConvexParts(vertices, mesh.triangles, parts);
}

// The convex bodies of a collision shape that X places.
std::vector<ConvexBody> ShapesOf(const UrdfCollision& collision, const Isometry3d& X,
                                 const std::string& file, int parts, const BodyRequest& request,
                                 std::vector<InputFile>* meshes) {
  switch (collision.kind) {
    case UrdfCollision::Kind::kBox:
      return {Moved(X, MakeBox(collision.size))};
    case UrdfCollision::Kind::kSphere:
      return {Moved(X, MakeSphere(collision.size.x()))};
    case UrdfCollision::Kind::kCylinder: {
      // The disc of a ConvexBody lies in its xy plane.
      const bool upright = X.linear().col(2).head<2>().norm() < 1e-12;
      return {Moved(X, upright ? MakeCylinder(collision.size.x(), collision.size.y())
                               : PrismAround(collision.size.x(), collision.size.y()))};
    }
    case UrdfCollision::Kind::kMesh:
      break;
  }
  std::vector<ConvexBody> shapes = MeshShapes(collision, file, parts, request, meshes);
  for (ConvexBody& shape : shapes) shape = Moved(X, std::move(shape));
  return shapes;
}

// Calls `read`, which reads a shape of the body, and complains about what it throws; about a
// package once.
template <typename Read>
void ReadShape(const UrdfTree& urdf, const UrdfCollision& collision, const std::string& body,
               std::set<std::string>* missing, Complaints* complaints, const Read& read) {
  const auto complain = [&](const std::string& line) {
    complaints->Add(urdf.file, collision.place.line, collision.place.column, body, line);
  };
  try {
    read();
  } catch (const InputError& error) {
    for (const std::string& line : error.complaints()) complain(line);
  } catch (const MissingPackage& error) {
    if (missing->insert(error.package).second) complain(error.what());
  } catch (const std::runtime_error& error) {
    complain(error.what());
  }
}

// A hull with many vertices becomes one around it with fewer. A foot's stays on the floor.
void Simplify(const BodyRequest& request, RobotBody* body) {
  Eigen::Matrix3Xd kept(3, 0);
  if (body->leg >= 0 && body->link == 5) {
    const Eigen::Matrix3d& R = Nth(request.R_FootSole, body->leg);
    kept.resize(3, 6);
    kept << R, -R;
  }
  const auto vertices = static_cast<int>(body->shape.vertices.cols());
  SimplifiedHull simplified = SimplifyOutward(body->shape, request.hull_vertices, kept);
  if (simplified.body.vertices.cols() == vertices) return;
  body->mesh_vertices = vertices;
  body->shape = std::move(simplified.body);
  body->excess = simplified.excess;
}

}  // namespace

std::vector<std::string> MeshPackages(const UrdfTree& urdf) {
  std::set<std::string> names;
  for (const UrdfLink& link : urdf.links) {
    for (const UrdfCollision& collision : link.collisions) {
      if (const std::string name = PackageOf(collision.mesh); !name.empty()) names.insert(name);
    }
  }
  return {names.begin(), names.end()};
}

std::vector<ConvexBody> LinkShapes(const UrdfTree& urdf, int link,
                                   const std::map<std::string, std::string>& packages,
                                   bool dae_up_axis, Complaints* complaints) {
  BodyRequest request;
  request.packages = packages;
  request.dae_up_axis = dae_up_axis;
  std::vector<ConvexBody> all;
  std::vector<InputFile> meshes;
  std::set<std::string> missing;
  const UrdfLink& of = Nth(urdf.links, link);
  for (const UrdfCollision& collision : of.collisions) {
    ReadShape(urdf, collision, of.name, &missing, complaints, [&] {
      for (ConvexBody& shape :
           ShapesOf(collision, collision.X_LinkShape, urdf.file, 1, request, &meshes)) {
        all.push_back(std::move(shape));
      }
    });
  }
  return all;
}

LinkBodies BuildBodies(const UrdfTree& urdf, const BodyRequest& request, Complaints* complaints) {
  const std::vector<LinkAnchor> anchors =
      FindAnchors(urdf, request.waist, request.leg_joints, request.posture);
  LinkBodies all;
  std::set<std::string> missing;  // packages
  for (size_t i = 0; i < urdf.links.size(); ++i) {
    const UrdfLink& link = urdf.links[i];
    const LinkAnchor& anchor = anchors[i];
    const auto parts = request.mesh_parts.find(link.name);
    int count = 0;  // of the link's bodies
    for (const UrdfCollision& collision : link.collisions) {
      const auto next_name = [&] {
        return link.name + (count == 0 ? "" : "#" + std::to_string(count + 1));
      };
      RobotBody body{.name = next_name(), .leg = anchor.leg, .link = anchor.link};
      ReadShape(urdf, collision, body.name, &missing, complaints, [&] {
        for (ConvexBody& shape : ShapesOf(
                 collision, anchor.X_AnchorLink * collision.X_LinkShape, urdf.file,
                 parts == request.mesh_parts.end() ? 1 : parts->second, request, &all.meshes)) {
          body = {.name = next_name(), .leg = anchor.leg, .link = anchor.link};
          body.shape = std::move(shape);
          const double reach = body.shape.center.norm() + body.shape.radius;
          if (reach > request.farthest) {
            throw std::runtime_error(
                Formatted("reaches %.4g m from its link, farther than a robot of this size does "
                          "(valid: at most %.3g m; look at `scale`)",
                          reach, request.farthest));
          }
          if (collision.kind == UrdfCollision::Kind::kMesh) Simplify(request, &body);
          MapDirections(&body.shape);
          all.bodies.push_back(body);
          all.links.push_back(static_cast<int>(i));
          ++count;
        }
      });
    }
  }
  return all;
}

}  // namespace halfstep
