#include "planner/search/step_set.h"

#include <cmath>

#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep {

Foothold StepSet::Placement(int i, Side support) const {
  const Foothold& X_SF = Nth(placements, i);
  return support == Side::kLeft ? X_SF : X_SF.Mirrored();
}

HalfStep StepSet::Down(int i, Side support) const {
  HalfStep down = prototype;
  down.support = support;
  down.kind = HalfStepKind::kDown;
  down.X_SF = Placement(i, support);
  return down;
}

HalfStep StepSet::Up(int i, Side support) const {
  HalfStep up = prototype;
  up.support = Opposite(support);
  up.kind = HalfStepKind::kUp;
  up.X_SF = Placement(i, support).Inverse();
  return up;
}

StepSet MakeStepSet(const StepGrid& grid, const HalfStep& prototype,
                    const std::function<bool(const HalfStep&)>& keeps,
                    const std::function<bool(double)>& progress) {
  HALFSTEP_CHECK(grid.spacing > 0.0 && grid.x_min <= grid.x_max && grid.y_min <= grid.y_max,
                 "spacing = " << grid.spacing);
  const auto count = [&grid](double from, double to) {
    return static_cast<int>(std::floor((to - from) / grid.spacing + 1e-9)) + 1;
  };
  const int nx = count(grid.x_min, grid.x_max), ny = count(grid.y_min, grid.y_max);
  StepSet set{.prototype = prototype, .placements = {}};
  for (int ix = 0; ix < nx; ++ix) {
    for (int iy = 0; iy < ny; ++iy) {
      for (double yaw : grid.yaws) {
        set.placements.push_back(
            Foothold::Level({grid.x_min + ix * grid.spacing, grid.y_min + iy * grid.spacing, yaw}));
        const int last = set.size() - 1;
        if (!keeps(set.Down(last, Side::kLeft)) || !keeps(set.Up(last, Side::kLeft))) {
          set.placements.pop_back();
        }
      }
    }
    if (progress && !progress((ix + 1.0) / nx)) return {.prototype = prototype, .placements = {}};
  }
  return set;
}

}  // namespace halfstep
