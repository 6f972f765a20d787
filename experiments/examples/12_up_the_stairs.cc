// 12: up stairs that the program makes; heights follow from the ground.
#include <halfstep/experiments/halfstep.h>

#include <cstdio>

using namespace halfstep;

int main() {
  const ExperimentConfig config =
      LoadConfig((DataFolder() / "configs/plan_stairs_10cm.yaml").string(), {{"goal.x_m", "0.56"}});
  Place place = LoadPlace(config);
  const Stairs stairs{.X_WA = {0.14, 0, 0}, .rise = 0.1, .run = 0.28, .width = 2.0, .count = 2};
  place.scene.ground =
      std::make_shared<LevelGround>(TreadsOf("flight", stairs, 0.0), /*has_floor=*/true);

  const PlannedWalk walk = PlanWalk(config, place, {});
  std::printf("%s\n", walk.plan.sentence.c_str());
  for (const Footstep& step : walk.plan.footsteps) {
    std::printf("%-5s %6.3f %6.3f %5.2f\n", step.side == Side::kLeft ? "left" : "right",
                step.X_WF.x, step.X_WF.y, step.X_WF.height);
  }
  return walk.plan.footsteps.empty() ? 1 : 0;
}
