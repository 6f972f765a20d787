#include "planner/scene/mesh_fields.h"

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "planner/ground/mesh_levels.h"
#include "wpg/files/input_error.h"
#include "wpg/files/mesh_file.h"
#include "wpg/files/text.h"
#include "wpg/geometry/simplified_hull.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr double kMostFloorTolerance = 0.02;  // [m]

// The hull of the mesh, or one around it with fewer vertices.
void TakeHull(Fields& fields, int vertices, MeshFields* mesh) {
  if (vertices < kFewestHullVertices) {
    fields.Complain("hull_vertices", std::to_string(vertices) +
                                         " are too few (valid: 0, or at least " +
                                         std::to_string(kFewestHullVertices) + ")");
    return;
  }
  try {
    const ConvexBody hull = MakeHull(mesh->mesh.vertices);
    SimplifiedHull simplified = SimplifyOutward(hull, vertices);
    if (simplified.body.vertices.cols() < hull.vertices.cols()) {
      mesh->told.push_back(Formatted(
          "the hull of the mesh has %d vertices; a simpler one around it, with %d, is at most %.2g "
          "mm larger",
          static_cast<int>(hull.vertices.cols()), static_cast<int>(simplified.body.vertices.cols()),
          1e3 * simplified.excess));
    }
    mesh->hull = std::move(simplified.body);
  } catch (const std::runtime_error& error) {
    fields.Complain("hull_vertices", error.what());
  }
}

// Some programs turn a mesh by the `up_axis` of its file, others do not: what was done is told.
void TakeUpAxis(bool applied, LoadedMesh* loaded, MeshFields* mesh) {
  if (loaded->R_ZUp.isIdentity()) return;
  if (applied) {
    loaded->vertices = loaded->R_ZUp * loaded->vertices;
    return;
  }
  const char* const up = loaded->R_ZUp.row(2).y() == 1.0 ? "y" : "x";
  mesh->told.push_back(Formatted(
      "its file calls %s up, and that turns nothing: its z is the scene's z (`mesh.dae_up_axis: "
      "applied` turns it)",
      up));
}

// The triangles of these numbers alone; only their surface is in the way.
TriangleMesh PartOf(const TriangleMesh& mesh, const std::vector<Eigen::Index>& kept) {
  TriangleMesh part{.vertices = mesh.vertices, .triangles = {}, .hollow = true};
  part.triangles.resize(3, static_cast<Eigen::Index>(kept.size()));
  for (Eigen::Index i = 0; i < part.triangles.cols(); ++i) {
    part.triangles.col(i) = mesh.triangles.col(Nth(kept, i));
  }
  return part;
}

void TakeLevels(Fields& obstacle, const std::string& name, const Eigen::Isometry3d& X_WO,
                double floor, MeshFields* mesh) {
  const Eigen::Index count = mesh->mesh.triangles.cols();
  const double tolerance = mesh->floor_tolerance;
  int of_floor = 0;
  if (std::isfinite(floor)) {
    CutMesh cut = CutFloor(mesh->mesh, X_WO, floor, tolerance);
    of_floor = cut.floor;
    mesh->mesh = std::move(cut.rest);
  }
  const Eigen::Matrix3Xd vertices_W =
      (X_WO.linear() * mesh->mesh.vertices).colwise() + X_WO.translation();
  MeshLevels levels = LevelsOf(name, vertices_W, mesh->mesh.triangles, tolerance, floor);
  if (levels.surfaces.empty()) {
    obstacle.Complain("mesh",
                      "nothing of it that faces up is level (valid: triangles counter-clockwise "
                      "from outside, 100 cm² within floor_tolerance_m; or `floor: in_mesh`)");
    return;
  }
  mesh->told.push_back(Formatted(
      "floor: levels: of %d triangles %d are floor and %d lie on %d levels of %.3g m² in all, each "
      "as high as its highest point; the other %d are in the way, what they surround is room",
      static_cast<int>(count), of_floor,
      static_cast<int>(mesh->mesh.triangles.cols()) - static_cast<int>(levels.kept.size()),
      levels.levels, levels.area, static_cast<int>(levels.kept.size())));
  mesh->mesh = PartOf(mesh->mesh, levels.kept);
  mesh->surfaces = std::move(levels.surfaces);
}

}  // namespace

void DeclareMesh(Fields& fields, MeshFields* mesh) {
  std::string file;
  double scale = 1.0;
  int hull_vertices = 0;
  std::string floor = "none", dae_up_axis = "ignored";
  fields.Text("file", &file, {.meaning = "STL or OBJ file, beside the scene", .required = true});
  fields.Number("scale", &scale,
                {.meaning = "metres per unit of the file", .min = 1e-6, .max = 1e6});
  fields.Integer("hull_vertices", &hull_vertices,
                 {.meaning = "not 0: in place of the triangles their convex hull, or a hull around "
                             "that with at most so many vertices",
                  .min = 0,
                  .max = 1e6});
  fields.Text(
      "floor", &floor,
      {.meaning = "in_mesh: what of it lies at or below the tolerance is floor, and what it "
                  "surrounds is room; levels: and what of it is level bears",
       .choices = {"none", "in_mesh", "levels"}});
  fields.Number("floor_tolerance_m", &mesh->floor_tolerance,
                {.meaning = "how high above z = 0 the floor of `floor: in_mesh` may reach, and how "
                            "much heights of one level may differ",
                 .unit = "m",
                 .min = 0.0,
                 .max = kMostFloorTolerance});
  fields.Text("dae_up_axis", &dae_up_axis,
              {.meaning = "applied: a mesh in DAE is turned so that its `up_axis` becomes z",
               .choices = {"ignored", "applied"}});
  mesh->has_levels = floor == "levels";
  mesh->brings_floor = floor != "none";
  if (mesh->brings_floor && hull_vertices != 0) {
    fields.Complain("floor", floor + " beside hull_vertices (valid: one of them)");
    return;
  }
  if (file.empty()) {
    fields.Complain("file", "no file name (valid: an STL or OBJ file)");
    return;
  }
  try {
    const std::filesystem::path path = std::filesystem::path(fields.directory()) / file;
    LoadedMesh loaded = LoadMesh(path.string());
    TakeUpAxis(dae_up_axis == "applied", &loaded, mesh);
    mesh->mesh = {scale * loaded.vertices, std::move(loaded.triangles)};
    mesh->file = std::move(loaded.file);
    mesh->file.name = file;
    if (hull_vertices != 0) TakeHull(fields, hull_vertices, mesh);
  } catch (const InputError& error) {
    for (const std::string& complaint : error.complaints()) fields.Complain("file", complaint);
  }
}

void TakeFloor(Fields& obstacle, const std::string& name, const Eigen::Isometry3d& X_WO,
               double floor, bool rests, MeshFields* mesh) {
  if (!mesh->brings_floor || mesh->mesh.triangles.cols() == 0) return;
  if (!rests) {
    obstacle.Complain("mesh", std::string("brings the floor along and moves (valid: `floor: ") +
                                  (mesh->has_levels ? "levels" : "in_mesh") +
                                  "` of a mesh without motion)");
    return;
  }
  if (mesh->has_levels) {
    TakeLevels(obstacle, name, X_WO, floor, mesh);
    return;
  }
  if (!std::isfinite(floor)) {
    obstacle.Complain("mesh",
                      "in_mesh where there is no floor (valid: `floor: levels` of the mesh)");
    return;
  }
  const double tolerance = mesh->floor_tolerance;
  CutMesh cut = CutFloor(mesh->mesh, X_WO, floor, tolerance);
  if (cut.rest.triangles.cols() == 0) {
    obstacle.Complain("mesh",
                      "nothing of it sticks out of the floor (valid: a mesh with something "
                      "above floor_tolerance_m, or no such obstacle)");
    return;
  }
  std::string told = Formatted(
      "floor: in_mesh: %d of %d triangles lie at or below z = %.3g mm and are floor (%.3g m² of it "
      "level%s); the other %d are in the way, what they surround is room",
      cut.floor, static_cast<int>(mesh->mesh.triangles.cols()), 1e3 * (floor + tolerance), cut.area,
      cut.floor == 0 ? "" : Formatted(", up to %.3g mm", 1e3 * cut.highest).c_str(),
      static_cast<int>(cut.rest.triangles.cols()));
  if (cut.deep > 0) {
    told += Formatted(
        "; %d triangles of the floor reach below −%.3g mm: where that is a hole, name it in "
        "no_step",
        cut.deep, 1e3 * tolerance);
  }
  mesh->told.push_back(std::move(told));
  mesh->mesh = std::move(cut.rest);
}

}  // namespace halfstep
