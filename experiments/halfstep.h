#pragma once

/// Everything that a program of one's own usually needs (experiments/examples).
#include "experiments/commands/run_experiment.h"
#include "experiments/config/data_folder.h"
#include "experiments/config/experiment.h"
#include "experiments/run/experiment_run.h"
#include "experiments/run/planning.h"
#include "experiments/run/smoothing_of.h"
#include "opt/adapters/function_solver.h"
#include "opt/adapters/solver_registry.h"
#include "planner/search/planner_registry.h"
#include "smoothing/margins/own_margin.h"
#include "smoothing/methods/methods.h"
#include "smoothing/methods/solver_method_options.h"
#include "smoothing/program/walk_cost.h"
#include "smoothing/proof/certified_feasibility.h"
#include "smoothing/proof/sampled_feasibility.h"
#include "wpg/files/input_error.h"
