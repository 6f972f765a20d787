#pragma once

#include <string>
#include <vector>

#include "planner/ground/level_surface.h"
#include "wpg/files/grey_image.h"
#include "wpg/geometry/pose2.h"

namespace halfstep {

/// How a grey image is a map of heights.
struct HeightmapScale {
  Pose2 X_WM;                      ///< its middle in W; x to the right of the image, y up in it
  double cell = 0.0;               ///< edge of a pixel [m] > 0
  double unit = 0.0;               ///< height of one grey value [m] > 0
  double level_tolerance = 0.005;  ///< heights of one level differ by no more [m] ≥ 0
};

/// The surfaces of a map of heights, or why there are none.
struct HeightmapSurfaces {
  std::vector<LevelSurface> surfaces;  ///< NAME_1, NAME_2 … where `refused` is ""
  std::string refused;                 ///< a sentence with what is valid
  std::string told;                    ///< for the user: what became of the cells
};

/// Makes prisms from `bottom` [m] up of the cells of a map; with a floor at z = 0, cells up to the
/// tolerance are floor. Levels are found from the heights alone: the band of heights, as wide as
/// the tolerance, that has most cells is a level, then that of the rest which has most, as long as
/// it has 100 cm². A level is as high as its highest cell, so gaps of up to the tolerance below its
/// other cells are taken for solid. What is in no band is solid up to its own height, and nothing
/// may stand there. Cells of one height and level that form rectangles are one prism.
HeightmapSurfaces SurfacesOf(const std::string& name, const GreyImage& image,
                             const HeightmapScale& scale, bool has_floor, double bottom);

}  // namespace halfstep
