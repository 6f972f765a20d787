#include "experiments/commands/run_experiment.h"

int main(int argc, char** argv) { return halfstep::RunExperiment(argc, argv); }
