#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <string>
#include <vector>

#include "experiments/plot/figure.h"

namespace halfstep::plot {

/// A rectangle on the page [pt], y downwards.
using PageBox = Eigen::AlignedBox2d;

/// A text on the page.
struct PlacedText {
  std::string text;      ///< what is written
  Eigen::Vector2d at;    ///< where its line begins [pt]
  PageBox box;           ///< what it covers
  bool upwards = false;  ///< turned by 90°, to be read from below to above
  bool bold = false;     ///< as titles are
  bool halo = false;     ///< on white, for it may lie on lines
  bool direct = false;   ///< beside the line or area that it names
  Color ink = {};        ///< of the text
};

/// A panel in its place.
struct PlacedPanel {
  Panel panel;    ///< with the ticks that were chosen, and the axes as they are drawn
  PageBox frame;  ///< of its axes

  /// Where a point of its axes' units is on the page [pt].
  Eigen::Vector2d ToPage(const Eigen::Vector2d& p) const;
};

/// A figure in which everything has its place.
struct PlacedFigure {
  std::string title;                ///< of the file
  double width = 0.0;               ///< of the page [pt]
  double height = 0.0;              ///< of the page [pt]
  std::vector<PlacedPanel> panels;  ///< row by row
  std::vector<PlacedText> texts;    ///< all that is written
};

/// Says how wide a text is [pt].
using TextMeasure = std::function<double(const std::string& text, bool bold)>;

/// Gives everything its place; panels of rows with equally many have their frames below each other.
/// Throws InputError when the width leaves no room for frames.
PlacedFigure PlaceFigure(const Figure& figure, const TextMeasure& measure);

}  // namespace halfstep::plot
