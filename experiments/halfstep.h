#pragma once

/// Everything that a program of one's own usually needs (experiments/examples).
#include "halfstep/experiments/commands/run_experiment.h"
#include "halfstep/experiments/config/data_folder.h"
#include "halfstep/experiments/config/experiment.h"
#include "halfstep/experiments/run/experiment_run.h"
#include "halfstep/experiments/run/planning.h"
#include "halfstep/experiments/run/smoothing_of.h"
#include "halfstep/opt/adapters/function_solver.h"
#include "halfstep/opt/adapters/solver_registry.h"
#include "halfstep/planner/search/planner_registry.h"
#include "halfstep/smoothing/margins/own_margin.h"
#include "halfstep/smoothing/methods/smoother_registry.h"
#include "halfstep/smoothing/program/walk_cost.h"
#include "halfstep/smoothing/proof/certified_feasibility.h"
#include "halfstep/smoothing/proof/sampled_feasibility.h"
#include "halfstep/wpg/files/input_error.h"
