#include "experiments/server/edited_sensor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "experiments/server/quiet_from.h"
#include "wpg/elementary.h"

namespace halfstep {
namespace {

constexpr size_t kMostEvents = 10000;  // of a script, as its key allows
constexpr double kLatest = 3600.0;     // of an event, as its key allows [s]
constexpr double kFastest = 10.0;      // of being carried, as its key allows [m/s]

ScriptEvent EventOf(const char* what, double at, const std::string& obstacle) {
  ScriptEvent event;
  event.at = at;
  event.what = what;
  event.obstacle = obstacle;
  return event;
}

std::vector<double> Listed(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

}  // namespace

ScriptEvent CarriedWithin(const Obstacle& obstacle, const Eigen::Isometry3d& X_WO,
                          const Carry& carry, double at) {
  ScriptEvent event = EventOf("jump", at, obstacle.name);
  event.xyz = Listed(carry.to);
  event.turn = carry.turn;
  const double way = (carry.to - X_WO.translation()).norm();
  const double sweep = way + std::abs(carry.turn) * RadiusAboutOrigin(obstacle.shape);
  const double speed = std::min(obstacle.motion.speed, kFastest);
  if (!(speed > 0.0 && way > 1e-6 * sweep)) return event;
  event.what = "carry";
  event.speed = speed * way / sweep;
  return event;
}

EditedSensor::EditedSensor(TrueWorld truth, const LiveOptions& options, std::uint64_t seed,
                           ClientInbox* inbox, std::function<void(const std::string&)> refuse)
    : sensor_(std::move(truth), options, seed),
      options_(options),
      inbox_(*inbox),
      refuse_(std::move(refuse)) {}

void EditedSensor::Begin(double origin) {
  sensor_.Begin(origin);
  next_ -= origin;
  origin_ += origin;
}

std::optional<Frame> EditedSensor::Next(double now) {
  if (now >= next_) {
    for (const Edit& edit : inbox_.TakeEdits()) {
      next_ = now + options_.sensing.period;
      std::string why;
      if (truth().Script().size() + 1 >= kMostEvents || now + origin_ > kLatest) {
        why = "the script of the episode is full (valid: at most 10000 events within 3600 s)";
      } else {
        why = std::visit([&](const auto& one) { return Apply(one, now); }, edit);
      }
      if (!why.empty()) refuse_(why);
    }
  }
  return sensor_.Next(now);
}

std::string EditedSensor::Apply(const Carry& carry, double now) {
  const Obstacle& obstacle = truth().scene().obstacles[carry.obstacle];
  if (!truth().IsThere(carry.obstacle, now)) {
    return "carry.obstacle: '" + obstacle.name + "' is not there (valid: one that is)";
  }
  // The script knows no drift.
  const Eigen::Isometry3d X_UW = ToIsometry(truth().WorldAt(now).Inverse(), 0.0);
  const Eigen::Isometry3d X_UO = X_UW * truth().PoseAt(carry.obstacle, now);
  sensor_.Append(CarriedWithin(obstacle, X_UO, carry, now));
  return "";
}

std::string EditedSensor::Apply(const MoveGoal& goal, double now) {
  ScriptEvent event = EventOf("goal", now, "");
  event.goal = {goal.to.x(), goal.to.y()};
  sensor_.Append(event);
  return "";
}

std::string EditedSensor::Apply(const AddBox& box, double now) {
  const std::vector<Obstacle>& obstacles = truth().scene().obstacles;
  for (size_t i = obstacles.size() - static_cast<size_t>(options_.spare_boxes);
       i < obstacles.size(); ++i) {
    if (truth().IsThere(i, now)) continue;
    ScriptEvent jump = EventOf("jump", now, obstacles[i].name);
    jump.xyz = Listed(box.at);
    // Turned so from how the scene has it, not from how it stood when it was there last.
    const Eigen::Matrix3d turned = truth().PoseAt(i, now).linear();
    jump.turn = std::remainder(box.turn - Atan2(turned(1, 0), turned(0, 0)), 2.0 * M_PI);
    sensor_.Append(jump);
    sensor_.Append(EventOf("appear", now, obstacles[i].name));
    return "";
  }
  return "add: every spare box is there already (valid: at most " +
         std::to_string(options_.spare_boxes) + ", live.spare_boxes)";
}

std::string EditedSensor::Apply(const Remove& remove, double now) {
  sensor_.Append(EventOf("vanish", now, truth().scene().obstacles[remove.obstacle].name));
  return "";
}

std::string EditedSensor::Apply(const Command& command, double now) {
  ScriptEvent event = command.event;
  event.at = now;
  sensor_.Append(event);
  return "";
}

double EditedSensor::QuietFrom() const { return halfstep::QuietFrom(inbox_, options_); }

}  // namespace halfstep
