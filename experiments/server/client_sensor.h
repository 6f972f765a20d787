#pragma once

#include <deque>
#include <optional>

#include "experiments/live/live_config.h"
#include "experiments/live/sensor.h"
#include "experiments/server/client_inbox.h"
#include "planner/scene/scene.h"
#include "planner/search/goal_region.h"

namespace halfstep {

/// Frames of what clients measured. A frame counts as a little older than it is where the tick that
/// takes it is late: never as younger. One that is no newer than a frame before it is left out.
class ClientSensor final : public Sensor {
 public:
  /// `inbox` is borrowed. `scene`: with the spare boxes; all no-step areas are there, and the goal
  /// is where the config says, until a client says otherwise.
  ClientSensor(const Scene& scene, const LiveConfig& config, ClientInbox* inbox);

  void Begin(double origin) override;
  std::optional<Frame> Next(double now) override;
  /// When a client asked for the end, or when the longest time is up.
  double QuietFrom() const override;

 private:
  World WorldOf(const MeasuredFrame& measured, double t);

  Scene scene_;
  LiveOptions options_;
  ClientInbox& inbox_;
  std::deque<ClientInbox::Measurement> waiting_;
  double last_;                           // t_m of the last frame [s]
  std::shared_ptr<const Course> course_;  // that a client commanded; null: none
  int commands_ = 0;
  GoalRegion goal_;
  std::vector<size_t> areas_;
};

}  // namespace halfstep
