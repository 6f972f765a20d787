#include "planner/scene/ground_fields.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

#include "planner/ground/heightmap.h"
#include "planner/ground/level_ground.h"
#include "planner/ground/stairs.h"
#include "planner/scene/motion_fields.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/geometry/simple_polygon.h"

namespace halfstep {
namespace {

constexpr double kLeastSize = 2e-3;       // of a rise, a run, a cell … [m]
constexpr double kLeastThickness = 1e-6;  // [m]
constexpr double kMostTurn = 360.0;       // [deg]
constexpr double kBelowAll = -0.1;        // where stairs and maps begin without a floor [m]
constexpr int kMostTreads = 1000;

// One item of `surfaces`: exactly one of the three is there.
struct SurfaceFields {
  std::string name;
  Eigen::Matrix2Xd polygon;
  double height = 0.0;
  std::optional<double> thickness;
  bool has_stairs = false, has_heightmap = false;
  Stairs stairs;
  std::string map_file;
  HeightmapScale map;
};

NumberSpec PlaceOf(const char* meaning) {
  return {.meaning = meaning, .unit = "m", .min = -kFarthestPlace, .max = kFarthestPlace};
}

// `z` may be null: then there is no such key.
void DeclarePlace(Fields& fields, const GroupSpec& spec, Pose2* X, double* z) {
  fields.Group("at", spec, [&](Fields& at) {
    at.Number("x_m", &X->x, PlaceOf("in the world"));
    at.Number("y_m", &X->y, PlaceOf("in the world"));
    if (z != nullptr) at.Number("z_m", z, PlaceOf("in the world"));
    at.Number("yaw_deg", &X->yaw,
              {.meaning = "about z", .unit = "deg", .min = -kMostTurn, .max = kMostTurn});
  });
}

NumberSpec Length(const char* meaning, double most) {
  return {.meaning = meaning, .unit = "m", .min = kLeastSize, .max = most, .required = true};
}

void DeclareStairs(Fields& fields, Stairs* stairs) {
  DeclarePlace(fields, {.meaning = "middle of the foot of the first riser; up along x"},
               &stairs->X_WA, &stairs->foot);
  fields.Number("rise_m", &stairs->rise, Length("height of each riser", 10.0));
  fields.Number("run_m", &stairs->run, Length("depth of each tread", 100.0));
  fields.Number("width_m", &stairs->width, Length("of the treads", 1000.0));
  fields.Integer("count", &stairs->count,
                 {.meaning = "how many treads", .min = 1, .max = kMostTreads, .required = true});
}

void DeclareHeightmap(Fields& fields, std::string* file, HeightmapScale* scale) {
  fields.Text("file", file,
              {.meaning = "grey PGM or PNG, beside the scene; value 0 is z = 0", .required = true});
  DeclarePlace(fields, {.meaning = "the middle of the image; its right is x, its top y"},
               &scale->X_WM, nullptr);
  fields.Number("cell_m", &scale->cell, Length("edge of a pixel", 10.0));
  fields.Number("scale_m", &scale->unit,
                {.meaning = "height of one grey value",
                 .unit = "m",
                 .min = 1e-6,
                 .max = 1.0,
                 .required = true});
  fields.Number("level_tolerance_m", &scale->level_tolerance,
                {.meaning = "how much heights of one level may differ",
                 .unit = "m",
                 .min = 0.0,
                 .max = 0.02});
}

bool Has(const Fields& fields, const char* key) {
  const std::vector<std::string> keys = fields.Keys();
  return std::ranges::find(keys, key) != keys.end();
}

void DeclareSurface(Fields& item, SurfaceFields* surface) {
  const bool has_polygon = Has(item, "polygon_m");
  item.Points(
      "polygon_m", &surface->polygon,
      {.meaning = "corners of a convex polygon in order", .min_items = 3, .max_items = 1000},
      PlaceOf("of a corner"));
  NumberSpec height = PlaceOf("z of a polygon");
  height.required = has_polygon;
  item.Number("height_m", &surface->height, height);
  item.OptionalNumber("thickness_m", &surface->thickness,
                      {.meaning = "of the solid below a polygon; none: down to the floor",
                       .unit = "m",
                       .min = kLeastThickness,
                       .max = 2.0 * kFarthestPlace});
  item.OptionalGroup("stairs", &surface->has_stairs, {.meaning = "a straight flight"},
                     [&](Fields& stairs) { DeclareStairs(stairs, &surface->stairs); });
  item.OptionalGroup(
      "heightmap", &surface->has_heightmap, {.meaning = "heights of an image's pixels"},
      [&](Fields& map) { DeclareHeightmap(map, &surface->map_file, &surface->map); });
  const int kinds = has_polygon + surface->has_stairs + surface->has_heightmap;
  if (kinds != 1) {
    item.Complain("", std::to_string(kinds) +
                          " kinds of surfaces (valid: exactly one of polygon_m, stairs, "
                          "heightmap)");
  } else if (!has_polygon && (Has(item, "height_m") || Has(item, "thickness_m"))) {
    item.Complain(Has(item, "height_m") ? "height_m" : "thickness_m",
                  "is of a polygon (valid: with polygon_m)");
  }
}

// Adds the surface of a polygon, unless there is something to complain of.
void AddPolygon(Fields& item, SurfaceFields* surface, GroundFields* ground) {
  if (surface->polygon.cols() == 0 || !Has(item, "height_m")) return;
  const double height = WholeNanometres(surface->height);
  if (ground->has_floor && !(height > 0.0)) {
    item.Complain("height_m", "is not above the floor at z = 0 (valid: above 0, or `floor: none`)");
    return;
  }
  if (!ground->has_floor && !surface->thickness) {
    item.Complain("", "there is no floor down to which it would be solid (valid: thickness_m)");
    return;
  }
  Eigen::Matrix2Xd polygon = surface->polygon;
  if (SignedArea(polygon) < 0.0) polygon = polygon.rowwise().reverse().eval();
  const std::string mistake = WhyNotConvex(CornersOf(polygon));
  if (!mistake.empty()) {
    item.Complain("polygon_m", mistake +
                                   " (valid: a convex polygon of at least 1 mm²; surfaces of "
                                   "one height that share an edge are one level)");
    return;
  }
  const double bottom = surface->thickness ? height - *surface->thickness : 0.0;
  ground->surfaces.push_back({.name = surface->name,
                              .polygon = polygon,
                              .height = height,
                              .bottom = std::max(bottom, ground->Floor())});
}

// Takes the names of what a surface became, and adds it.
void AddNamed(Fields& item, const std::string& where, std::vector<LevelSurface> made,
              const TakeName& take_name, GroundFields* ground) {
  for (LevelSurface& surface : made) {
    if (!take_name(item, surface.name, where)) return;
    ground->surfaces.push_back(std::move(surface));
  }
}

std::optional<HeightmapSurfaces> ReadMap(Fields& item, const SurfaceFields& from,
                                         GroundFields* ground) {
  if (from.map_file.empty() || from.map.cell == 0.0 || from.map.unit == 0.0) return std::nullopt;
  try {
    const auto path = std::filesystem::path(item.directory()) / from.map_file;
    const GreyImage image = LoadGreyImage(path.string());
    HeightmapSurfaces made = SurfacesOf(from.name, image, from.map, ground->has_floor,
                                        ground->has_floor ? 0.0 : kBelowAll);
    if (!made.refused.empty()) {
      item.Complain("heightmap", made.refused);
      return std::nullopt;
    }
    ground->files.push_back(image.file);
    ground->files.back().name = from.map_file;
    ground->told.push_back("surface " + from.name + ": " + made.told);
    return made;
  } catch (const InputError& error) {
    for (const std::string& complaint : error.complaints()) item.Complain("heightmap", complaint);
  }
  return std::nullopt;
}

}  // namespace

double GroundFields::Floor() const {
  return has_floor ? 0.0 : -std::numeric_limits<double>::infinity();
}

void DeclareGround(
    Fields& fields,
    const std::function<void(Fields&, const std::string& item, std::string*)>& declare_name,
    const TakeName& take_name, GroundFields* ground) {
  std::string floor = "level";
  fields.Text("floor", &floor,
              {.meaning = "level: z = 0 bears wherever no surface stands on it",
               .choices = {"level", "none"}});
  ground->has_floor = floor == "level";
  std::vector<SurfaceFields> surfaces;
  fields.List(
      "surfaces", {.meaning = "level ground at heights"}, &surfaces,
      [&](Fields& item, SurfaceFields* surface) {
        const std::string where = "surfaces[" + std::to_string(surface - surfaces.data()) + "]";
        declare_name(item, where, &surface->name);
        if (surface->name == "floor") {
          item.Complain("name", "is the floor's (valid: another name)");
        }
        DeclareSurface(item, surface);
        if (surface->has_stairs) {
          const Stairs& stairs = surface->stairs;
          if (!(stairs.rise > 0.0 && stairs.run > 0.0 && stairs.width > 0.0)) return;
          const double bottom = ground->has_floor ? 0.0 : std::min(0.0, stairs.foot) + kBelowAll;
          if (!(WholeNanometres(stairs.foot + stairs.rise) > bottom)) {
            item.Complain("stairs", "begin below the floor at z = 0 (valid: at.z_m of at least 0)");
            return;
          }
          AddNamed(item, where, TreadsOf(surface->name, stairs, bottom), take_name, ground);
        } else if (surface->has_heightmap) {
          std::optional<HeightmapSurfaces> made = ReadMap(item, *surface, ground);
          if (made) AddNamed(item, where, std::move(made->surfaces), take_name, ground);
        } else {
          AddPolygon(item, surface, ground);
        }
      });
  ground->said = surfaces.size();
}

std::shared_ptr<const Ground> MakeGround(const GroundFields& ground) {
  if (ground.surfaces.empty()) return std::make_shared<const FlatGround>();
  return std::make_shared<const LevelGround>(ground.surfaces, ground.has_floor);
}

}  // namespace halfstep
