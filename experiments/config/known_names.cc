#include "experiments/config/known_names.h"

#include "smoothing/margins/family_traits.h"

namespace halfstep {

KnownNames NamesOfConfigs(const Toolbox& tools) {
  KnownNames names{.methods = tools.methods.Names(),
                   .own_options = {},
                   .planners = tools.planners.Names(),
                   .weights = {"com_acceleration", "com_jerk", "foot_speed"},
                   .own_margin = std::string(Traits(MarginFamily::kOwn).key),
                   .has_own_margins = !tools.methods.own_margins().empty()};
  for (const DeclaredGroup& group : tools.methods.OwnGroups())
    names.own_options.push_back(group.key);
  for (const WeightedWalkCost& own : tools.methods.own_costs()) {
    names.weights.push_back(own.cost->name());
  }
  return names;
}

std::vector<NamedDemand> NamedDemands(const MarginLimits& limits) {
  std::vector<NamedDemand> demands;
  for (const MarginFamily family : AllMarginFamilies()) {
    demands.push_back({std::string(Name(family)), limits.demanded_of(family), Scale(family)});
  }
  return demands;
}

}  // namespace halfstep
