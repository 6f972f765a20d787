#include "experiments/replay/replay.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "experiments/replay/mass_model_zmp.h"
#include "experiments/tables/csv_writer.h"
#include "wpg/elementary.h"

namespace halfstep::replay {
namespace {

// Whether the robot is up at the end after a push.
bool Survives(Player player, const ReferenceMotion& motion, double until, const Push& push) {
  while (player.time() < until) {
    if (player.Advance(motion, push).fallen) return false;
  }
  return true;
}

PushLimit FindLimit(const Player& player, const ReferenceMotion& motion, double until, double at,
                    double direction, const PushOptions& options) {
  const double yaw = motion.RowAt(at).waist[3];
  PushLimit limit{at, direction, 0.0, std::numeric_limits<double>::infinity()};
  const Eigen::Vector3d forward(Cos(yaw + direction), Sin(yaw + direction), 0.0);
  const auto survives = [&](double impulse) {
    return Survives(player, motion, until, {at, options.duration, impulse * forward});
  };
  if (survives(options.largest)) {
    limit.survived = options.largest;
    return limit;
  }
  limit.fell = options.largest;
  while (limit.fell - limit.survived > options.tolerance) {
    const double impulse = 0.5 * (limit.survived + limit.fell);
    (survives(impulse) ? limit.survived : limit.fell) = impulse;
  }
  return limit;
}

}  // namespace

ReplayResult ResultOf(std::vector<ReplayRow> rows, const std::vector<TouchRecord>& touches,
                      double walk_end, double weight, const PlayOptions& options) {
  ReplayResult result;
  double squares = 0.0, vertical = 0.0;
  long measured = 0, walked = 0, carried = 0, at_edge = 0, flown = 0;
  std::vector<DriftSample> drift;
  std::vector<TrackingError> off;
  for (const ReplayRow& row : rows) {
    result.stayed_up = result.stayed_up && !row.fallen;
    result.ended = row.t;
    result.largest_tilt = std::max(result.largest_tilt, row.tilt);
    result.slip = std::max(result.slip, row.slip);
    result.turn = std::max(result.turn, row.turn);
    result.peak = std::max(result.peak, (row.vertical[0] + row.vertical[1]) / weight);
    if (std::isnan(row.edge)) ++flown;
    if (!std::isnan(row.stray)) {
      result.stray = std::max(result.stray, row.stray);
      drift.push_back({row.t, row.support_drift});
    }
    if (row.off) off.push_back(*row.off);
    if (row.t > walk_end) continue;
    ++walked;
    if (!std::isnan(row.edge)) ++carried;
    if (row.edge < options.edge) ++at_edge;
    vertical += row.vertical[0] + row.vertical[1];
    const double error = row.zmp_error.norm();
    if (std::isnan(error)) continue;
    ++measured;
    squares += error * error;
    result.zmp_largest = std::max(result.zmp_largest, error);
  }
  result.support = DriftOf(drift, options.drift_window);
  result.flight = static_cast<double>(flown) * options.row_period;
  if (carried > 0) result.edge_share = static_cast<double>(at_edge) / static_cast<double>(carried);
  result.off = TrackingErrors(off);
  result.touches = touches;
  if (measured > 0) result.zmp_rms = std::sqrt(squares / static_cast<double>(measured));
  if (walked > 0) result.weight_share = vertical / static_cast<double>(walked) / weight;
  result.rows = std::move(rows);
  return result;
}

ReplayResult Play(const Simulation& robot, const ReferenceMotion& motion,
                  const PlayOptions& options, const std::optional<Push>& push) {
  Player player(robot, motion, options);
  std::vector<ReplayRow> rows;
  std::optional<TubeGauge> gauge;
  if (options.gauge) gauge.emplace(*options.gauge).BeginAt(player.robot());
  std::vector<TubeSample> samples;
  while (player.time() < motion.end() + options.hold && (rows.empty() || !rows.back().fallen)) {
    rows.push_back(player.Advance(motion, push));
    if (gauge) samples.push_back(gauge->Of(player.robot(), rows.back(), options.row_period));
  }
  ReplayResult result =
      ResultOf(std::move(rows), player.touches(), motion.end(), robot.weight(), options);
  result.drift = player.DriftFrom(motion);
  if (gauge) result.tube = MeasuredTube(samples);
  return result;
}

void CompareMassModel(const RobotModel& robot, const RobotTree& tree, const ReferenceMotion& motion,
                      ReplayResult* result) {
  const std::vector<TrajectoryRow>& rows = motion.rows();
  const std::vector<Eigen::Vector2d> zmp = MassModelZmp(robot, tree, rows);
  double squares = 0.0;
  for (size_t i = 0; i < rows.size(); ++i) {
    const double error = (zmp[i] - rows[i].zmp).norm();
    squares += error * error;
    result->model_largest = std::max(result->model_largest, error);
  }
  result->model_rms = std::sqrt(squares / static_cast<double>(rows.size()));
}

std::vector<PushLimit> FindPushLimits(const Simulation& robot, const ReferenceMotion& motion,
                                      const PlayOptions& options, const PushOptions& pushes,
                                      const std::vector<double>& instants,
                                      const std::function<void(double)>& progress,
                                      std::stop_token stop) {
  std::vector<PushLimit> limits;
  const double all = static_cast<double>(instants.size()) * pushes.directions;
  for (const double at : instants) {
    Player player(robot, motion, options);
    while (player.time() + options.row_period <= at + 1e-9) player.Advance(motion, std::nullopt);
    for (int i = 0; i < pushes.directions; ++i) {
      if (stop.stop_requested()) return {};
      const double direction = 2 * std::numbers::pi * i / pushes.directions;
      limits.push_back(
          FindLimit(player, motion, motion.end() + options.hold, at, direction, pushes));
      progress(static_cast<double>(limits.size()) / all);
    }
  }
  return limits;
}

CsvFile ReplayCsv(const std::vector<ReplayRow>& rows) {
  using enum CsvType;
  const std::string mean = ", mean of the row's period";
  const std::string support = "carrying sole, simulated less planned, ";
  CsvWriter csv({
      {"t_s", kNumber, "s", "time since the walk's start: end of the row's period"},
      {"tilt_rad", kNumber, "rad", "of the waist from upright", "W", CsvInterpolation::kLinear},
      {"waist_x_m", kNumber, "m", "waist frame B, x", "W", CsvInterpolation::kLinear},
      {"waist_y_m", kNumber, "m", "waist frame B, y", "W", CsvInterpolation::kLinear},
      {"waist_z_m", kNumber, "m", "waist frame B, z", "W", CsvInterpolation::kLinear},
      {"zmp_planned_x_m", kNumber, "m", "planned ZMP at the row's middle, x", "W"},
      {"zmp_planned_y_m", kNumber, "m", "planned ZMP at the row's middle, y", "W"},
      {"zmp_measured_x_m", kNumber, "m", "from the contact forces, x; nan: in flight", "W"},
      {"zmp_measured_y_m", kNumber, "m", "from the contact forces, y; nan: in flight", "W"},
      {"zmp_error_x_m", kNumber, "m", "measured less planned ZMP, x", "carrying sole"},
      {"zmp_error_y_m", kNumber, "m", "measured less planned ZMP, y", "carrying sole"},
      {"left_foot_force_n", kNumber, "N", "vertical force on the left sole" + mean, "W"},
      {"right_foot_force_n", kNumber, "N", "vertical force on the right sole" + mean, "W"},
      {"slip_m", kNumber, "m", "of a carrying sole since it took up load, the larger of both"},
      {"support_drift_x_m", kNumber, "m", support + "x; nan: none carries", "W"},
      {"support_drift_y_m", kNumber, "m", support + "y; nan: none carries", "W"},
      {"support_drift_yaw_rad", kNumber, "rad", support + "yaw; nan: none carries", "W"},
      {"stray_m", kNumber, "m",
       "farthest of waist and soles from their plan, shifted with the support"},
      {"touch_n", kNumber, "N", "greatest force between a body and an obstacle; 0: none touch"},
  });
  for (const ReplayRow& row : rows) {
    csv.Cell(row.t).Cell(row.tilt).Cell(row.waist.x()).Cell(row.waist.y()).Cell(row.waist.z());
    for (const Eigen::Vector2d& p : {row.zmp_planned, row.zmp_measured, row.zmp_error}) {
      csv.Cell(p.x()).Cell(p.y());
    }
    csv.Cell(row.vertical[0]).Cell(row.vertical[1]).Cell(row.slip);
    for (const double part : row.support_drift) csv.Cell(part);
    csv.Cell(row.stray).Cell(row.touch).EndRow();
  }
  return csv.file();
}

}  // namespace halfstep::replay
