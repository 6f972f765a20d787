#pragma once

#include "experiments/plot/figure.h"
#include "wpg/geometry/side.h"

// What all figures share. Lines differ in dash and in lightness as well as in colour, so that they
// are told apart in print without colours.
namespace halfstep::plot::style {

inline constexpr double kTextSize = 7.0;    ///< of all text [pt]
inline constexpr double kLineHeight = 8.4;  ///< from one line of text to the next [pt]
inline constexpr double kCapHeight = 5.1;   ///< of text above its line [pt]
inline constexpr double kDescent = 1.5;     ///< of text below its line [pt]
inline constexpr double kTickLength = 2.2;  ///< [pt]
inline constexpr double kPad = 2.0;         ///< between text and what it is about [pt]
inline constexpr double kFrameWidth = 0.5;  ///< of axes [pt]

// Colours that colour-blind readers can tell apart, after Okabe and Ito.
inline constexpr Color kBlack{0, 0, 0};              ///< of the CoM, axes and text
inline constexpr Color kBlue{0, 0.447, 0.698};       ///< of the left
inline constexpr Color kVermilion{0.835, 0.369, 0};  ///< of the right
inline constexpr Color kGreen{0, 0.62, 0.451};       ///< of the ZMP
inline constexpr Color kOrange{0.902, 0.624, 0};     ///< of other lines
inline constexpr Color kPurple{0.8, 0.475, 0.655};   ///< of other lines
inline constexpr Color kSky{0.337, 0.706, 0.914};    ///< of other lines
inline constexpr Color kWhite{1, 1, 1};              ///< of paper
/// A grey, 0 black … 1 white.
constexpr Color Grey(double light) { return {light, light, light}; }
/// A colour on its way to white: share 0 is the colour.
constexpr Color Lighter(const Color& c, double share) {
  return {c.r + (1 - c.r) * share, c.g + (1 - c.g) * share, c.b + (1 - c.b) * share};
}

/// The colour of what is of a foot or leg.
constexpr Color Of(Side side) { return side == Side::kLeft ? kBlue : kVermilion; }
/// The same of its lines.
Stroke LineOf(Side side);
Stroke ComLine();  ///< of the CoM
Stroke ZmpLine();  ///< of the ZMP; drawn below the CoM's, so that it shows where they differ

/// The strokes of lines that are of equal rank, in their order; more than 28 repeat.
Stroke Nth(int index);

}  // namespace halfstep::plot::style
