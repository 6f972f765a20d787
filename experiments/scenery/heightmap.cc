#include <algorithm>

#include "experiments/scenery/scenery_readers.h"
#include "planner/ground/equal_rectangles.h"
#include "wpg/files/grey_image.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"

namespace halfstep {

Scenery ReadHeightmap(const std::string& path, const std::string& bytes,
                      const SceneryRequest& request) {
  if (!request.cell || !request.height) {
    throw InputError({path + ": a heightmap needs --cell and --height [m]: the edge of a pixel, "
                             "and how high white is"});
  }
  const GreyImage grey = ParseGreyImage(path, bytes);
  const double cell = *request.cell, unit = *request.height / static_cast<double>(grey.white);
  const double floor = request.floor_below.value_or(0.0);
  // The least value that is higher than the floor.
  int least = 0;
  while (least <= grey.white && !(unit * least > floor)) ++least;
  Scenery scenery;
  const std::vector<CellRectangle> rectangles =
      EqualRectangles(grey.pixels, grey.width, least, kMostThings);
  if (rectangles.size() > kMostThings) {
    throw InputError({path + ": more than 100,000 boxes of one height each (valid: a smaller "
                             "or smoother map, or a larger --floor-below)"});
  }
  for (const CellRectangle& from : rectangles) {
    const auto wide = static_cast<double>(from.width), deep = static_cast<double>(from.height);
    const double height = unit * from.value;
    SceneryThing thing{.name = "height", .shape = Box{{cell * wide, cell * deep, height}}};
    thing.X_WO.translation() << cell * (static_cast<double>(from.x) + 0.5 * wide -
                                        0.5 * static_cast<double>(grey.width)),
        cell * (0.5 * static_cast<double>(grey.height) - static_cast<double>(from.y) - 0.5 * deep),
        0.5 * height;
    scenery.things.push_back(std::move(thing));
  }
  const long floor_pixels = std::ranges::count_if(grey.pixels, [&](int v) { return v < least; });
  scenery.Tell(
      Formatted("heights are boxes in the way; the floor stays flat at z = 0, and nobody "
                "steps onto what is higher: %ld of %ld pixels, up to %.3g m, are floor",
                floor_pixels, grey.width * grey.height, floor));
  return scenery;
}

}  // namespace halfstep
