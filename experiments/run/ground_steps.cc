#include "experiments/run/ground_steps.h"

#include <cmath>
#include <vector>

#include "experiments/run/isolated_step.h"
#include "planner/scene/scene.h"
#include "smoothing/proof/sampled_feasibility.h"

namespace halfstep {

std::vector<Foothold> PlacesOf(const StepGrid& grid) {
  constexpr int kAlong = 4, kAcross = 2;  // so much denser without a turn
  const auto count = [](double from, double to, double spacing) {
    return static_cast<int>(std::floor((to - from) / spacing + 1e-9)) + 1;
  };
  std::vector<Foothold> places;
  for (const double yaw : grid.yaws) {
    const double dx = yaw == 0.0 ? grid.spacing / kAlong : grid.spacing;
    const double dy = yaw == 0.0 ? grid.spacing / kAcross : grid.spacing;
    for (int ix = 0; ix < count(grid.x_min, grid.x_max, dx); ++ix) {
      for (int iy = 0; iy < count(grid.y_min, grid.y_max, dy); ++iy) {
        places.push_back(Foothold::Level({grid.x_min + ix * dx, grid.y_min + iy * dy, yaw}));
      }
    }
  }
  return places;
}

StepSet StepsByGround(const RobotModel& robot, const ExperimentConfig& config) {
  const MarginEvaluator evaluator(robot, Scene{}, config.smoothing.limits);
  const SampledFeasibility test(evaluator, 0.125 * config.half_step.duration);
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  StepSet set{.prototype = PrototypeOf(config), .placements = {}, .on_levels = true};
  const auto model = MotionModelOf(robot, set.prototype.shape);
  for (const Foothold& place : PlacesOf(config.step_set)) {
    set.placements.push_back(place);
    const int last = set.size() - 1;
    if (!AcceptsHalfStep(test, set.Down(last, Side::kLeft), {}, model, &scratch) ||
        !AcceptsHalfStep(test, set.Up(last, Side::kLeft), {}, model, &scratch)) {
      set.placements.pop_back();
    }
  }
  return set;
}

}  // namespace halfstep
