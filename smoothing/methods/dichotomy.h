#pragma once

#include <memory>
#include <optional>

#include "smoothing/methods/method_options.h"
#include "smoothing/methods/smoothing_monitor.h"

namespace halfstep {

/// Options of the dichotomy.
struct DichotomyOptions {
  /// In which order junctions are bisected.
  enum class Order { kLeftToRight, kRightToLeft };

  /// Bisection of an overlap ends when the bracket is shorter than this [s] > 0. The published
  /// value is 0.05 s; a finer one gains up to the tolerance at each junction, in log₂ as many
  /// checks.
  double tolerance = 0.001;
  Order order = Order::kLeftToRight;  ///< of the junctions
  int passes = 1;  ///< ≥ 0: later passes continue from the overlaps of the earlier ones; 0: only
                   ///< the start is checked.
  /// Upper bounds as fractions of the natural ones, ∈ [0, 1]. Published: 0.8 and 0.76.
  double up_down_cap = 1.0;
  double down_up_cap = 1.0;  ///< the same of down→up overlaps
  /// Where to begin, instead of at the planned motion.
  std::optional<HomotopyParameters> start = std::nullopt;
  /// Where set: in place of `start`, and not checked again.
  std::optional<AcceptedWalk> accepted_start = std::nullopt;
  /// Where set: a cheaper test, of the same margins, that refuses nothing feasible. It is asked
  /// first, so that the problem's test looks at fewer overlaps that are feasible but not the
  /// largest. The overlaps found are the same, up to the tolerance.
  std::shared_ptr<const FeasibilityTest> cheaper = nullptr;
};

/// `smoothing.dichotomy`: tolerance, order, passes and caps.
OptionGroup<DichotomyOptions> DichotomyGroup();
/// Declares its keys.
void DeclareFields(Fields& fields, DichotomyOptions* options);

/// The paper's smoother: each junction's overlap in turn is bisected between the largest value
/// found feasible and the smallest found infeasible, while the others stay. Only the stretch of the
/// walk that this overlap changes is checked, [t_{i+1}, t_i + T_i]: before it nothing moves, after
/// it the walk is only earlier. Every overlap that is applied was found feasible by the problem's
/// test; every intermediate result is as feasible as the last, so it may be stopped at any moment.
/// Never throws for expected failures: see SmoothingResult::ending. Source: [Perrin2011] §IV.
SmoothingResult Dichotomy(const WalkProblem& problem, const DichotomyOptions& options,
                          SmoothingMonitor& monitor);

}  // namespace halfstep
