#pragma once

#include <string>
#include <string_view>

#include "experiments/plot/layout.h"

namespace halfstep::plot {

/// A sentence that says why this build cannot draw; "" when it can.
std::string WhyNoPlots();

/// The kinds of files.
enum class FileKind {
  kPdf,  ///< fonts are embedded
  kSvg,  ///< text as outlines
  kPng,  ///< 300 dots an inch
};

/// How wide a text is in the figures' font [pt]. Precondition of both: WhyNoPlots() is "".
double TextWidth(const std::string& text, bool bold);

/// The bytes of a file with the figure. The same figure, fonts and library give the same bytes, in
/// a process of its own. Throws std::runtime_error with cairo's reason where it cannot draw.
std::string Drawn(const PlacedFigure& figure, FileKind kind);

}  // namespace halfstep::plot
