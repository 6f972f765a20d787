#include "planner/search/planner_registry.h"

#include <stdexcept>
#include <utility>

namespace halfstep {
namespace {

using Planners = std::vector<std::pair<std::string, PlannerFactory>>;

Planners BuiltInPlanners() {
  const auto astar = [](FootstepAStar::Elements elements) {
    return [elements](const Scene&, const PlannerOptions& options) {
      return std::make_unique<FootstepAStar>(elements, options.astar);
    };
  };
  return {{"rrt",
           [](const Scene&, const PlannerOptions& options) {
             return std::make_unique<FootstepRrt>(options.rrt);
           }},
          {"astar", astar(FootstepAStar::Elements::kAll)},
          {"astar/classic", astar(FootstepAStar::Elements::kClassic)},
          {"bounding_box", [](const Scene& scene, const PlannerOptions& options) {
             return std::make_unique<BoundingBoxPlanner>(scene, options.bounding_box);
           }}};
}

struct PlannerRegistry {
  Planners all = BuiltInPlanners();
  size_t built_in = all.size();
};

PlannerRegistry& ThePlanners() {
  static PlannerRegistry registry;
  return registry;
}

}  // namespace

std::vector<std::string> PlannerNames() {
  std::vector<std::string> names;
  for (const auto& [name, make] : ThePlanners().all) names.push_back(name);
  return names;
}

std::unique_ptr<FootstepPlanner> MakePlanner(const std::string& name, const Scene& scene,
                                             const PlannerOptions& options) {
  for (const auto& [known, make] : ThePlanners().all) {
    if (known == name) return make(scene, options);
  }
  throw std::logic_error("no planner " + name);
}

void RegisterPlanner(const std::string& name, PlannerFactory make) {
  auto& [all, built_in] = ThePlanners();
  for (size_t i = 0; i < all.size(); ++i) {
    if (all[i].first != name) continue;
    if (i < built_in) throw std::invalid_argument("planner `" + name + "` is built in");
    all[i].second = std::move(make);
    return;
  }
  all.emplace_back(name, std::move(make));
}

}  // namespace halfstep
