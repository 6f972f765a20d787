#pragma once

#include <optional>
#include <string>
#include <vector>

#include "opt/solvers/ending.h"
#include "smoothing/margins/margin.h"
#include "smoothing/methods/accepted_walk.h"
#include "smoothing/proof/feasibility_test.h"
#include "smoothing/walk/homotopy_parameters.h"

namespace halfstep {

/// What limits one overlap.
struct JunctionResult {
  JunctionKind kind = JunctionKind::kUpDown;  ///< which half-steps the junction is between
  double overlap = 0.0;                       ///< accepted Δ [s]
  double upper_bound = 0.0;                   ///< largest that was allowed [s]
  bool fixed = false;                         ///< the caller fixed it
  /// The margin that refused the smallest infeasible overlap tried; none: the upper bound holds.
  std::optional<Margin> limited_by = std::nullopt;
  /// Sum of the multipliers of the program's rows in the limiting family, of the half-steps on both
  /// sides: to first order the time that demanding one unit of the family's scale less there would
  /// save, all parameters adapting [s]. None when no program was solved.
  std::optional<double> multiplier = std::nullopt;
  /// To first order the time that demanding one unit of the limiting family's scale less would save
  /// by this overlap alone [s]. None when nothing limits it, or the margin does not depend on Δ.
  std::optional<double> price = std::nullopt;
};

/// A walk of a ParetoCurve: no safer one was found that lasts no longer.
struct ParetoPoint {
  double duration = 0.0;          ///< [s]
  double least_slack = 0.0;       ///< proved for the families of Raised(), of their scales
  HomotopyParameters parameters;  ///< of the walk
};

/// One candidate that a method tried.
struct SmoothingIterate {
  double wall = 0.0;                ///< since the method began [s]
  long instants = 0;                ///< evaluated so far (Work::evaluated)
  double effort = 0.0;              ///< used so far (Work::effort)
  double candidate_duration = 0.0;  ///< [s]
  std::optional<double> candidate_worst_margin =
      std::nullopt;  ///< MarginLimits::Slack where it was violated
  /// Whether the candidate, or a point on the way to it, became the incumbent.
  bool accepted = false;
  double lambda = 0.0;  ///< how far from incumbent to candidate it was accepted, ∈ [0, 1]
  double incumbent_duration = 0.0;  ///< after this iterate [s]
  /// Least slack of the incumbent at the program's instants; none: not evaluated.
  std::optional<double> incumbent_slack = std::nullopt;
  double incumbent_cost = 0.0;  ///< of the program, after this iterate
};

/// What a smoothing method found.
struct SmoothingResult {
  /// With kConverged, kLimit, kDeadline and kInterrupted the walk is one of the method's own and
  /// costs less than what it was started from: the planned motion, for programs the dichotomy's
  /// walk. With the others it is that start, or what a plain dichotomy makes of it.
  opt::Ending ending = opt::Ending::kNotRun;
  std::string message = "the method has not run";  ///< a sentence on the ending
  /// Whether `parameters` were found feasible, in the sense of `evidence`. If not, they are the
  /// start, which misses a margin.
  bool feasible = false;
  Evidence evidence = Evidence::kSampled;  ///< how `feasible` was found
  /// The same walk as it was accepted; none unless `feasible`, which nobody believes without it.
  std::optional<AcceptedWalk> accepted = std::nullopt;
  HomotopyParameters parameters;  ///< of the walk; the best that was proved
  /// Cost by the program [s]; for `safest` minus the proved least slack, +inf when no walk within
  /// its duration was proved.
  double cost = 0.0;
  /// Proved: no walk of the problem is shorter [s]. Only `reference/lipm` tells it.
  std::optional<double> lower_bound;
  std::vector<JunctionResult> junctions;   ///< one for each junction, in their order
  std::vector<SmoothingIterate> iterates;  ///< in the order of time; not all methods have any
  std::vector<ParetoPoint> pareto;         ///< by duration; empty but for ParetoCurve
  Work work = {};                          ///< that was done
  long raw_infeasible = 0;       ///< candidates of a solver that were not feasible themselves
  bool raw_end_feasible = true;  ///< the solver's end was accepted, or not better and not tried
  long collision_queries = 0;    ///< of bodies with the scene or each other, not culled
  double wall = 0.0;             ///< [s]
  /// Until the first accepted improvement [s]; none when nothing was improved.
  std::optional<double> time_to_first_improvement;
};

}  // namespace halfstep
