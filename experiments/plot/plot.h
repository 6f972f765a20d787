#pragma once

#include <string>
#include <vector>

#include "experiments/config/toolbox.h"
#include "experiments/plot/figure.h"

namespace halfstep::plot {

/// What is asked for.
struct PlotRequest {
  /// Of a run, a comparison or a sweep; or a table that `halfstep list half-steps` printed, *.csv.
  std::string folder;
  std::vector<std::string> what;        ///< names of subjects; none: the first of such a folder
  std::vector<std::string> methods;     ///< of runs at most two, to be compared; none: chosen
  double width = 3.5 * kPointsPerInch;  ///< of the page [pt]
};

/// The figure of a folder: its subjects below each other, with letters where there are several. It
/// does not need cairo. Throws InputError for a folder that is none of these, for subjects and
/// methods that it does not have, and for tables that are missing or damaged.
Figure FigureOf(const PlotRequest& request, const Toolbox& tools = {});

/// The names of all subjects, as "walk, foot …", and what they show, for help.
std::string SubjectsHelp();

}  // namespace halfstep::plot
