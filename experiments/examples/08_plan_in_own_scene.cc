// 08: footsteps to a goal among obstacles that the program makes.
#include <halfstep/experiments/halfstep.h>

#include <cstdio>

using namespace halfstep;

int main() {
  ExperimentConfig config = LoadConfig((DataFolder() / "configs/plan_bar_8cm.yaml").string(),
                                       {{"planner.name", "astar"},
                                        {"planner.unimproved_nodes", "0"},
                                        {"half_step_set.x_m", "[0, 0.2]"},
                                        {"half_step_set.yaw_deg", "[0]"},
                                        {"smoothing.margins.zmp_m", "0.01"}});
  Place place = LoadPlace(config);
  place.scene.obstacles = {{.name = "plank", .shape = Box{.size = {0.05, 2.0, 0.05}}}};
  place.scene.obstacles.front().X_WO.translation() << 0.55, 0.0, 0.025;

  const PlannedWalk walk = PlanWalk(config, place, {});
  std::printf("%s\n", walk.plan.sentence.c_str());
  for (const Footstep& step : walk.plan.footsteps) {
    std::printf("%-5s %6.3f %6.3f\n", step.side == Side::kLeft ? "left" : "right", step.X_WF.x,
                step.X_WF.y);
  }
  return walk.plan.footsteps.empty() ? 1 : 0;
}
