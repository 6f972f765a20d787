#pragma once

#include <functional>
#include <vector>

#include "smoothing/program/overlap_program.h"
#include "smoothing/proof/stretch_proofs.h"
#include "smoothing/walk/homotopy_parameters.h"
#include "wpg/motion/half_step_sequence.h"

namespace halfstep {

/// Keeps the best point of the homotopy that was proved, the incumbent. A candidate replaces it
/// only if it costs less and that was proved. Where one is refused, the half-steps around the
/// refusal become longer; where that does not help, their steps go only a part of the way, or none.
/// So whatever proposes candidates may stop at any moment.
class Incumbent {
 public:
  /// What the incumbent is compared by, and where it may move.
  struct Rules {
    /// What a point costs if it is feasible; +inf: the point is not wanted.
    std::function<double(const HomotopyParameters&)> cost;
    /// Proves that `walk` deserves `cost`. Returns the margins that refuse it; empty: none.
    std::function<std::vector<Margin>(const SuperposedWalk& walk, double cost,
                                      MarginEvaluator::Scratch*)>
        prove;
    /// Called with every new incumbent; may be empty.
    std::function<void(const HomotopyParameters&)> accepted = {};
    /// Candidates must cost less than the incumbent by more than this.
    double improvement = 1e-9;
    /// Whether a refusal holds back only the parameters near it; if not, it holds back all alike.
    bool local = true;
    /// What half-steps may last at most where they are refused (n) [s]; empty: as the candidate's.
    std::vector<double> longest = {};
  };

  /// Precondition: `start` was proved to cost `cost`. `sequence` and `scratch` are borrowed.
  Incumbent(const HalfStepSequence& sequence, Rules rules, HomotopyParameters start, double cost,
            MarginEvaluator::Scratch* scratch);

  /// Moves the incumbent to a candidate where that is proved, trying at most `attempts` ≥ 1 points.
  /// Half-steps that are `held` are longer, or stay as they are, from the first point on. Returns
  /// how far it moved, ∈ [0, 1], as a mean over the half-steps.
  double Toward(const HomotopyParameters& candidate, int attempts,
                const std::vector<bool>& held = {});

  /// The candidate, but steps with half-steps that are `held` as in the incumbent. Not proved.
  HomotopyParameters Beside(const HomotopyParameters& candidate,
                            const std::vector<bool>& held) const;

  /// The best point that was proved.
  const HomotopyParameters& parameters() const { return parameters_; }
  double cost() const { return cost_; }        ///< of that point
  long accepted() const { return accepted_; }  ///< points that became the incumbent
  long refused() const { return refused_; }    ///< points that cost less and were not proved
  /// The margins that refused the last candidate itself; empty when none did.
  const std::vector<Margin>& refusals() const { return refusals_; }

 private:
  // Takes the point if it costs less and is proved; `refusals`: why it is not proved.
  bool Replace(const HomotopyParameters& point, std::vector<Margin>* refusals);
  HomotopyParameters Lengthened(const HomotopyParameters& candidate,
                                const std::vector<int>& times) const;
  HomotopyParameters Between(const HomotopyParameters& candidate,
                             const std::vector<double>& lambda) const;

  const HalfStepSequence& sequence_;
  Rules rules_;
  HomotopyParameters parameters_;
  double cost_;
  MarginEvaluator::Scratch* scratch_;
  long accepted_ = 0, refused_ = 0;
  std::vector<Margin> refusals_;
};

/// `fastest` and `smooth`: a walk deserves its cost when it meets what is demanded. Both are
/// borrowed.
Incumbent::Rules DemandedRules(const OverlapProgram& program, StretchProofs* proofs);

/// `safest`: a walk that lasts no longer than it may deserves the cost −z, z ≥ 0, when it meets
/// what is demanded plus z times the family's scale, for the families of Raised(). `within_limit`:
/// whether the first incumbent lasts no longer; if not, only z = 0 is asked of the first walk that
/// does. `program` and `test` are borrowed.
Incumbent::Rules SafestRules(const OverlapProgram& program, const FeasibilityTest& test,
                             bool within_limit);

}  // namespace halfstep
