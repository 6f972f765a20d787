#include "halfstep/smoothing/margins/family_traits.h"

#include <algorithm>

#include "halfstep/smoothing/margins/all_families.h"

namespace halfstep {

const FamilyTraits& Traits(MarginFamily family) {
  return AllFamilies::kTraits[static_cast<size_t>(family)];
}

std::string_view Name(MarginFamily family) { return Traits(family).name; }
std::string_view Unit(MarginFamily family) { return Traits(family).unit; }
double Scale(MarginFamily family) { return Traits(family).scale; }

std::array<double, kNumMarginFamilies> DefaultDemands() {
  std::array<double, kNumMarginFamilies> demands{};
  for (const FamilyTraits& traits : AllFamilies::kTraits) {
    demands[static_cast<size_t>(traits.family)] = traits.demanded;
  }
  return demands;
}

const std::array<MarginFamily, kNumMarginFamilies>& FamiliesByCost() {
  static const std::array<MarginFamily, kNumMarginFamilies> kOrder = [] {
    std::array<MarginFamily, kNumMarginFamilies> order = AllMarginFamilies();
    std::ranges::stable_sort(order, {}, [](MarginFamily f) { return Traits(f).cost; });
    return order;
  }();
  return kOrder;
}

}  // namespace halfstep
