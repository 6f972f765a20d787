#include "smoothing/margins/family_traits.h"

#include <algorithm>
#include <vector>

#include "smoothing/margins/all_families.h"
#include "wpg/nth.h"

namespace halfstep {

const FamilyTraits& Traits(MarginFamily family) { return Nth(AllFamilies::kTraits, family); }

std::string_view Name(MarginFamily family) { return Traits(family).name; }
std::string_view Unit(MarginFamily family) { return Traits(family).unit; }
double Scale(MarginFamily family) { return Traits(family).scale; }

std::array<double, kNumMarginFamilies> DefaultDemands() {
  std::array<double, kNumMarginFamilies> demands{};
  for (const FamilyTraits& traits : AllFamilies::kTraits) {
    Nth(demands, traits.family) = traits.demanded;
  }
  return demands;
}

std::span<const MarginFamily> AllMarginFamilies() {
  static constexpr std::array<MarginFamily, kNumMarginFamilies> kAll = [] {
    std::array<MarginFamily, kNumMarginFamilies> all{};
    for (int i = 0; i < kNumMarginFamilies; ++i) Nth(all, i) = MarginFamily{i};
    return all;
  }();
  static_assert(kAll.back() == MarginFamily::kOwn);
  return std::span(kAll).first(OwnMargins().empty() ? kAll.size() - 1 : kAll.size());
}

std::span<const MarginFamily> FamiliesByCost() {
  static const std::vector<MarginFamily> kOrder = [] {
    const std::span<const MarginFamily> all = AllMarginFamilies();
    std::vector<MarginFamily> order(all.begin(), all.end());
    std::ranges::stable_sort(order, {}, [](MarginFamily f) { return Traits(f).cost; });
    return order;
  }();
  return kOrder;
}

}  // namespace halfstep
