#pragma once

#include <array>
#include <optional>
#include <vector>

#include "experiments/replay/planned_states.h"
#include "experiments/replay/player.h"
#include "experiments/replay/simulation.h"
#include "smoothing/margins/tube.h"
#include "wpg/geometry/pose2.h"

namespace halfstep::replay {

/// How far a simulated robot is from its plan at an instant, as a certificate's tube has it: the
/// plan stays where it was put when the walk began, so that what soles drift from then on counts.
struct TubeSample {
  Tube tube;  ///< `zmp` as long as contacts are as planned, else 0
  /// The ZMP's distance where soles press that are planned in the air, or the other way round; a
  /// tube takes instants of contact as planned.
  std::optional<double> zmp_beside;
};

/// Measures how far a robot is from its plan, which begins where the robot stands.
class TubeGauge {
 public:
  /// Borrows nothing. Precondition: soles stand at z = 0. Of a robot whose masses are not known the
  /// ZMP is not measured.
  TubeGauge(const RobotModel& robot, const ReferenceMotion& motion);

  bool has_zmp() const { return whole_.has_value(); }  ///< whether the ZMP is measured
  /// Puts the plan on the floor where the robot stands, by the middle of its soles and their mean
  /// yaw.
  void BeginAt(const Simulation& robot);
  /// Of a robot at the end of `row`, which was played last; its ZMP is the mean over the row,
  /// against the planned one of the whole robot at the row's middle.
  TubeSample Of(const Simulation& robot, const ReplayRow& row, double period) const;

 private:
  ReferenceMotion motion_;
  std::optional<PlannedStates> whole_;
  Pose2 X_WP_;  // where the plan's W is
};

/// The distances of a tube, one by one.
inline constexpr std::array<double Tube::*, 7> kTubeParts = {
    &Tube::foot,  &Tube::foot_turn,   &Tube::waist, &Tube::waist_turn,
    &Tube::joint, &Tube::joint_speed, &Tube::zmp};

/// The distances of many instants, each by itself.
struct MeasuredTube {
  MeasuredTube() = default;  ///< of no instant
  /// Without instants all are 0.
  explicit MeasuredTube(const std::vector<TubeSample>& samples);

  Tube most;                ///< what 95 % of the instants do not exceed
  Tube largest;             ///< of all
  double beside = 0.0;      ///< share of the instants with contacts that are not planned
  double zmp_beside = 0.0;  ///< the ZMP's largest distance then [m]
};

}  // namespace halfstep::replay
