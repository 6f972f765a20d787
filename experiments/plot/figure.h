#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace halfstep::plot {

/// Of a printer's point: 1/72 inch. All lengths on the page are in points [pt].
inline constexpr double kPointsPerInch = 72.0;

/// Red, green and blue, each 0 … 1.
struct Color {
  double r = 0.0;  ///< red
  double g = 0.0;  ///< green
  double b = 0.0;  ///< blue
};

/// How a line is drawn.
struct Stroke {
  Color color = {};               ///< of the ink
  double width = 0.9;             ///< [pt]
  std::vector<double> dash = {};  ///< lengths of ink and gap in turn [pt]; empty: solid
};

/// A line through points, in the units of its panel's axes; it breaks where one is not finite.
struct Line {
  std::string name;                     ///< what it draws: "dichotomy/com_y_m"
  std::vector<Eigen::Vector2d> points;  ///< (x, y)
  Stroke stroke = {};                   ///< how
  std::string label = {};               ///< written beside it; "": nothing is
};

/// A polygon, in the units of its panel's axes.
struct Area {
  std::string name;                      ///< what it draws: "left sole", "bar"
  std::vector<Eigen::Vector2d> corners;  ///< (x, y), without the first one again
  std::optional<Color> fill = {};        ///< none: it is not filled
  std::optional<Stroke> outline = {};    ///< none: it has none
  bool hatched = false;                  ///< with grey lines across
  std::string label = {};                ///< written in it or beside it; "": nothing is
  bool label_inside = false;             ///< it is left out where it does not fit into the area
  Color ink = {};                        ///< of the label
};

/// A disc about a point.
struct Mark {
  Eigen::Vector2d at;   ///< (x, y) in the units of the axes
  double radius = 1.6;  ///< [pt]
  Color fill = {};      ///< of it and its outline
  bool open = false;    ///< white inside
};

/// A word that is centred about a point.
struct Word {
  Eigen::Vector2d at;  ///< (x, y) in the units of the axes
  std::string text;    ///< what is written
  Color ink = {};      ///< of the text
  bool after = false;  ///< begins there, in place of being centred
};

/// A number on an axis, and how it is written.
struct Tick {
  double at = 0.0;   ///< in the axis' unit
  std::string text;  ///< beside it
};

/// One axis of a panel.
struct Axis {
  std::string label = {};        ///< with its unit: "time [s]"; "": nothing is written
  double low = 0.0;              ///< where it begins, in its unit
  double high = 1.0;             ///< where it ends
  bool logarithmic = false;      ///< its numbers are above 0 then
  std::vector<Tick> ticks = {};  ///< empty: chosen (ticks.h)
};

/// A frame with axes and what is drawn in it: areas, then lines, then marks, then words.
struct Panel {
  std::string title = {};  ///< above it; "": nothing is
  Axis x = {};             ///< to the right
  Axis y = {};             ///< upwards
  double height = 60.0;    ///< of the frame [pt]
  /// Whether a unit is as long on both axes, so that the frame's width says its height; not where
  /// it would be lower than `height`.
  bool equal = false;
  bool numbers_below = true;     ///< whether the numbers and the label of x are written
  std::string note = {};         ///< in the upper left corner
  std::vector<Area> areas = {};  ///< the lowest first
  std::vector<Line> lines = {};  ///< over them
  std::vector<Mark> marks = {};  ///< over those
  std::vector<Word> words = {};  ///< over all
};

/// Panels beside each other.
using Row = std::vector<Panel>;

/// What is drawn, from above to below.
struct Figure {
  std::string title;      ///< of the file, not drawn
  double width = 0.0;     ///< [pt]
  std::vector<Row> rows;  ///< from above to below
};

}  // namespace halfstep::plot
