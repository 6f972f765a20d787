#include "smoothing/program/row_order.h"

#include <algorithm>
#include <array>

#include "smoothing/margins/family_traits.h"
#include "wpg/nth.h"

namespace halfstep {

const std::vector<MarginFamily>& RowFamilies() {
  static const std::vector<MarginFamily> kFamilies = [] {
    std::vector<MarginFamily> families;
    for (const MarginFamily family : AllMarginFamilies()) {
      if (Traits(family).row == family) families.push_back(family);
    }
    return families;
  }();
  return kFamilies;
}

int RowOf(MarginFamily family) {
  static const std::array<int, kNumMarginFamilies> kRows = [] {
    std::array<int, kNumMarginFamilies> rows{};
    for (const MarginFamily of : AllMarginFamilies()) {
      const auto& own = Traits(of).row;
      const auto found = own ? std::ranges::find(RowFamilies(), *own) : RowFamilies().end();
      Nth(rows, of) =
          found == RowFamilies().end() ? -1 : static_cast<int>(found - RowFamilies().begin());
    }
    return rows;
  }();
  return Nth(kRows, family);
}

}  // namespace halfstep
