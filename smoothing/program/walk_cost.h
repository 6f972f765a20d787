#pragma once

#include <memory>
#include <string>
#include <vector>

#include "smoothing/program/overlap_variables.h"
#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

/// A cost of one's own: what the program `smooth` minimizes beside duration and roughness, with the
/// weight that `smoothing.optimizer.weights` gives to its name. Const and thread-safe.
class WalkCost {
 public:
  virtual ~WalkCost() = default;
  virtual std::string name() const = 0;     ///< a key of YAML: "foot_height"
  virtual std::string meaning() const = 0;  ///< one line, for `halfstep explain-config`
  virtual std::string unit() const = 0;     ///< of the weight, which makes seconds of the value
  /// The value for a walk, and when `gradient` is not null its derivatives with respect to every
  /// parameter, term by term (a parameter may come several times). Solvers believe them;
  /// opt::CheckDerivatives compares them with differences.
  virtual double Evaluate(const SuperposedWalk& walk, ParameterGradient* gradient) const = 0;
};

/// A cost of one's own and its weight.
struct WeightedWalkCost {
  std::shared_ptr<const WalkCost> cost;  ///< not null
  double weight = 0.0;                   ///< of its value, beside the duration [s]; 0: left out
};

}  // namespace halfstep
