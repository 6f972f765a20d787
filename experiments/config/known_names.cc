#include "experiments/config/known_names.h"

#include "smoothing/margins/family_traits.h"
#include "smoothing/margins/own_margin.h"
#include "smoothing/program/walk_cost.h"

namespace halfstep {

KnownNames NamesOfConfigs(const Toolbox& tools) {
  KnownNames names{.methods = tools.methods.Names(),
                   .own_options = {},
                   .planners = tools.planners.Names(),
                   .weights = {"com_acceleration", "com_jerk", "foot_speed"},
                   .own_margin = std::string(Traits(MarginFamily::kOwn).key),
                   .has_own_margins = !OwnMargins().empty()};
  for (const DeclaredGroup& group : tools.methods.OwnGroups())
    names.own_options.push_back(group.key);
  for (const auto& cost : WalkCosts()) names.weights.emplace_back(cost->name());
  return names;
}

std::vector<NamedDemand> NamedDemands(const MarginLimits& limits) {
  std::vector<NamedDemand> demands;
  const auto add = [&](MarginFamily family) {
    demands.push_back({std::string(Name(family)), limits.demanded_of(family), Scale(family)});
  };
  for (const MarginFamily family : AllMarginFamilies()) {
    if (family != MarginFamily::kOwn) add(family);
  }
  add(MarginFamily::kOwn);
  return demands;
}

}  // namespace halfstep
