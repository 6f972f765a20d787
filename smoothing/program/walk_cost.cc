#include "smoothing/program/walk_cost.h"

#include <algorithm>
#include <utility>

namespace halfstep {
namespace {

std::vector<std::shared_ptr<const WalkCost>>& RegisteredWalkCosts() {
  static std::vector<std::shared_ptr<const WalkCost>> costs;
  return costs;
}

}  // namespace

void RegisterWalkCost(std::shared_ptr<const WalkCost> cost) {
  auto& all = RegisteredWalkCosts();
  const auto same =
      std::ranges::find_if(all, [&](const auto& known) { return known->name() == cost->name(); });
  if (same != all.end()) {
    *same = std::move(cost);
  } else {
    all.push_back(std::move(cost));
  }
}

const std::vector<std::shared_ptr<const WalkCost>>& WalkCosts() { return RegisteredWalkCosts(); }

}  // namespace halfstep
