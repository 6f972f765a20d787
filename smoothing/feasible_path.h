#pragma once

#include <functional>
#include <optional>

#include "smoothing/feasibility_test.h"
#include "smoothing/homotopy_parameters.h"
#include "wpg/half_step_sequence.h"

namespace halfstep {

/// Keeps the best point of the homotopy that was proved, the incumbent. A candidate replaces it
/// only if it costs less and that was proved; one that is refused is approached from the incumbent,
/// along the straight line of the parameters, as far as the proof allows. So whatever proposes
/// candidates may stop at any moment.
class FeasiblePath {
 public:
  struct Rules {
    /// What a point would cost if it is feasible; +inf: not wanted at all.
    std::function<double(const HomotopyParameters&)> cost;
    /// Decides whether `walk` deserves `cost`. The incumbent is proved with `incumbent_cost`.
    std::function<Feasibility(const SuperposedWalk& walk, double cost,
                              const HomotopyParameters& incumbent, MarginEvaluator::Scratch*)>
        prove;
    /// Told every new incumbent; may be empty.
    std::function<void(const HomotopyParameters&)> accepted = {};
    /// Candidates must cost less than the incumbent by more than this.
    double improvement = 1e-9;
  };

  /// Precondition: `start` was proved to cost `cost`. `sequence` is borrowed.
  FeasiblePath(const HalfStepSequence& sequence, Rules rules, HomotopyParameters start, double cost,
               MarginEvaluator::Scratch scratch);

  /// How far from the incumbent to the candidate it was moved, ∈ [0, 1]; a refused candidate is
  /// approached by so many bisections.
  double Toward(const HomotopyParameters& candidate, int bisections);

  const HomotopyParameters& incumbent() const { return incumbent_; }
  double cost() const { return cost_; }
  long accepted() const { return accepted_; }
  long refused() const { return refused_; }  ///< points that cost less and were not proved
  /// What refused the point nearest to the last candidate; none: nothing did.
  const std::optional<Margin>& refusal() const { return refusal_; }
  const MarginEvaluator::Scratch& scratch() const { return scratch_; }

 private:
  HomotopyParameters Between(const HomotopyParameters& candidate, double lambda) const;
  bool Accept(const HomotopyParameters& point);

  const HalfStepSequence& sequence_;
  Rules rules_;
  HomotopyParameters incumbent_;
  double cost_;
  MarginEvaluator::Scratch scratch_;
  long accepted_ = 0, refused_ = 0;
  std::optional<Margin> refusal_;
};

/// Proves with one test, whatever the cost: only where the walk differs from the incumbent's.
Feasibility CheckChanges(const FeasibilityTest& test, const SuperposedWalk& walk,
                         const HomotopyParameters& incumbent, MarginEvaluator::Scratch* scratch);

}  // namespace halfstep
