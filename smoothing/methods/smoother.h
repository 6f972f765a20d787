#pragma once

#include <optional>
#include <string>

#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/horizon.h"
#include "smoothing/methods/overlap_optimizer.h"
#include "smoothing/methods/pareto.h"
#include "smoothing/methods/smoothing_monitor.h"
#include "smoothing/methods/walk_problem.h"
#include "smoothing/walk/homotopy_parameters.h"

namespace halfstep {

/// The options of all methods; each takes those of its group.
struct SmootherOptions {
  DichotomyOptions dichotomy = {};  ///< of the dichotomy, and of methods that begin with it
  OptimizerOptions optimizer = {};  ///< of methods that are solvers
  std::optional<ParetoOptions> pareto = std::nullopt;  ///< when set, solvers make a ParetoCurve
  HorizonOptions horizon = {};  ///< window, step and passes; the rest is `optimizer`'s
  /// The walk of the method `given`; none: the one that the problem starts from.
  std::optional<HomotopyParameters> given = std::nullopt;
};

/// The group of options that a method takes.
enum class OptionGroup { kNone, kDichotomy, kOptimizer, kHorizon, kGiven };

/// A method of smoothing a walk, behind the common interface. Immutable: may be called again and
/// from several threads, with a monitor each.
class Smoother {
 public:
  virtual ~Smoother() = default;

  virtual std::string name() const = 0;     ///< "dichotomy", "halfstep/sqp" …
  virtual std::string meaning() const = 0;  ///< one line, for `halfstep list methods`
  virtual OptionGroup options() const = 0;  ///< which group of SmootherOptions it takes

  /// Smooths from the problem's start. Feasible means by the problem's test
  /// (SmoothingResult::evidence). How the search ended, also for want of a feasible start, is a
  /// status with a sentence, not an exception. Throws std::logic_error for impossible options.
  [[nodiscard]] virtual SmoothingResult Smooth(const WalkProblem& problem,
                                               const SmootherOptions& options,
                                               SmoothingMonitor& monitor) const = 0;
};

}  // namespace halfstep
