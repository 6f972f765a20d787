#include "planner/ground/stairs.h"

namespace halfstep {

std::vector<LevelSurface> TreadsOf(const std::string& name, const Stairs& stairs, double bottom) {
  std::vector<LevelSurface> treads;
  const double aside = 0.5 * stairs.width;
  for (int k = 1; k <= stairs.count; ++k) {
    const double front = (k - 1) * stairs.run, back = k * stairs.run;
    Eigen::Matrix2Xd corners(2, 4);
    corners << front, back, back, front, -aside, -aside, aside, aside;
    treads.push_back(
        {.name = name + "_" + std::to_string(k),
         .polygon = (stairs.X_WA.rotation() * corners).colwise() + stairs.X_WA.position(),
         .height = stairs.foot + k * stairs.rise,
         .bottom = bottom});
  }
  return treads;
}

}  // namespace halfstep
