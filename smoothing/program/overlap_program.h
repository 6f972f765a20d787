#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>
#include <vector>

#include "opt/problem/problem.h"
#include "smoothing/program/overlap_variables.h"
#include "smoothing/program/walk_cost.h"
#include "smoothing/program/walk_roughness.h"
#include "smoothing/program/watched_instants.h"

namespace halfstep {

/// What a program optimizes.
enum class ProgramKind {
  kFastest,  ///< minimize D
  kSmooth,   ///< minimize D + weights · (roughness, own costs)
  kSafest,   ///< maximize the least slack of Raised() with D at most a given duration
};
std::string_view Name(ProgramKind kind);  ///< "fastest" …

/// The families whose least slack `safest` maximizes (FamilyTraits::raised). The others are kept at
/// what is demanded.
std::array<bool, kNumMarginFamilies> Raised();

/// Selects a nonlinear program over a sequence's homotopy parameters.
struct ProgramOptions {
  ProgramKind kind = ProgramKind::kFastest;     ///< the objective
  ParameterChoice parameters;                   ///< beside the overlaps
  RoughnessWeights weights = {0.05, 0.0, 0.0};  ///< of `smooth`
  std::vector<WeightedWalkCost> own_costs;      ///< of `smooth`, too
  WatchOptions watch;                           ///< instants at which margins are rows
};

/// What the walk of `parameters` costs by `fastest` or `smooth` [s]. Precondition: not `safest`.
double CostOf(const HalfStepSequence& sequence, const HomotopyParameters& parameters,
              const ProgramOptions& options);

/// A program over the variables of OverlapVariables, and for `safest` the slack z as the last one:
///
///     fastest   minimize D                        subject to  slacks ≥ 0
///     smooth    minimize D + weights · roughness     subject to  slacks ≥ 0
///               + weights · own costs
///     safest    minimize −z                       subject to  raised slacks ≥ z, others ≥ 0,
///                                                             D ≤ duration_limit
///
/// Slacks are scaled margins, gathered by WatchedInstants. Source: smoothing/README.md, "Overlap
/// program".
class OverlapProgram {
 public:
  /// `sequence` and `evaluator` are borrowed and must outlive this and its problems.
  /// `duration_limit` [s] counts for `safest` only. Fixed parameters are not variables.
  OverlapProgram(const HalfStepSequence& sequence, const MarginEvaluator& evaluator,
                 const ProgramOptions& options, double duration_limit,
                 const std::vector<FixedParameter>& fixed = {});
  OverlapProgram(const OverlapProgram&) = delete;
  OverlapProgram& operator=(const OverlapProgram&) = delete;

  /// The problem borrows this. It also watches instants that are learned later.
  opt::Problem MakeProblem() const;

  const ProgramOptions& options() const { return options_; }        ///< as given
  const OverlapVariables& variables() const { return variables_; }  ///< what x stands for
  const WatchedInstants& watched() const { return watched_; }       ///< instants, and their rows
  WatchedInstants& watched() { return watched_; }  ///< the same, to learn further instants
  double duration_limit() const { return duration_limit_; }  ///< of `safest` [s]; ∞: none

  /// x (n) of a point of the homotopy; for `safest` z is its least slack at the instants watched.
  Eigen::VectorXd ToVariables(const HomotopyParameters& parameters) const;
  /// The point that x (n) stands for.
  HomotopyParameters ToParameters(const Eigen::VectorXd& x) const {
    return variables_.ToParameters(x);
  }

  /// The cost of a point [s]; for `safest` minus the least raised slack at the instants watched,
  /// +inf when D is above the limit.
  double Cost(const HomotopyParameters& parameters) const;

 private:
  ProgramOptions options_;
  double duration_limit_;
  OverlapVariables variables_;
  WatchedInstants watched_;  // borrows variables_
};

}  // namespace halfstep
