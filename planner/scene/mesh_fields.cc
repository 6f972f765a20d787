#include "planner/scene/mesh_fields.h"

#include <filesystem>
#include <stdexcept>
#include <utility>

#include "wpg/files/input_error.h"
#include "wpg/files/mesh_file.h"
#include "wpg/files/text.h"
#include "wpg/geometry/simplified_hull.h"

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
                  "surrounds is room",
       .choices = {"none", "in_mesh"}});
  fields.Number("floor_tolerance_m", &mesh->floor_tolerance,
                {.meaning = "how high above z = 0 the floor of `floor: in_mesh` may reach",
                 .unit = "m",
                 .min = 0.0,
                 .max = kMostFloorTolerance});
  fields.Text("dae_up_axis", &dae_up_axis,
              {.meaning = "applied: a mesh in DAE is turned so that its `up_axis` becomes z",
               .choices = {"ignored", "applied"}});
  mesh->brings_floor = floor == "in_mesh";
  if (mesh->brings_floor && hull_vertices != 0) {
    fields.Complain("floor", "in_mesh beside hull_vertices (valid: one of them)");
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

void TakeFloor(Fields& obstacle, const Eigen::Isometry3d& X_WO, double floor, bool rests,
               MeshFields* mesh) {
  if (!mesh->brings_floor || mesh->mesh.triangles.cols() == 0) return;
  if (!rests) {
    obstacle.Complain("mesh",
                      "brings the floor along and moves (valid: `floor: in_mesh` of a mesh "
                      "without motion)");
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
