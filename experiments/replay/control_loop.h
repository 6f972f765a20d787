#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <utility>

#include "experiments/control/sensors.h"
#include "experiments/replay/planned_states.h"
#include "experiments/replay/simulation.h"

namespace halfstep::replay {

/// Closes the loop between a simulated robot and a controller: measures, delays, asks for commands,
/// and lets the servos go from one command to the next. Before anything was measured the plan is
/// commanded. Without a controller it only measures. A copy goes on independently.
class ControlLoop {
 public:
  /// Measures only.
  explicit ControlLoop(const control::Sensors& sensors) : sensors_(sensors) {}
  /// Clones the controller; what that borrows must outlive the loop.
  ControlLoop(std::shared_ptr<const PlannedStates> plan,
              const control::TrackingController& controller, const control::Sensors& sensors);
  ControlLoop(const ControlLoop& other);  ///< in the same state, independent from then on
  ControlLoop& operator=(const ControlLoop&) = delete;

  /// From now on this is planned. It has times from SensorOptions::delay before now to a control
  /// period after the next commands.
  void Follow(std::shared_ptr<const PlannedStates> plan) { plan_ = std::move(plan); }

  /// Where the servos shall be at the end of the robot's next time step, which ends at t [s]; none
  /// without a controller. To be called before each time step, once, from the first on.
  std::optional<JointTargets> TargetsAt(double t, const Simulation& robot);

  /// The latest that was measured and has arrived.
  const std::optional<control::MeasuredState>& arrived() const { return arrived_; }

 private:
  bool Receives(double now);  // whether something has arrived now
  void CommandNext(double now, bool measured);

  std::shared_ptr<const PlannedStates> plan_;
  std::unique_ptr<control::TrackingController> controller_;
  control::Sensors sensors_;
  std::deque<control::MeasuredState> under_way_;  // measured, not yet arrived
  std::optional<control::MeasuredState> arrived_;
  long step_ = 0;                    // time steps before the next one
  double begun_ = 0.0;               // when the last command was given
  control::JointCommand from_, to_;  // at begun_, and a period later
};

}  // namespace halfstep::replay
