#include "smoothing/program/row_order.h"

#include <algorithm>

#include "smoothing/margins/family_traits.h"

namespace halfstep {

RowOrder::RowOrder(std::span<const MarginFamily> families) {
  std::ranges::copy_if(families, std::back_inserter(families_),
                       [](MarginFamily family) { return Traits(family).row == family; });
  rows_.fill(-1);
  for (const MarginFamily family : families) {
    const auto found = std::ranges::find(families_, Traits(family).row);
    if (found != families_.end()) Nth(rows_, family) = static_cast<int>(found - families_.begin());
  }
}

}  // namespace halfstep
