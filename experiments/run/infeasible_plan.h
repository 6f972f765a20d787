#pragma once

#include <nlohmann/json_fwd.hpp>
#include <stop_token>
#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "smoothing/methods/walk_problem.h"
#include "smoothing/proof/missed_demands.h"

namespace halfstep {

/// Why a walk is not feasible, and what would help.
struct InfeasibleWalk {
  std::string method;               ///< "raw", the planned motion, or "given"
  std::vector<std::string> inputs;  ///< LookAtFootsteps: what the config may have wrong
  MissedDemands missed;             ///< of the walk
  std::vector<std::string> help;    ///< what was tried, and how it went: FindRemedies; of `raw`
};

/// Explains the planned motion of an experiment, which misses `missed`. Trying remedies ends with
/// `stop`.
InfeasibleWalk ExplainPlan(const Experiment& experiment, const WalkProblem& problem,
                           MissedDemands missed, const std::stop_token& stop);
/// All of it as lines to be told under a heading: what the inputs have wrong, MissedDemandsText,
/// what helps.
std::vector<std::string> InfeasibleText(const WalkProblem& problem, const InfeasibleWalk& walk);
/// The same as an object: inputs, missed (MissedDemandsJson), instants, help.
nlohmann::ordered_json InfeasibleJson(const WalkProblem& problem, const InfeasibleWalk& walk);
/// Text of infeasible.json of a run folder: these objects by the name of their method.
std::string InfeasibleJsonText(const WalkProblem& problem,
                               const std::vector<InfeasibleWalk>& walks);

}  // namespace halfstep
