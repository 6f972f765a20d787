#pragma once

#include <vector>

#include "experiments/plot/layout.h"

namespace halfstep::plot {

/// Places for the labels of a panel's lines and areas, within its frame: beside what they name,
/// clear of each other and of `taken`, where there is room also of lines and outlines, and nearer
/// to their own than to others.
std::vector<PlacedText> DirectLabels(const PlacedPanel& panel, const TextMeasure& measure,
                                     const std::vector<PageBox>& taken);

}  // namespace halfstep::plot
