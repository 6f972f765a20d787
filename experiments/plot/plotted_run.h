#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/config/toolbox.h"
#include "experiments/plot/figure.h"
#include "experiments/tables/csv_reader.h"
#include "wpg/geometry/pose2.h"
#include "wpg/geometry/side.h"

namespace halfstep::plot {

/// One walk of a run, as its tables have it.
struct PlottedWalk {
  std::string method;            ///< its name
  double duration = 0.0;         ///< [s]
  std::filesystem::path folder;  ///< in the run
  CsvTable rows;                 ///< of trajectory.csv
  std::vector<double> t;         ///< its times [s]
  /// What is demanded of the pendulum's ZMP [m]; none: nothing, or there is no certificate.
  std::optional<double> demanded_zmp = {};

  /// A column of trajectory.csv against time, each times a factor: (t, factor · value).
  std::vector<Eigen::Vector2d> OverTime(const std::string& column, double factor = 1.0) const;
  /// One column against another.
  std::vector<Eigen::Vector2d> Path(const std::string& x, const std::string& y,
                                    double factor = 1.0) const;
  /// Where the sole of a side is at each row, seen from above, in W.
  std::vector<Pose2> Soles(Side side) const;
  /// Whether that sole stands, at each row.
  std::vector<bool> Stands(Side side) const;
  /// Where it stands, one place after the other.
  std::vector<Pose2> Footprints(Side side) const;
  /// "dichotomy, 7.20 s".
  std::string Title() const;
};

/// A run folder, as far as it is drawn.
struct PlottedRun {
  std::filesystem::path folder;    ///< of the run
  std::string name;                ///< of its scenario
  Place place;                     ///< robot and scene
  double joint_speed_scale = 1.0;  ///< of the robot's limits, as the config has it
  std::vector<PlottedWalk> walks;  ///< that are drawn: one or two

  bool compares() const { return walks.size() > 1; }  ///< two walks are drawn
  double duration() const;                            ///< of the longest walk [s]
};

/// Reads a run and the walks of one or two methods; none named: the shortest that is certified,
/// else raw. Throws InputError for what is no whole run folder, for a method that it does not have,
/// and when robot or scene are no longer those of the run.
PlottedRun ReadPlottedRun(const std::filesystem::path& run, const std::vector<std::string>& methods,
                          const Toolbox& tools);

/// The least and the largest number of columns of points; grows from empty.
struct Extent {
  double low = 1e300;    ///< the least
  double high = -1e300;  ///< the largest
  /// Takes in what is finite.
  void Add(double value);
  /// Takes in coordinate `k` of points.
  void Add(const std::vector<Eigen::Vector2d>& points, int k);
  /// An axis over it, wider by a share of its length at both ends; at least `least` long.
  Axis WithMargin(const std::string& label, double share = 0.06, double least = 1e-3) const;
};

/// Panels with the same axes of walks that are compared: beside each other where they are higher
/// than `high` times their width, else below each other.
std::vector<Row> Compared(std::vector<Panel> panels, double high);

}  // namespace halfstep::plot
