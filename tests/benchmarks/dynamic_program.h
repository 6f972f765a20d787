#pragma once

#include <unordered_map>
#include <vector>

#include "smoothing/margins/margin_evaluator.h"
#include "wpg/motion/half_step_sequence.h"

namespace halfstep {

/// One choice of the parameters of a half-step.
struct StretchChoice {
  double overlap = 0.0;   ///< Δ with the half-step before [s]; lowered to its natural bound
  double duration = 0.0;  ///< T [s]
  double height = 1.0;    ///< η of its step; counts for up half-steps
};

/// Finds the shortest walk whose half-steps each choose from a finite list, by dynamic programming.
///
/// Half-step k is checked on its own stretch [t_k, t_{k+1}] at τ = 0, p, 2p, … and at the ends of
/// contacts. What is under way there is k and, as far as they have not ended, k − 1, k − 2 and, if
/// k is up, k − 3; the foot before the last is down. So one pass over τ with the choices of these
/// half-steps finds the longest stretch without a violation, whatever comes later, and with it
/// which overlaps with k + 1 are allowed. Exact for the lists and the instants; nothing is claimed
/// about other values or between instants.
///
/// Why no more is under way: up → down overlaps are at most σ₁ of both durations, down → up ones at
/// most the shorter duration. For an up half-step a that gives
///
///     t_{a+3} − e_a = (T_{a+1} − Δ_{a+1}) + (T_{a+2} − Δ_{a+2}) − Δ_a
///                   ≥ (T_{a+1} − Δ_{a+1}) + σ₂T_{a+2} − σ₁T_{a+1},
///
/// which is at least (σ₂ − σ₁)T_{a+2}, whichever of T_{a+1} and T_{a+2} is the shorter: a has ended
/// before a + 3 begins. A down half-step may still be under way then, and has ended before the one
/// after. So the states are the choices of k − 3 … k, of the oldest its duration alone; walks that
/// cannot become shorter than `duration` any more are dropped.
class DynamicProgram {
 public:
  using Choices = std::vector<std::vector<StretchChoice>>;  ///< by half-step

  /// `sequence` and `evaluator` are borrowed. `start`: parameters of the sequence, which hold what
  /// choices do not say. `period` [s] > 0.
  DynamicProgram(const HalfStepSequence& sequence, const MarginEvaluator& evaluator,
                 HomotopyParameters start, double period);

  /// The indices of the best choices, by half-step; empty when none is feasible and lasts at most
  /// `duration` [s], or when `stop`, asked before each half-step, returns true.
  template <typename Stop>
  std::vector<int> Solve(const Choices& choices, double duration, const Stop& stop) {
    Begin(choices, duration);
    for (int k = 0; k + 1 < sequence_.size(); ++k) {
      if (stop()) return {};
      Extend(k);
    }
    return End();
  }

  /// The parameters that the indices stand for.
  HomotopyParameters ParametersOf(const Choices& choices, const std::vector<int>& indices) const;

  /// Its counts tell the work.
  const MarginEvaluator::Scratch& scratch() const { return scratch_; }
  long passes() const { return passes_; }  ///< passes over a stretch so far

 private:
  // The best way to a combination of the last choices.
  struct State {
    double cost;       // D of what is placed [s]
    int indices[4];    // of half-steps k − 3 … k; −1 before the walk begins
    long predecessor;  // in the states of k − 1
  };

  void Begin(const Choices& choices, double duration);
  void Extend(int half_step);
  std::vector<int> End();
  const StretchChoice& choice(int half_step, int index) const {
    return (*choices_)[static_cast<size_t>(half_step)][static_cast<size_t>(index)];
  }
  // Δ between half-step − 1 and half-step.
  double Overlap(int half_step, int before, int index) const {
    const size_t k = static_cast<size_t>(half_step);
    return overlaps_[k][static_cast<size_t>(before) * (*choices_)[k].size() +
                        static_cast<size_t>(index)];
  }
  long Key(int half_step, const int* indices, bool with_first) const;
  // The end of the longest stretch of `state` without a violation, at most `longest` [s].
  double Longest(int half_step, const State& state, double longest);

  HalfStepSequence sequence_;  // its footsteps where start_ has them
  const MarginEvaluator& evaluator_;
  HomotopyParameters start_;
  double period_;
  MarginEvaluator::Scratch scratch_;
  long passes_ = 0;
  const Choices* choices_ = nullptr;
  double duration_ = 0.0;                         // longer walks are not wanted
  std::vector<double> remaining_;                 // least that is still to come after half-step
  std::vector<std::vector<double>> overlaps_;     // by half-step, choice before and choice
  std::vector<std::vector<int>> duration_class_;  // by half-step and choice
  std::vector<std::vector<State>> states_;        // by half-step
};

}  // namespace halfstep
