#pragma once

#include "smoothing/methods/methods.h"

namespace halfstep {

/// The whole program `halfstep`: reads the command line, runs the command, and returns the exit
/// status of experiments/README.md. A program of one's own hands over Methods with the smoothers
/// and solvers that it adds, and registers planners, costs and margins before: configs may name
/// them beside all that is built in. Throws nothing; every error is told on standard error.
int RunExperiment(int argc, char** argv, const Methods& methods = Methods::Standard());

}  // namespace halfstep
