#include "smoothing/margins/family_traits.h"

#include <algorithm>
#include <vector>

#include "smoothing/margins/all_families.h"

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

std::span<const MarginFamily> AllMarginFamilies() {
  static constexpr std::array<MarginFamily, kNumMarginFamilies> kAll = [] {
    std::array<MarginFamily, kNumMarginFamilies> all{};
    for (int i = 0; i < kNumMarginFamilies; ++i) all[static_cast<size_t>(i)] = MarginFamily{i};
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
