#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/config/experiment_config.h"

namespace halfstep::verify {

/// Names in the config.yaml of a run that the program which made it had registered, or built in,
/// and this one does not know. They say how a walk was found, or what was proved besides; what a
/// walk is does not depend on them.
struct OwnNames {
  std::string robot = {};               ///< that the config names; not one of those
  std::vector<std::string> told;        ///< each with what it is: "the method mine/descent"
  std::vector<YamlOverride> overrides;  ///< with these the config can be read here
  /// Those of the config, known or not; none: all are known.
  std::optional<std::vector<std::string>> methods;
  std::optional<double>
      own_margin;  ///< demanded of the family `own`; none: not known, or known here
};

/// Looks for them in the text of a config.yaml; `tools`: those of this program. What else is
/// wrong with it is LoadConfig's to say.
OwnNames FindOwnNames(const std::string& path, const std::string& text, const Toolbox& tools = {});

}  // namespace halfstep::verify
