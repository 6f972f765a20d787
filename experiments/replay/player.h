#pragma once

#include <limits>
#include <optional>

#include "experiments/replay/control_loop.h"
#include "experiments/replay/reference_motion.h"
#include "experiments/replay/touch_log.h"
#include "experiments/replay/tracking_error.h"
#include "wpg/geometry/pose2.h"

namespace halfstep::replay {

class TubeGauge;

/// How a walk is played. Documented in experiments/replay.md, "Replay".
struct PlayOptions {
  double settle = 0.5;        ///< standing in the first row's posture before t = 0 [s]
  double hold = 1.0;          ///< standing in the last row's posture after the walk [s]
  double row_period = 0.005;  ///< what is measured is averaged over it [s]
  double fallen_tilt = 0.7;   ///< the waist leans by more: fallen [rad]
  /// The waist is lower than planned by more: fallen, as who steps off a surface over nothing [m].
  double fallen_drop = std::numeric_limits<double>::infinity();
  double drift_window = 2.0;  ///< of SupportDrift::within_window [s]
  double edge = 0.003;        ///< so near to its edge the support is as good as tilting [m]
  /// What moves the robot, of which a player uses a copy; none: the servos get the plan itself.
  std::shared_ptr<const ControlLoop> control = nullptr;
  /// Measures how wide a tube around the plan has to be, of which Play() uses a copy; none:
  /// nothing.
  std::shared_ptr<const TubeGauge> gauge = nullptr;
};

/// A push: a constant force on the waist.
struct Push {
  double at = 0.0;                     ///< when it begins [s]
  double duration = 0.1;               ///< [s]
  Eigen::Vector3d impulse_W{0, 0, 0};  ///< [N s]
};

/// What was measured over the row period that ends at t.
struct ReplayRow {
  double t = 0.0;                      ///< [s]
  double tilt = 0.0;                   ///< of the waist from upright [rad]
  Eigen::Vector3d waist{0, 0, 0};      ///< origin of B in W [m]
  Eigen::Vector2d zmp_planned{0, 0};   ///< in W, in the plane z = TrajectoryRow::zmp_z [m]
  Eigen::Vector2d zmp_measured{0, 0};  ///< in W, in the same plane [m]; nan in flight
  /// Measured less planned ZMP, each seen from the sole that carries more; nan in flight.
  Eigen::Vector2d zmp_error{0, 0};
  std::array<double, 2> vertical{};  ///< force on each sole, by Index(Side) [N]
  /// How far a carrying sole's centre is from where it took up load, the larger of both [m].
  double slip = 0.0;
  double turn = 0.0;  ///< the same of its yaw [rad]
  /// How far inside the support polygon of the soles that carry, seen from above, the pressure
  /// point is [m]; nan: no sole carries, whatever was planned. Soles may stand at different
  /// heights: where it is 0, only the edge of the soles there is pressed.
  double edge = 0.0;
  std::optional<Side> support;  ///< the sole that carries more of those planned to stand, if any
  /// Of that sole, simulated less planned: x, y in W [m], yaw [rad]; nan: none carries.
  Eigen::Vector3d support_drift{0, 0, 0};
  /// The farthest that the waist's origin or a sole's centre is from its plan when that is shifted
  /// on the floor by the support's drift [m]; nan: none carries.
  double stray = 0.0;
  std::optional<TrackingError> off;  ///< from the plan; none: no sole carries
  double touch = 0.0;   ///< greatest force between a body and an obstacle [N]; 0: none touch
  bool fallen = false;  ///< tilted beyond fallen_tilt, or lower than fallen_drop
};

/// The place of a body on the floor, and its yaw.
Pose2 OnFloor(const Eigen::Isometry3d& X_WB);

/// Plays a motion on a simulated robot, one row period after the other, from t = 0 on. A copy
/// continues independently.
class Player {
 public:
  /// Places the robot on its floor in the first row's posture and lets it settle.
  Player(const Simulation& robot, const ReferenceMotion& motion, const PlayOptions& options);

  double time() const { return t_; }                  ///< played so far [s]
  const Simulation& robot() const { return robot_; }  ///< as it is now
  /// Horizontal distance of the waist from where the motion has it now [m].
  double DriftFrom(const ReferenceMotion& motion) const;
  /// Plays the next row period of the motion, with the part of the push that falls into it. What
  /// the motion is at other times does not matter.
  ReplayRow Advance(const ReferenceMotion& motion, const std::optional<Push>& push);
  /// The copy of PlayOptions::control. Precondition: there is one.
  ControlLoop& control() { return *control_; }
  /// Contacts with obstacles and with sides of the ground from t = 0 on.
  const std::vector<TouchRecord>& touches() const { return touches_.records(); }

 private:
  // How far a sole is from where it took up load: on the floor [m], in yaw [rad].
  struct Creep {
    double slip = 0.0, turn = 0.0;
  };
  Creep CreepOf(Side side, bool carries);
  bool HasDropped(const ReferenceMotion& motion) const;  // PlayOptions::fallen_drop
  // ReplayRow::edge for the pressure point in W; `vertical` is the force on each sole.
  double EdgeOf(const Eigen::Vector2d& pressure, const std::array<double, 2>& vertical) const;
  double StrayFrom(const TrajectoryRow& planned, const Eigen::Vector3d& shift) const;
  // Of the time step that ends at t.
  JointTargets TargetsAt(double t, const ReferenceMotion& motion) {
    const auto commanded = control_ ? control_->TargetsAt(t, robot_) : std::nullopt;
    return commanded ? *commanded : motion.TargetsAt(t);
  }

  Simulation robot_;
  PlayOptions options_;
  std::optional<ControlLoop> control_;
  long row_ = 0;
  double t_ = 0.0;
  std::array<std::optional<Pose2>, 2> anchors_;  // where each carrying sole took up load
  TouchLog touches_;
};

}  // namespace halfstep::replay
