#include "experiments/replay/play_once.h"

namespace halfstep::replay {
namespace {

std::vector<std::string> NamesOf(const auto& things) {
  std::vector<std::string> names;
  for (const auto& thing : things) names.push_back(thing.name);
  return names;
}

}  // namespace

Simulation RobotOfOnce(const ReplaySetup& setup, const ReferenceMotion& motion) {
  return setup.Robot(DrawWorld(1, setup, motion).floor);
}

Replayed PlayOnce(const ReplaySetup& setup, const std::string& method,
                  const ReferenceMotion& motion) {
  const Simulation robot = RobotOfOnce(setup, motion);
  Replayed replayed;
  replayed.method = method;
  replayed.duration = motion.end();
  replayed.window = setup.play.drift_window;
  replayed.bodies = NamesOf(setup.robot.model.bodies);
  replayed.bodies.insert(replayed.bodies.end(), {"left sole", "right sole"});
  replayed.obstacles = NamesOf(setup.obstacles);
  for (const GroundSolid& solid : setup.ground.solids) replayed.obstacles.push_back(solid.name);
  replayed.result = Play(robot, motion, setup.PlayOf(robot, motion));
  CompareMassModel(setup.robot.model, setup.robot.tree, motion, &replayed.result);
  return replayed;
}

}  // namespace halfstep::replay
