#include "experiments/replay/episode_physics.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "experiments/replay/planned_row.h"
#include "experiments/replay/robot_physics.h"
#include "experiments/replay/simulated_obstacles.h"
#include "planner/scene/no_step_areas.h"
#include "wpg/nth.h"

namespace halfstep::replay {
namespace {

// The tick before, this one, and two to come.
constexpr int kFirstRow = -1, kLastRow = 2;

}  // namespace

ReferenceMotion EpisodePhysics::MotionAbout(const SuperposedWalk& walk, double begin) const {
  std::vector<TrajectoryRow> rows;
  for (int i = kFirstRow; i <= kLastRow; ++i) {
    const double t = begin + i * options_.row_period;
    rows.push_back(PlannedRow(robot_.model, walk, t));
  }
  return ReferenceMotion(std::move(rows));
}

EpisodePhysics::EpisodePhysics(const WholeRobot& robot, const TrueWorld& truth,
                               const LiveOptions& options, const std::optional<ModelOptions>& model)
    : robot_(robot),
      truth_(truth.SeenFrom([](double) { return Pose2(); })),
      options_(PlayOptionsOf(robot.model)),
      model_(model.value_or(PhysicsOf(robot.model))) {
  options_.row_period = options.period;
  options_.drift_window = options.horizon;
  // A period is a whole number of time steps.
  model_.timestep = options.period / std::ceil(options.period / model_.timestep - 1e-9);
}

void EpisodePhysics::Begin(const ReferenceMotion& motion, double waited) {
  since_ = truth_.Since(waited);
  const std::vector<SimulatedObstacle> obstacles = ObstaclesOf(*since_).obstacles;
  const auto& [model, tree] = robot_;
  const Simulation simulation(MujocoModel(model, tree, model_, obstacles), model,
                              Nth(tree.urdf.links, tree.waist).name, obstacles);
  player_.emplace(simulation, motion, options_);
  worlds_ = {Pose2()};
}

void EpisodePhysics::Play(const EpisodeTick& tick) {
  if (fallen()) return;
  const SuperposedWalk walk = tick.executor.executed();
  if (!player_) Begin(MotionAbout(walk, tick.now), tick.record.waited);
  PlayPeriod(walk, tick.now);
}

void EpisodePhysics::PlayPeriod(const SuperposedWalk& walk, double begin) {
  const ReferenceMotion motion = MotionAbout(walk, begin);
  const ReplayRow& row = rows_.emplace_back(player_->Advance(motion, std::nullopt));
  worlds_.push_back(worlds_.back());
  if (!row.support) return;
  const Eigen::Vector4d sole =
      Nth(motion.RowAt(row.t - options_.row_period / 2).soles, *row.support);
  const Pose2 X_WS{sole[0], sole[1], sole[3]};
  const Pose2 X_US{sole[0] + row.support_drift[0], sole[1] + row.support_drift[1],
                   sole[3] + row.support_drift[2]};
  worlds_.back() = X_WS * X_US.Inverse();
  no_step_ = std::min(no_step_, NoStepAt(row.t, X_US));
}

double EpisodePhysics::NoStepAt(double t, const Pose2& X_US) const {
  double least = std::numeric_limits<double>::infinity();
  const Scene& all = since_->scene();
  for (size_t i = 0; i < all.no_step.size(); ++i) {
    if (!since_->AreaIsThere(i, t)) continue;
    Scene scene;
    scene.no_step = {all.no_step[i]};
    const NoStepAreas area(scene, robot_.model.sole_outline);
    least = std::min(least, area.NearestTo(X_US).distance);
  }
  return least;
}

Pose2 EpisodePhysics::WorldAt(double t) const {
  if (worlds_.empty()) return {};
  const double tick = std::floor(std::max(0.0, t) / options_.row_period + 1e-6);
  return worlds_[std::min(static_cast<size_t>(tick), worlds_.size() - 1)];
}

TrueWorld EpisodePhysics::SeenByRobot() const {
  return truth_.SeenFrom([this](double t) { return WorldAt(t); });
}

PhysicalOutcome EpisodePhysics::Finish(const Episode& episode) {
  const SimulatedObstacles all = ObstaclesOf(truth_);
  PhysicalOutcome outcome;
  outcome.notes = all.notes;
  outcome.replayed.method = "physics";
  outcome.replayed.window = options_.drift_window;
  for (const RobotBody& body : robot_.model.bodies) outcome.replayed.bodies.push_back(body.name);
  for (const SimulatedObstacle& obstacle : all.obstacles) {
    outcome.replayed.obstacles.push_back(obstacle.name);
  }
  if (!player_) return outcome;
  const SuperposedWalk walk = episode.Executed();
  const bool rests = walk.duration() <= episode.end;
  const long periods = std::lround(options_.hold / options_.row_period);
  for (long i = 0; rests && i < periods && !fallen(); ++i) PlayPeriod(walk, player_->time());
  const GoalRegion goal = since_->GoalAt(episode.end);
  std::array<Foothold, 2> feet;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Eigen::Isometry3d X_WSole = player_->robot().X_WSole(side);
    Nth(feet, Index(side)) = {OnFloor(X_WSole), X_WSole.translation().z()};
  }
  outcome.no_step = no_step_;
  outcome.in_goal = rests && !fallen() && goal.ContainsStance(feet);
  const Eigen::Vector2d seen = worlds_.back() * goal.X_WG.position();
  outcome.goal_off = (seen - episode.worlds.back().goal.X_WG.position()).norm();
  const ReferenceMotion motion = Executed(walk, std::min(walk.duration(), episode.end));
  outcome.replayed.duration = motion.end();
  ReplayResult& result = outcome.replayed.result;
  result = ResultOf(std::move(rows_), player_->touches(), motion.end(), player_->robot().weight(),
                    options_);
  result.drift = player_->DriftFrom(motion);
  CompareMassModel(robot_.model, robot_.tree, motion, &result);
  return outcome;
}

ReferenceMotion EpisodePhysics::Executed(const SuperposedWalk& walk, double end) const {
  std::vector<TrajectoryRow> rows;
  const long full = static_cast<long>(std::floor(end / options_.row_period * (1.0 - 1e-12)));
  for (long i = 0; i <= full + 1; ++i) {
    const double t = i <= full ? static_cast<double>(i) * options_.row_period : end;
    rows.push_back(PlannedRow(robot_.model, walk, t));
  }
  return ReferenceMotion(std::move(rows));
}

}  // namespace halfstep::replay
