#include "experiments/server/client_sensor.h"

#include <chrono>
#include <limits>
#include <numeric>

#include "experiments/server/quiet_from.h"

namespace halfstep {

ClientSensor::ClientSensor(const Scene& scene, const LiveConfig& config, ClientInbox* inbox)
    : scene_(scene),
      options_(config.live),
      inbox_(*inbox),
      last_(-std::numeric_limits<double>::infinity()),
      goal_(config.experiment.goal.Region()),
      areas_(scene.no_step.size()) {
  std::iota(areas_.begin(), areas_.end(), size_t{0});
}

void ClientSensor::Begin(double origin) { last_ -= origin; }

std::optional<Frame> ClientSensor::Next(double now) {
  for (const Edit& edit : inbox_.TakeEdits()) {
    const auto* command =
        std::get_if<Command>(&edit);  // others are not taken where clients measure
    if (command == nullptr) continue;
    course_ = std::make_shared<const Course>(CourseOf(command->event, ++commands_));
  }
  for (ClientInbox::Measurement& measurement : inbox_.TakeMeasurements()) {
    waiting_.push_back(std::move(measurement));
  }
  while (!waiting_.empty()) {
    const ClientInbox::Measurement measurement = std::move(waiting_.front());
    waiting_.pop_front();
    const std::chrono::duration<double> age = std::chrono::steady_clock::now() - measurement.at;
    const double taken = now - age.count();
    if (!(taken > last_)) continue;
    last_ = taken;
    return Frame{.taken = taken, .world = WorldOf(measurement.frame, taken)};
  }
  return std::nullopt;
}

World ClientSensor::WorldOf(const MeasuredFrame& measured, double t) {
  if (measured.goal && goal_.X_WG.position() != *measured.goal) {
    course_ = nullptr;
    goal_.X_WG.x = measured.goal->x();
    goal_.X_WG.y = measured.goal->y();
  }
  if (measured.areas) areas_ = *measured.areas;
  World frame;
  frame.measured_at = t;
  frame.goal = goal_;
  frame.course = course_;
  frame.scene = scene_.Emptied();
  for (const MeasuredFrame::Seen& seen : measured.seen) {
    frame.scene.obstacles.push_back(
        Measured(scene_.obstacles[seen.obstacle], seen.X_WO, t, options_));
    frame.stays.push_back({seen.X_WO, t});
  }
  frame.areas = areas_;
  for (const size_t area : areas_) frame.scene.no_step.push_back(scene_.no_step[area]);
  return frame;
}

double ClientSensor::QuietFrom() const { return halfstep::QuietFrom(inbox_, options_); }

}  // namespace halfstep
