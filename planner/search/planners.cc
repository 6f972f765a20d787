#include "planner/search/planners.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "wpg/check.h"

namespace halfstep {

Planners::Planners(std::vector<NamedPlanner> built_in)
    : all_(std::move(built_in)), built_in_(all_.size()) {}

void Planners::Add(NamedPlanner planner) {
  const auto same = std::ranges::find(all_, planner.name, &NamedPlanner::name);
  if (same - all_.begin() < static_cast<std::ptrdiff_t>(built_in_)) {
    throw std::invalid_argument("planner `" + planner.name + "` is built in");
  }
  if (same != all_.end()) {
    *same = std::move(planner);
  } else {
    all_.push_back(std::move(planner));
  }
}

std::vector<std::string> Planners::Names() const {
  std::vector<std::string> names;
  for (const NamedPlanner& planner : all_) names.push_back(planner.name);
  return names;
}

std::unique_ptr<FootstepPlanner> Planners::Make(const std::string& name, const Scene& scene,
                                                const PlannerOptions& options) const {
  const auto found = std::ranges::find(all_, name, &NamedPlanner::name);
  HALFSTEP_CHECK(found != all_.end(), "no planner '" << name << "'");
  return found->make(scene, options);
}

}  // namespace halfstep
