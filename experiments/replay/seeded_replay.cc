#include "experiments/replay/seeded_replay.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep::replay {
namespace {

constexpr double kFallenDrop = 0.5;  // PlayOptions::fallen_drop on uneven ground, of z_c

Simulation SimulationOf(const ReplaySetup& setup, const ModelOptions& model) {
  const auto& [robot, tree] = setup.robot;
  return {MujocoModel(robot, tree, model, setup.obstacles), robot,
          Nth(tree.urdf.links, tree.waist).name, setup.obstacles};
}

SeedReplay PlaySeed(const ReplaySetup& setup, const ReferenceMotion& motion, int seed) {
  const SeedWorld world = DrawWorld(seed, setup, motion);
  SeedReplay replay{.seed = seed, .unstable = "", .drawn = world.disturbance, .result = {}};
  const Simulation robot = setup.Robot(world.floor, world.disturbance);
  try {
    replay.result = Play(robot, motion, setup.PlayOf(robot, motion), world.disturbance.push);
  } catch (const std::runtime_error& error) {
    replay.unstable = error.what();
    replay.result.stayed_up = false;
    replay.result.largest_tilt = std::numbers::pi;
  }
  replay.result.rows.clear();
  return replay;
}

}  // namespace

Simulation ReplaySetup::Robot(const SimulatedFloor& floor) const {
  ModelOptions options = model;
  options.floor = floor;
  return SimulationOf(*this, options);
}

Simulation ReplaySetup::Robot(const SimulatedFloor& floor, const Disturbance& drawn) const {
  ModelOptions options = drawn.Applied(model);
  options.floor = floor;
  return SimulationOf(*this, options);
}

control::ControlledRobot ReplaySetup::Controlled() const {
  return {.model = robot.model, .servos = {model.stiffness, model.damping}, .ankle = model.ankle};
}

PlayOptions ReplaySetup::PlayOf(const Simulation& simulated, const ReferenceMotion& motion) const {
  PlayOptions options = play;
  if (ground.uneven()) options.fallen_drop = kFallenDrop * robot.model.com_height;
  if (measures_tube) options.gauge = std::make_shared<TubeGauge>(robot.model, motion);
  if (!control) return options;
  const std::unique_ptr<control::TrackingController> controller = control->make(Controlled());
  options.control = std::make_shared<ControlLoop>(
      std::make_shared<PlannedStates>(robot.model, motion), *controller,
      control::Sensors(control->sensors, simulated.weight()));
  return options;
}

SeedWorld DrawWorld(int seed, const ReplaySetup& setup, const ReferenceMotion& motion) {
  SeedDraws draws(seed);
  const RobotModel& robot = setup.robot.model;
  const Disturbance disturbance = DrawDisturbance(robot, motion.end(), &draws);
  SimulatedFloor floor = DrawFloor(setup.relief, motion.rows(), robot, &draws);
  floor.ground = setup.ground;
  return {disturbance, std::move(floor)};
}

std::vector<SeedReplay> PlaySeeds(const ReplaySetup& setup, const ReferenceMotion& motion,
                                  int seeds, const std::function<void(double done)>& progress,
                                  std::stop_token stop) {
  std::vector<SeedReplay> all;
  for (int seed = 1; seed <= seeds && !stop.stop_requested(); ++seed) {
    all.push_back(PlaySeed(setup, motion, seed));
    progress(static_cast<double>(seed) / seeds);
  }
  return all;
}

int Standing(const std::vector<SeedReplay>& all) {
  return static_cast<int>(
      std::ranges::count_if(all, [](const SeedReplay& one) { return one.result.stayed_up; }));
}

double MedianOf(const std::vector<SeedReplay>& all, double ReplayResult::*number) {
  HALFSTEP_CHECK(!all.empty(), "no seed was played");
  std::vector<double> values;
  for (const SeedReplay& one : all) values.push_back(one.result.*number);
  std::ranges::sort(values);
  const size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

double LargestOf(const std::vector<SeedReplay>& all, double ReplayResult::*number) {
  double largest = 0.0;
  for (const SeedReplay& one : all) largest = std::max(largest, one.result.*number);
  return largest;
}

}  // namespace halfstep::replay
