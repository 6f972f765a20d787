#pragma once

#include <string>
#include <vector>

#include "experiments/config/toolbox.h"

namespace halfstep {

/// The names that a config may use in this program: its own, and those that it added.
struct KnownNames {
  std::vector<std::string> methods;      ///< of `smoothing.methods`
  std::vector<std::string> own_options;  ///< keys of `smoothing.own`
  std::vector<std::string> planners;     ///< of `planner.name`
  std::vector<std::string> weights;      ///< keys of `smoothing.optimizer.weights`
  std::string own_margin;                ///< key under `smoothing.margins` of the family `own`
  bool has_own_margins = false;          ///< whether there is one, and that key is read
};
/// With these tools.
KnownNames NamesOfConfigs(const Toolbox& tools = {});

/// What a config demands of a margin family.
struct NamedDemand {
  std::string family;     ///< name of the family
  double demanded = 0.0;  ///< [its unit]; kNotDemanded: nothing
  double scale = 1.0;     ///< what counts as a clear change of the margin [its unit]
};
/// Of every family, in their order; `own` is the last, whether a margin was added or not.
std::vector<NamedDemand> NamedDemands(const MarginLimits& limits);

}  // namespace halfstep
