#pragma once

#include <optional>
#include <string>

#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/overlap_optimizer.h"
#include "smoothing/methods/pareto.h"
#include "smoothing/methods/smoothing_monitor.h"
#include "smoothing/methods/walk_problem.h"

namespace halfstep {

/// The options of all methods; each takes those of its group.
struct SmootherOptions {
  DichotomyOptions dichotomy = {};
  OptimizerOptions optimizer = {};
  std::optional<ParetoOptions> pareto = std::nullopt;  ///< solvers make a ParetoCurve
};

/// The group of options that a method takes.
enum class OptionGroup { kNone, kDichotomy, kOptimizer };

/// One way to smooth a walk, behind the one door. Immutable: may be called again and from several
/// threads, with a monitor each.
class Smoother {
 public:
  virtual ~Smoother() = default;

  virtual std::string name() const = 0;     ///< "dichotomy", "halfstep/sqp" …
  virtual std::string meaning() const = 0;  ///< one line, for `halfstep list methods`
  virtual OptionGroup options() const = 0;

  /// Smooths from where the problem starts. What is returned is as feasible as the problem's test
  /// says (SmoothingResult::evidence); how the search ended, and that there was nothing feasible to
  /// begin with, is a status with a sentence and no exception. Impossible options are a
  /// std::logic_error.
  [[nodiscard]] virtual SmoothingResult Smooth(const WalkProblem& problem,
                                               const SmootherOptions& options,
                                               SmoothingMonitor& monitor) const = 0;
};

}  // namespace halfstep
