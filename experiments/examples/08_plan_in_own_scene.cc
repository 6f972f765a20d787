// 08: footsteps to a goal among obstacles that the program makes.
#include <halfstep/experiments/halfstep.h>

#include <cstdio>

using namespace halfstep;

int main() {
  // Few places to step to, so that their swept volumes are baked at once, not in half a minute.
  const ExperimentConfig config = LoadConfig((DataFolder() / "configs/plan_bar_8cm.yaml").string(),
                                             {{"planner.name", "astar"},
                                              {"planner.unimproved_nodes", "0"},
                                              {"step_set.x_min_m", "0"},
                                              {"step_set.x_max_m", "0.35"},
                                              {"step_set.y_min_m", "-0.26"},
                                              {"step_set.y_max_m", "-0.16"},
                                              {"step_set.yaws_rad", "[-0.25, 0, 0.25]"}});
  Place place = LoadPlace(config);
  place.scene.obstacles = {{.name = "plank", .shape = Box{.size = {0.02, 2.0, 0.05}}}};
  place.scene.obstacles.front().X_WO.translation() << 0.1, 0.0, 0.025;

  const PlannedWalk walk = PlanWalk(config, place, {});
  std::printf("%s\n", walk.plan.sentence.c_str());
  for (const Footstep& step : walk.plan.footsteps) {
    std::printf("%-5s %6.3f %6.3f\n", step.side == Side::kLeft ? "left" : "right", step.X_WF.x,
                step.X_WF.y);
  }
  return walk.plan.footsteps.empty() ? 1 : 0;
}
