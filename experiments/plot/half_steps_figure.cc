#include <algorithm>

#include "experiments/plot/style.h"
#include "experiments/plot/subjects.h"
#include "experiments/tables/csv_reader.h"
#include "wpg/elementary.h"
#include "wpg/files/input_error.h"

namespace halfstep::plot {
namespace {

using Eigen::Vector2d;

constexpr double kToes = 0.03;   // length of the line towards the toes [m]
constexpr double kArrow = 0.11;  // of the support sole's [m]

// As one looks down on the robot: ahead is up, and the left is left.
Vector2d Above(double x, double y) { return {-y, x}; }

}  // namespace

std::vector<Row> HalfStepsRows(const std::filesystem::path& table) {
  const CsvTable csv = ReadCsv(table.string());
  if (!csv.Has("half_step")) {
    throw InputError(
        {csv.path +
         ": is no table of `halfstep list half-steps` (valid: such a table, or a folder)"});
  }
  const std::vector<double> x = csv.Numbers("x_m"), y = csv.Numbers("y_m"),
                            yaw = csv.Numbers("yaw_rad");
  if (x.empty()) throw InputError({csv.path + ": has no half-step"});
  Panel panel;
  panel.equal = true;
  panel.height = 0.0;
  Extent across, ahead;
  for (size_t i = 0; i < x.size(); ++i) {
    const Vector2d at = Above(x[i], y[i]);
    const Vector2d toes = Above(x[i] + kToes * Cos(yaw[i]), y[i] + kToes * Sin(yaw[i]));
    panel.lines.push_back({.name = "toes",
                           .points = {at, toes},
                           .stroke = {.color = style::Of(Side::kRight), .width = 0.6}});
    panel.marks.push_back({.at = at, .radius = 0.9, .fill = style::kBlack});
    across.Add({at, toes}, 0);
    ahead.Add({at, toes}, 1);
  }
  const Vector2d sole = Above(0.0, 0.0), front = Above(kArrow, 0.0);
  across.Add({sole, front}, 0);
  ahead.Add({sole, front}, 1);
  panel.lines.push_back({.name = "support sole",
                         .points = {sole, front},
                         .stroke = {.color = style::Of(Side::kLeft), .width = 1.4},
                         .label = "left sole, supports"});
  panel.marks.push_back({.at = sole, .radius = 2.0, .fill = style::Of(Side::kLeft)});
  panel.x = across.WithMargin("to the right, −y [m]");
  panel.y = ahead.WithMargin("ahead, x [m]");
  return {{std::move(panel)}};
}

}  // namespace halfstep::plot
