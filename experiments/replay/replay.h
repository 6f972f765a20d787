#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "experiments/replay/player.h"
#include "experiments/replay/support_drift.h"
#include "experiments/replay/tube_gauge.h"
#include "experiments/tables/csv_columns.h"
#include "wpg/robot/robot_tree.h"

namespace halfstep::replay {

/// The outcome of playing a walk.
struct ReplayResult {
  bool stayed_up = true;       ///< to the end, the time of standing after the walk included
  double ended = 0.0;          ///< time at which the waist had fallen, else the end [s]
  double largest_tilt = 0.0;   ///< of the waist, until then [rad]
  double zmp_rms = 0.0;        ///< of the ZMP's error during the walk [m]
  double zmp_largest = 0.0;    ///< [m]
  double model_rms = 0.0;      ///< of the mass model's ZMP against the planned one [m]
  double model_largest = 0.0;  ///< [m]
  double slip = 0.0;           ///< largest of a carrying sole [m]
  double drift = 0.0;          ///< of the waist on the floor, at the end [m]
  double weight_share = 0.0;   ///< mean vertical force during the walk, of the weight
  SupportDrift support;        ///< of the support feet, the time after the walk included
  double stray = 0.0;          ///< largest ReplayRow::stray, likewise [m]
  double turn = 0.0;           ///< largest of a carrying sole's yaw [rad]
  /// The share of the walk's time with soles that carry in which the pressure point is less than
  /// PlayOptions::edge inside their support polygon.
  double edge_share = 0.0;
  double peak = 0.0;                 ///< largest vertical force of a row, of the weight
  double flight = 0.0;               ///< time in which no sole carries [s]
  TrackingErrors off;                ///< from the plan, likewise
  std::optional<MeasuredTube> tube;  ///< by PlayOptions::gauge
  std::vector<TouchRecord> touches;  ///< of bodies with obstacles, in order
  std::vector<ReplayRow> rows;       ///< from t = 0
};

/// What rows say, which were played from t = 0 on, of a walk that ends at `walk_end` [s]; `weight`
/// of the robot [N]. Leaves `drift` of the waist and the mass model to others.
ReplayResult ResultOf(std::vector<ReplayRow> rows, const std::vector<TouchRecord>& touches,
                      double walk_end, double weight, const PlayOptions& options);

/// Plays a motion to its end or until the robot has fallen; the waist may be pushed once. Leaves
/// the mass model's ZMP to CompareMassModel().
ReplayResult Play(const Simulation& robot, const ReferenceMotion& motion,
                  const PlayOptions& options, const std::optional<Push>& push = std::nullopt);

/// Fills what the mass model says of the motion by itself (MassModelZmp).
void CompareMassModel(const RobotModel& robot, const RobotTree& tree, const ReferenceMotion& motion,
                      ReplayResult* result);

/// The largest push survived in a direction.
struct PushLimit {
  double at = 0.0;         ///< begin of the push [s]
  double direction = 0.0;  ///< yaw in W [rad]
  double survived = 0.0;   ///< [N s]
  double fell = 0.0;       ///< least impulse tried that made it fall; inf: none did [N s]
};

/// How the largest push that is survived is looked for.
struct PushOptions {
  double largest = 80.0;   ///< tried [N s]
  double tolerance = 1.0;  ///< [N s]
  double duration = 0.1;   ///< of a push [s]
  int directions = 4;      ///< evenly around, from the robot's forward
};

/// Bisects the impulse for each instant and direction (relative to the planned waist's yaw there).
/// It takes for granted that a harder push is not easier to survive. Empty when stopped.
std::vector<PushLimit> FindPushLimits(const Simulation& robot, const ReferenceMotion& motion,
                                      const PlayOptions& options, const PushOptions& pushes,
                                      const std::vector<double>& instants,
                                      const std::function<void(double)>& progress,
                                      std::stop_token stop);

/// replay.csv; of an episode in physics physics.csv.
CsvFile ReplayCsv(const std::vector<ReplayRow>& rows);

}  // namespace halfstep::replay
