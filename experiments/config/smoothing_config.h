#pragma once

#include <optional>
#include <string>
#include <vector>

#include "smoothing/margins/margin.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/horizon.h"
#include "smoothing/methods/overlap_optimizer.h"
#include "smoothing/methods/pareto.h"
#include "smoothing/proof/certificate.h"
#include "wpg/files/fields.h"

namespace halfstep {

/// Options of the methods that are solvers.
struct OptimizerConfig {
  std::string program = "fastest";  ///< one of the names of ProgramKind
  bool all_families = true;         ///< all families of `options` are variables unless told not to
  bool families_chosen = false;     ///< whether `options` has heard of `all_families` already
  OptimizerOptions options;         ///< also holds for the solvers of ParetoCurve
  ParetoOptions pareto;             ///< used where `program` is `pareto`
};

/// A parameter that methods leave alone, as a config names it: "overlap", 3 (from 1).
struct FixedConfig {
  std::string parameter = "overlap";  ///< the name of a parameter family
  int index = 1;                      ///< junction, step or half-step of the family, from 1
  std::optional<double> value;        ///< in the family's unit; none: as planned
};

/// Files that hold a walk of one's own, with columns of overlaps.csv and half_steps.csv; "": none.
struct GivenWalkFiles {
  std::string overlaps;    ///< one row a junction
  std::string half_steps;  ///< one row a half-step
};

/// The group `smoothing`: the methods, and what they have to keep.
struct SmoothingConfig {
  std::vector<std::string> methods = {"dichotomy"};  ///< in the order in which they run
  std::string acceptance = "certified";  ///< "certified" or "sampled": how a method accepts a walk
  double sampling = 0.005;               ///< period of acceptance `sampled` [s]
  std::string stop_branches = "none";    ///< one of the names of StopBranches
  bool repair_plan = false;              ///< RepairPlan() before the methods
  int threads = 1;                       ///< of searches and proofs, the caller's included
  CertificationOptions certification;    ///< of proofs, whatever `acceptance` is
  DichotomyOptions dichotomy;            ///< of the dichotomy and of the methods that begin with it
  OptimizerConfig optimizer;             ///< of the methods that are solvers
  HorizonOptions horizon;                ///< window, step and passes
  std::vector<FixedConfig> fixed;        ///< parameters that no method moves
  bool has_given = false;                ///< whether `given` names files
  GivenWalkFiles given;                  ///< of the method `given`
  MarginLimits limits;                   ///< limits and demanded margins
};

/// Declares the keys of the group.
void DeclareSmoothing(Fields& fields, SmoothingConfig* config);
/// Those of `smoothing.optimizer` and of `smoothing.horizon`.
void DeclareOptimizer(Fields& fields, OptimizerConfig* config);
/// Windows of the method halfstep/horizon.
void DeclareHorizon(Fields& fields, HorizonOptions* options);

/// The parameters that a config fixes. Precondition: each names a family, which reading ensures.
std::vector<FixedParameter> FixedParameters(const SmoothingConfig& config);

}  // namespace halfstep
