#pragma once

#include <deque>
#include <memory>

#include "experiments/control/sensors.h"
#include "experiments/replay/planned_states.h"
#include "experiments/replay/simulation.h"

namespace halfstep::replay {

/// Closes the loop between a simulated robot and a controller: measures, delays, asks for commands,
/// and lets the servos go from one command to the next. Before anything was measured the plan is
/// commanded. A copy goes on independently.
class ControlLoop {
 public:
  /// Clones the controller; what that borrows must outlive the loop.
  ControlLoop(std::shared_ptr<const PlannedStates> plan,
              const control::TrackingController& controller, const control::Sensors& sensors);
  ControlLoop(const ControlLoop& other);  ///< in the same state, independent from then on
  ControlLoop& operator=(const ControlLoop&) = delete;

  /// Where the servos shall be at the end of the robot's next time step, which ends at t [s]. To be
  /// called before each time step, once, from the first on.
  JointTargets TargetsAt(double t, const Simulation& robot);

 private:
  void CommandNext(double now);

  std::shared_ptr<const PlannedStates> plan_;
  std::unique_ptr<control::TrackingController> controller_;
  control::Sensors sensors_;
  std::deque<control::MeasuredState> under_way_;  // measured, not yet arrived
  long step_ = 0;                                 // time steps before the next one
  double begun_ = 0.0;                            // when the last command was given
  control::JointCommand from_, to_;               // at begun_, and a period later
};

}  // namespace halfstep::replay
