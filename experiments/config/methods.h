#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/overlap_optimizer.h"
#include "smoothing/methods/pareto.h"
#include "smoothing/methods/smoothing_result.h"
#include "smoothing/proof/feasibility_test.h"
#include "wpg/motion/half_step_sequence.h"

namespace halfstep {

struct MethodOptions {
  DichotomyOptions dichotomy;
  OptimizerOptions optimizer;
  std::optional<ParetoOptions> pareto;  ///< the program is `pareto`
};

/// The group of smoothing.* whose options a method takes.
enum class OptionGroup { kNone, kDichotomy, kOptimizer };

/// A smoothing method by the name that a config gives it.
struct Method {
  std::string name;
  std::string meaning;  ///< one line, for `halfstep list methods`
  std::function<SmoothingResult(const HalfStepSequence&, const FeasibilityTest&,
                                const MethodOptions&, const std::function<void(double)>&,
                                std::stop_token)>
      smooth;
  OptionGroup options = OptionGroup::kNone;
};

/// Every method there is. To add one, add a row.
const std::vector<Method>& Methods();
std::vector<std::string> MethodNames();
/// Throws std::logic_error when there is none: configs are checked when they are read.
const Method& FindMethod(const std::string& name);

}  // namespace halfstep
