#include "experiments/plot/style.h"

#include <array>

namespace halfstep::plot::style {

Stroke LineOf(Side side) {
  if (side == Side::kLeft) return {.color = Of(side), .width = 1.0};
  return {.color = Of(side), .width = 1.0, .dash = {4.0, 1.6}};
}

Stroke ComLine() { return {.color = kBlack, .width = 0.9}; }

Stroke ZmpLine() { return {.color = kGreen, .width = 1.0, .dash = {3.0, 1.2}}; }

Stroke Nth(int index) {
  static constexpr std::array kColors = {kBlack, kVermilion, kBlue, kGreen, kPurple, kOrange, kSky};
  static const std::array<std::vector<double>, 4> kDashes = {
      std::vector<double>{}, {4.0, 1.6}, {1.2, 1.2}, {5.0, 1.4, 1.2, 1.4}};
  return {.color = kColors[static_cast<size_t>(index) % kColors.size()],
          .width = 1.0,
          .dash = kDashes[static_cast<size_t>(index) % kDashes.size()]};
}

}  // namespace halfstep::plot::style
