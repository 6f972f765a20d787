#pragma once

#include <array>
#include <optional>

#include "experiments/control/tracking_controller.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/geometry/side.h"

namespace halfstep::control {

/// A foot that came to the floor at another time than planned.
struct Contact {
  double t = 0.0;           ///< when it was measured [s]
  Side foot = Side::kLeft;  ///< that came
  int half_step = 0;        ///< the down half-step that should have brought it, from 0
  double late = 0.0;        ///< after it should have carried [s]; below 0: before its landing
  double height = 0.0;      ///< that its sole had then by the plan, above where it lands [m]
};

/// Watches the soles' measured forces: which foot carries, and which came to the floor early or
/// late. A foot carries from the second measurement in a row on that has at least kCarries of the
/// weight; it should from when on the planned ZMP asks kDue of the weight of it.
class ContactWatch {
 public:
  /// Of the robot's weight; five standard deviations of SensorOptions::force.
  static constexpr double kCarries = 0.05;
  static constexpr double kDue = 0.1;    ///< of the weight
  static constexpr double kLate = 0.05;  ///< a contact that is later is told [s]
  /// So high by the plan above its footstep a sole meets the floor early; lower, the servos' sag
  /// brings it there. Share of the height of the CoM.
  static constexpr double kEarly = 0.005;

  /// Of a robot whose mass is known.
  explicit ContactWatch(const RobotModel& robot);

  /// Takes a measurement in, of a robot that executes `walk`. To be called in the order of time.
  std::optional<Contact> Look(const MeasuredState& measured, const SuperposedWalk& walk);
  /// Whether a foot should have carried for longer than kLate, and does not yet.
  bool misses(Side foot) const { return feet_[static_cast<size_t>(foot)].misses; }

 private:
  struct Foot {
    bool pressed = true;        // at the last measurement
    bool awaited = false;       // it was lifted and did not meet the floor since
    std::optional<double> due;  // since when it should have carried [s]
    bool misses = false;
  };
  double ShareOf(const SuperposedWalk& walk, const LocalTime& at, Side side) const;

  double least_, early_, com_height_;
  Eigen::Vector2d sole_size_;
  std::array<Foot, 2> feet_;
};

}  // namespace halfstep::control
