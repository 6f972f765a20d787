#pragma once

#include <string>

#include "smoothing/methods/method_options.h"
#include "smoothing/methods/overlap_optimizer.h"
#include "smoothing/methods/pareto.h"

namespace halfstep {

/// Options of the methods that are solvers, as `smoothing.optimizer` gives them.
struct SolverMethodOptions {
  std::string program = "fastest";  ///< a name of ProgramKind, or "pareto": a ParetoCurve
  bool all_families = true;         ///< all families of `options` are variables unless told not to
  OptimizerOptions options;         ///< also holds for the solvers of ParetoCurve
  ParetoOptions pareto;             ///< used where `program` is `pareto`

  /// As without a key: over all families of half-steps.
  SolverMethodOptions();
};

/// `smoothing.optimizer`.
OptionGroup<SolverMethodOptions> OptimizerGroup();
/// Declares its keys.
void DeclareFields(Fields& fields, SolverMethodOptions* options);

/// "overlaps+heights": the names of the families that a method may move.
std::string VariableNames(const ParameterChoice& choice);
/// What a manifest says of a method with these options (Smoother::DeclareRequest).
void DeclareSolverRequest(Fields& fields, SolverMethodOptions options);

}  // namespace halfstep
