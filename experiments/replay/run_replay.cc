#include "experiments/replay/run_replay.h"

#include "experiments/config/experiment.h"
#include "experiments/replay/robot_physics.h"
#include "wpg/files/input_error.h"

namespace halfstep::replay {
namespace {

std::optional<WalkReplay> PlayWalk(const Experiment& experiment, const std::string& trajectory,
                                   const std::stop_token& stop) {
  const ReplayConfig& options = experiment.config.replay;
  const ReplaySetup setup = SetupOf(LoadWholeRobot(RobotPath(experiment.config).string()),
                                    ObstaclesOf(experiment.scene), options);
  const ReferenceMotion motion(ParseTrajectory("trajectory.csv", trajectory, setup.robot.model));
  const std::vector<SeedReplay> seeds = PlaySeeds(
      setup, motion, options.seeds, [](double) {}, stop);
  if (std::ssize(seeds) < options.seeds) return std::nullopt;
  return WalkReplay{.stands = Standing(seeds),
                    .seeds = options.seeds,
                    .median_tilt = MedianOf(seeds, &ReplayResult::largest_tilt)};
}

}  // namespace

WalkReplayer ReplayerOf(const ExperimentConfig& config) {
  if (!config.has_replay) return {};
  if (const std::string why = WhyNoSimulation(); !why.empty()) {
    throw InputError({"replay: " + why + " (valid: a config without `replay`)"});
  }
  if (config.replay.controller != "none") {  // before anything is searched
    const RobotModel robot = LoadRobot(RobotPath(config).string());
    if (!robot.masses.known()) {
      throw InputError(
          {"replay.controller: of " + robot.name + ", " + robot.masses.fault + " (valid: none)"});
    }
  }
  return PlayWalk;
}

ReplaySetup SetupOf(WholeRobot robot, const SimulatedObstacles& world,
                    const ReplayConfig& options) {
  ReplaySetup setup{.robot = std::move(robot),
                    .obstacles = world.obstacles,
                    .ground = world.ground,
                    .model = {},
                    .relief = {},
                    .play = {},
                    .control = {},
                    .measures_tube = false};
  setup.model = PhysicsOf(setup.robot.model, options);
  setup.play = PlayOptionsOf(setup.robot.model);
  if (options.controller != "none") {
    setup.control = {.make =
                         [name = options.controller](const control::ControlledRobot& of) {
                           return control::Controllers::Standard().Make(name, of);
                         },
                     .sensors = {}};
  }
  return setup;
}

}  // namespace halfstep::replay
