#pragma once

#include <string>
#include <vector>

#include "smoothing/methods/method_options.h"
#include "smoothing/methods/smoothing_monitor.h"
#include "smoothing/methods/walk_problem.h"

namespace halfstep {

/// A method of smoothing a walk, behind the common interface. Immutable: may be called again and
/// from several threads, with a monitor each.
class Smoother {
 public:
  virtual ~Smoother() = default;

  virtual std::string name() const = 0;     ///< "dichotomy", "halfstep/sqp" …
  virtual std::string meaning() const = 0;  ///< one line, for `halfstep list methods`
  /// The groups of options that it declares: its own, or those that it shares with other methods.
  virtual std::vector<DeclaredGroup> groups() const { return {}; }
  /// Declares what a run's manifest says that the method was asked for: in `variables` the families
  /// that it may move, then its options. As it stands: the overlaps, and the keys of its groups.
  virtual void DeclareRequest(Fields& fields, MethodOptions options) const;

  /// Smooths from the problem's start. Feasible means by the problem's test
  /// (SmoothingResult::evidence). How the search ended, also for want of a feasible start, is a
  /// status with a sentence, not an exception. Throws std::logic_error for impossible options.
  [[nodiscard]] virtual SmoothingResult Smooth(const WalkProblem& problem,
                                               const MethodOptions& options,
                                               SmoothingMonitor& monitor) const = 0;
};

}  // namespace halfstep
