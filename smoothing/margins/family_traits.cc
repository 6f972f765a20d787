#include "smoothing/margins/family_traits.h"

#include <utility>

#include "smoothing/margins/family_class.h"
#include "wpg/nth.h"

namespace halfstep {

// In this namespace, since the function that it declares is to be another file's.
template <MarginFamily kFamily>
const FamilyClass& ClassInItsFile() {
  const FamilyClass& ClassOf(FamilyTag<kFamily>);
  return ClassOf(FamilyTag<kFamily>());
}

namespace {

// Functions rather than what they return, so that it is there before main() begins.
constexpr std::array kClasses = []<size_t... kIndex>(std::index_sequence<kIndex...>) {
  return std::array{&ClassInItsFile<MarginFamily{kIndex}>...};
}
(std::make_index_sequence<kNumMarginFamilies>());

constexpr std::array kAll = []<size_t... kIndex>(std::index_sequence<kIndex...>) {
  return std::array{MarginFamily{kIndex}...};
}
(std::make_index_sequence<kNumMarginFamilies>());
static_assert(kAll.back() == MarginFamily::kOwn);  // FamiliesWith leaves out the last

}  // namespace

const FamilyClass& ClassOf(MarginFamily family) { return Nth(kClasses, family)(); }

const FamilyTraits& Traits(MarginFamily family) { return ClassOf(family).traits; }

std::string_view Name(MarginFamily family) { return Traits(family).name; }
std::string_view Unit(MarginFamily family) { return Traits(family).unit; }
double Scale(MarginFamily family) { return Traits(family).scale; }

std::array<double, kNumMarginFamilies> DefaultDemands() {
  std::array<double, kNumMarginFamilies> demands{};
  for (const MarginFamily family : kAll) Nth(demands, family) = Traits(family).demanded;
  return demands;
}

std::span<const MarginFamily> AllMarginFamilies() { return kAll; }

std::span<const MarginFamily> FamiliesWith(const OwnMargins& own) {
  return std::span(kAll).first(own.empty() ? kAll.size() - 1 : kAll.size());
}

}  // namespace halfstep
