#pragma once

#include <Eigen/Core>
#include <memory>

#include "opt/problem/problem.h"
#include "smoothing/program/overlap_variables.h"
#include "smoothing/program/walk_cost.h"

namespace halfstep {

class OverlapProgram;

/// The costs that programs minimize; each borrows its program.
std::unique_ptr<opt::CostTerm> MakeDurationCost(const OverlapProgram& program);  ///< D [s]
/// Weighted roughness (WeightedRoughness) [s].
std::unique_ptr<opt::CostTerm> MakeRoughnessCost(const OverlapProgram& program);
/// A cost of one's own, in its unit.
std::unique_ptr<opt::CostTerm> MakeOwnCost(const OverlapProgram& program,
                                           std::shared_ptr<const WalkCost> cost);
/// −z, where z is the last variable.
std::unique_ptr<opt::CostTerm> MakeLeastSlackCost();

/// ∂D/∂parameter.
ParameterGradient DurationGradient(const HalfStepSequence& sequence);
/// The gradient (n) with respect to x of what has the derivatives `gradient` along parameters; x
/// may have more entries than there are variables.
Eigen::VectorXd Pulled(const OverlapVariables& variables, const ParameterGradient& gradient,
                       const Eigen::VectorXd& x);

}  // namespace halfstep
