#include "experiments/replay/episode_physics.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "experiments/control/controller_lost.h"
#include "experiments/replay/planned_row.h"
#include "experiments/replay/simulated_obstacles.h"
#include "planner/ground/flat_floor.h"
#include "planner/scene/no_step_areas.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep::replay {
namespace {

const RobotModel& ModelOf(const EpisodeRobot& robot) { return robot.setup.robot.model; }

// The push that acts in the period that begins then.
std::optional<Push> PushIn(const std::vector<Push>& pushes, double begin, double period) {
  for (const Push& push : pushes) {
    if (push.at < begin + period && push.at + push.duration > begin) return push;
  }
  return std::nullopt;
}

std::string TextOf(const control::Contact& contact) {
  return std::string(Name(contact.foot)) +
         (contact.late > 0.0
              ? Formatted(" foot carries %.0f ms later than planned", 1e3 * contact.late)
              : Formatted(" foot met the floor %.0f ms earlier than planned, %.1f mm higher",
                          -1e3 * contact.late, 1e3 * contact.height));
}

}  // namespace

ReferenceMotion EpisodePhysics::MotionAbout(const SuperposedWalk& walk, double begin) const {
  const double period = options_.row_period;
  int first = -1, last = 2;  // the tick before, this one, and two to come
  if (const std::optional<ControlSetup>& control = robot_.setup.control) {
    first -= static_cast<int>(std::ceil(control->sensors.delay / period)) + 1;
    last += static_cast<int>(std::ceil(control::kControlPeriod / period));
  }
  std::vector<TrajectoryRow> rows;
  for (int i = first; i <= last; ++i) {
    rows.push_back(PlannedRow(ModelOf(robot_), walk, begin + i * period));
  }
  return ReferenceMotion(std::move(rows));
}

EpisodePhysics::EpisodePhysics(EpisodeRobot robot, const TrueWorld& truth,
                               const LiveOptions& options)
    : robot_(std::move(robot)),
      truth_(truth.SeenFrom([](double) { return Pose2(); })),
      options_(robot_.setup.play),
      contacts_(ModelOf(robot_)),
      pushes_(robot_.setup.Controlled()) {
  // Where the robot strays to, edges are elsewhere than a walk's soles know.
  RequireFlatFloor(*truth.scene().ground, "--in-physics");
  options_.row_period = options.period;
  options_.drift_window = options.horizon;
  // A period is a whole number of time steps.
  double& timestep = robot_.setup.model.timestep;
  timestep = options.period / std::ceil(options.period / timestep - 1e-9);
}

void EpisodePhysics::Begin(const ReferenceMotion& motion, double waited) {
  since_ = truth_.Since(waited);
  ReplaySetup& setup = robot_.setup;
  setup.obstacles = ObstaclesOf(*since_).obstacles;
  setup.play = options_;
  SeedDraws draws(1);
  const Simulation simulation =
      setup.Robot(FloorAhead(setup.relief, motion.rows().front(), setup.robot.model, &draws));
  PlayOptions play = setup.PlayOf(simulation, motion);
  if (!play.control) {
    play.control = std::make_shared<ControlLoop>(control::Sensors({}, simulation.weight()));
  }
  player_.emplace(simulation, motion, play);
  worlds_ = {Pose2()};
}

void EpisodePhysics::Play(const EpisodeTick& tick) {
  Advance(tick.executor.executed(), tick.now, tick.record.waited);
}

void EpisodePhysics::Advance(const SuperposedWalk& walk, double begin, double waited) {
  if (fallen() || !lost_.empty()) return;
  try {
    if (!player_) Begin(MotionAbout(walk, begin), waited);
    PlayPeriod(walk, begin);
  } catch (const control::ControllerLost& lost) {
    lost_ = lost.what();
  }
}

void EpisodePhysics::PlayPeriod(const SuperposedWalk& walk, double begin) {
  const ReferenceMotion motion = MotionAbout(walk, begin);
  if (robot_.setup.control) {
    plan_ = std::make_shared<PlannedStates>(ModelOf(robot_), motion);
    player_->control().Follow(plan_);
  }
  const ReplayRow& row = rows_.emplace_back(
      player_->Advance(motion, PushIn(robot_.pushes, begin, options_.row_period)));
  Feel(walk);
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

void EpisodePhysics::Feel(const SuperposedWalk& walk) {
  const std::optional<control::MeasuredState>& measured = player_->control().arrived();
  if (!measured) return;
  if (plan_) FeelPush(*measured);
  const std::optional<control::Contact> contact = contacts_.Look(*measured, walk);
  if (!contact) return;
  felt_.push_back({.t = contact->t,
                   .what = contact->late > 0.0 ? "late" : "early",
                   .half_step = contact->half_step,
                   .text = TextOf(*contact)});
}

void EpisodePhysics::FeelPush(const control::MeasuredState& measured) {
  const std::optional<double> off =
      pushes_.Look(measured, plan_->At(measured.t), options_.row_period);
  if (!off) return;
  felt_.push_back({.what = "pushed",
                   .text = Formatted("the DCM is %.1f mm off its plan: no foot is lifted until it "
                                     "is back",
                                     1e3 * *off)});
}

std::string EpisodePhysics::Waits(Side support) const {
  if (contacts_.misses(support)) {
    return "the " + std::string(Name(support)) + " foot does not carry yet";
  }
  return pushes_.pushed() ? "the DCM is off its plan" : "";
}

double EpisodePhysics::NoStepAt(double t, const Pose2& X_US) const {
  double least = std::numeric_limits<double>::infinity();
  const Scene& all = since_->scene();
  for (size_t i = 0; i < all.no_step.size(); ++i) {
    if (!since_->AreaIsThere(i, t)) continue;
    Scene scene;
    scene.no_step = {all.no_step[i]};
    const NoStepAreas area(scene, ModelOf(robot_).sole_outline);
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
  outcome.replayed.controller = robot_.controller;
  outcome.pushes = robot_.pushes;
  outcome.replayed.window = options_.drift_window;
  for (const RobotBody& body : ModelOf(robot_).bodies) outcome.replayed.bodies.push_back(body.name);
  for (const SimulatedObstacle& obstacle : all.obstacles) {
    outcome.replayed.obstacles.push_back(obstacle.name);
  }
  outcome.lost = lost_;
  if (rows_.empty()) return outcome;
  const SuperposedWalk walk = episode.Executed();
  const bool rests = walk.duration() <= episode.end;
  const long periods = std::lround(options_.hold / options_.row_period);
  for (long i = 0; rests && i < periods; ++i) Advance(walk, player_->time(), episode.waited);
  outcome.lost = lost_;
  const GoalRegion goal = since_->GoalAt(episode.end);
  std::array<Foothold, 2> feet;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Eigen::Isometry3d X_WSole = player_->robot().X_WSole(side);
    Nth(feet, Index(side)) = {OnFloor(X_WSole), X_WSole.translation().z()};
  }
  outcome.no_step = no_step_;
  outcome.in_goal = rests && !fallen() && lost_.empty() && goal.ContainsStance(feet);
  const Eigen::Vector2d seen = worlds_.back() * goal.X_WG.position();
  outcome.goal_off = (seen - episode.worlds.back().goal.X_WG.position()).norm();
  const ReferenceMotion motion = Executed(walk, std::min(walk.duration(), episode.end));
  outcome.replayed.duration = motion.end();
  ReplayResult& result = outcome.replayed.result;
  result = ResultOf(std::move(rows_), player_->touches(), motion.end(), player_->robot().weight(),
                    options_);
  result.drift = player_->DriftFrom(motion);
  CompareMassModel(ModelOf(robot_), robot_.setup.robot.tree, motion, &result);
  return outcome;
}

ReferenceMotion EpisodePhysics::Executed(const SuperposedWalk& walk, double end) const {
  std::vector<TrajectoryRow> rows;
  const long full = static_cast<long>(std::floor(end / options_.row_period * (1.0 - 1e-12)));
  for (long i = 0; i <= full + 1; ++i) {
    const double t = i <= full ? static_cast<double>(i) * options_.row_period : end;
    rows.push_back(PlannedRow(ModelOf(robot_), walk, t));
  }
  return ReferenceMotion(std::move(rows));
}

}  // namespace halfstep::replay
