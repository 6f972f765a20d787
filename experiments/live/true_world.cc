#include "experiments/live/true_world.h"

#include <algorithm>
#include <string>

#include "experiments/config/experiment.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/geometry/rotation.h"

namespace halfstep {
namespace {

Eigen::Vector3d TargetOf(const ScriptEvent& event) {
  return {event.xyz[0], event.xyz[1], event.xyz[2]};
}

Eigen::Isometry3d Turned(const Eigen::Isometry3d& X_WO, const Eigen::Vector3d& to, double yaw) {
  Eigen::Isometry3d X = X_WO;
  X.linear() = AxisRotation(yaw, Eigen::Vector3d::UnitZ()) * X_WO.linear();
  X.translation() = to;
  return X;
}

double CarryTime(const Eigen::Isometry3d& from, const ScriptEvent& event) {
  return (TargetOf(event) - from.translation()).norm() / event.speed;
}

// Where an event has brought an obstacle after `elapsed` [s].
Eigen::Isometry3d After(const Eigen::Isometry3d& from, const ScriptEvent& event, double elapsed) {
  if (event.what == "jump") return Turned(from, TargetOf(event), event.turn);
  if (event.what != "carry") return from;
  const double time = CarryTime(from, event);
  const double part = time > 0.0 ? std::min(1.0, elapsed / time) : 1.0;
  const Eigen::Vector3d to = from.translation() + part * (TargetOf(event) - from.translation());
  return Turned(from, to, part * event.turn);
}

}  // namespace

TrueWorld::TrueWorld(const Scene& scene, const GoalConfig& goal, const LiveOptions& options)
    : scene_(scene),
      goal_(GoalOn(goal, *scene.ground)),
      script_(options.script),
      own_(scene.obstacles.size() -
           std::min(scene.obstacles.size(), static_cast<size_t>(options.spare_boxes))),
      drift_(options.drift) {
  std::vector<std::string> complaints;
  of_obstacle_.resize(scene.obstacles.size());
  for (size_t k = 0; k < script_.size(); ++k) {
    const ScriptEvent& event = script_[k];
    end_ = std::max(end_, event.at + event.lasts);
    const std::vector<SceneMistake> mistakes = MistakesOf(event, scene);
    for (const SceneMistake& one : mistakes) {
      complaints.push_back(Formatted("live.script[%zu].", k) + one.key + ": " + one.what);
    }
    const size_t index = event.obstacle.empty() ? scene.obstacles.size() : IndexOf(event.obstacle);
    if (index == scene.obstacles.size()) continue;
    TakeIn(index, event);
  }
  for (const SceneMistake& one : MistakesOf(options, scene)) {
    complaints.push_back("live." + one.key + ": " + one.what);
  }
  if (!complaints.empty()) throw InputError(complaints);
}

size_t TrueWorld::IndexOf(const std::string& obstacle) const {
  const auto named = std::ranges::find(scene_.obstacles, obstacle, &Obstacle::name);
  return static_cast<size_t>(named - scene_.obstacles.begin());
}

void TrueWorld::TakeIn(size_t obstacle, const ScriptEvent& event) {
  if (event.what == "carry") {
    const Eigen::Isometry3d from = PoseAt(obstacle, event.at);
    end_ = std::max(end_, origin_ + event.at + CarryTime(from, event));
  }
  std::vector<ScriptEvent>& events = of_obstacle_[obstacle];
  events.insert(std::ranges::upper_bound(events, event.at, {}, &ScriptEvent::at), event);
}

void TrueWorld::Append(ScriptEvent event) {
  end_ = std::max(end_, origin_ + event.at + event.lasts);
  if (!event.obstacle.empty()) TakeIn(IndexOf(event.obstacle), event);
  script_.insert(std::ranges::upper_bound(script_, event.at, {}, &ScriptEvent::at), event);
}

std::vector<ScriptEvent> TrueWorld::Script() const {
  std::vector<ScriptEvent> script = script_;
  for (ScriptEvent& event : script) event.at += origin_;
  return script;
}

TrueWorld TrueWorld::Since(double origin) const {
  TrueWorld since = *this;
  since.origin_ = origin;
  for (std::vector<ScriptEvent>& events : since.of_obstacle_) {
    for (ScriptEvent& event : events) event.at -= origin;
  }
  for (ScriptEvent& event : since.script_) event.at -= origin;
  return since;
}

TrueWorld TrueWorld::SeenFrom(std::function<Pose2(double t)> X_WU) const {
  TrueWorld seen = *this;
  seen.seen_from_ = std::move(X_WU);
  return seen;
}

Pose2 TrueWorld::WorldAt(double t) const {
  return seen_from_ ? seen_from_(t) : Pose2{drift_ * (t + origin_), 0.0, 0.0};
}

bool TrueWorld::IsThere(size_t obstacle, double t) const {
  const std::vector<ScriptEvent>& events = of_obstacle_[obstacle];
  bool there =
      obstacle < own_ && std::ranges::find(events, "appear", &ScriptEvent::what) == events.end();
  for (const ScriptEvent& event : events) {
    if (event.at > t) break;
    if (event.what == "appear") there = true;
    if (event.what == "vanish") there = false;
  }
  return there;
}

Eigen::Isometry3d TrueWorld::PoseAt(size_t obstacle, double t) const {
  Eigen::Isometry3d X_WO = scene_.obstacles[obstacle].X_WO;
  const std::vector<ScriptEvent>& events = of_obstacle_[obstacle];
  for (size_t k = 0; k < events.size() && events[k].at <= t; ++k) {
    const double until = k + 1 < events.size() ? std::min(t, events[k + 1].at) : t;
    X_WO = After(X_WO, events[k], until - events[k].at);
  }
  const Pose2 X_WU = WorldAt(t);
  if (X_WU.yaw != 0.0) return ToIsometry(X_WU, 0.0) * X_WO;
  X_WO.translation() += Eigen::Vector3d(X_WU.x, X_WU.y, 0.0);
  return X_WO;
}

double TrueWorld::SpeedOf(size_t obstacle) const {
  double speed = 0.0;
  for (const ScriptEvent& event : of_obstacle_[obstacle]) speed = std::max(speed, event.speed);
  return speed + drift_;
}

bool TrueWorld::AreaIsThere(size_t area, double t) const {
  bool there = true;
  for (const ScriptEvent& event : script_) {
    if (event.what == "forbid" && static_cast<size_t>(event.area) == area + 1)
      there = event.at <= t;
  }
  return there;
}

GoalRegion TrueWorld::GoalAt(double t) const {
  GoalRegion goal = goal_;
  for (const ScriptEvent& event : script_) {
    if (event.what != "goal" || event.at > t) continue;
    goal.X_WG.x = event.goal[0];
    goal.X_WG.y = event.goal[1];
  }
  const Eigen::Vector2d place = WorldAt(t) * goal.X_WG.position();
  goal.X_WG.x = place.x();
  goal.X_WG.y = place.y();
  return goal;
}

std::shared_ptr<const Course> TrueWorld::CourseAt(double t) const {
  const ScriptEvent* last = nullptr;
  int number = 0;
  for (const ScriptEvent& event : script_) {
    if (event.at > t) break;
    if (event.what == "goal") last = nullptr;
    if (!Commands(event)) continue;
    last = &event;
    ++number;
  }
  if (last == nullptr) return nullptr;
  Course course = CourseOf(*last, number);
  const Pose2 X_WU = WorldAt(t);
  if (X_WU != Pose2{}) course = Moved(X_WU, std::move(course));
  return std::make_shared<const Course>(std::move(course));
}

bool TrueWorld::IsSeen(double t) const {
  return std::ranges::none_of(script_, [t](const ScriptEvent& event) {
    return event.what == "lose" && event.at <= t && t < event.at + event.lasts;
  });
}

}  // namespace halfstep
