#pragma once

#include "experiments/config/toolbox.h"

namespace halfstep {

/// The whole program `halfstep`: reads the command line, runs the command, and returns the exit
/// status of experiments/README.md. A program of one's own hands over the smoothers,
/// solvers and planners that it adds, and registers costs and margins before: configs may name them
/// beside all that is built in. Throws nothing; every error is told on standard error.
int RunExperiment(int argc, char** argv, const Toolbox& tools = {});

}  // namespace halfstep
