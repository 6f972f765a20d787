#pragma once

namespace halfstep {

/// The whole program `halfstep`: reads the command line, runs the command, and returns the exit
/// status of experiments/README.md. A program of one's own first registers what it adds (a
/// smoother, a solver, a planner, a cost) and then calls this: configs may name it from there on,
/// beside all that is built in. Throws nothing; every error is told on standard error.
int RunExperiment(int argc, char** argv);

}  // namespace halfstep
