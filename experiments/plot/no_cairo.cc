// Stands in for canvas.cc where cairo is absent or unwanted.
#include <stdexcept>

#include "experiments/plot/canvas.h"

namespace halfstep::plot {

std::string WhyNoPlots() { return HALFSTEP_WHY_NO_CAIRO; }

double TextWidth(const std::string&, bool) { throw std::logic_error(WhyNoPlots()); }

std::string Drawn(const PlacedFigure&, FileKind) { throw std::logic_error(WhyNoPlots()); }

}  // namespace halfstep::plot
