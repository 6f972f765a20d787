#pragma once

#include <functional>

#include "smoothing/feasibility_test.h"
#include "smoothing/homotopy_parameters.h"
#include "wpg/half_step_sequence.h"

namespace halfstep {

/// Keeps the best feasible point of the homotopy that was met, the incumbent. A candidate replaces
/// it only if it costs less and was found feasible by `test`; an infeasible one is approached from
/// the incumbent, along the straight line of the parameters, as far as feasibility allows. So
/// whatever proposes candidates may stop at any moment.
class FeasiblePath {
 public:
  using Cost = std::function<double(const HomotopyParameters&)>;

  /// Precondition: `start` was found feasible by `test`. `sequence` and `test` are borrowed.
  FeasiblePath(const HalfStepSequence& sequence, const FeasibilityTest& test,
               HomotopyParameters start, Cost cost);

  /// How far from the incumbent to the candidate it was moved; 0: not at all.
  double Toward(const HomotopyParameters& candidate);

  const HomotopyParameters& incumbent() const { return incumbent_; }
  double cost() const { return cost_of_incumbent_; }
  /// Candidates, or points on the way to one, that were refused by the test.
  long refused() const { return refused_; }
  const MarginEvaluator::Scratch& scratch() const { return scratch_; }

 private:
  HomotopyParameters Between(const HomotopyParameters& candidate, double lambda) const;
  bool Accept(const HomotopyParameters& point);

  const HalfStepSequence& sequence_;
  const FeasibilityTest& test_;
  Cost cost_;
  HomotopyParameters incumbent_;
  double cost_of_incumbent_;
  MarginEvaluator::Scratch scratch_;
  long refused_ = 0;
};

/// D = Σ T − Σ Δ [s].
double DurationOf(const HomotopyParameters& parameters);

}  // namespace halfstep
