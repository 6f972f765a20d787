#pragma once

#include <array>
#include <span>
#include <vector>

#include "smoothing/margins/margin.h"
#include "wpg/nth.h"

namespace halfstep {

/// Which families of margins have rows of their own in the overlap program, in the order of the
/// rows of a half-step or instant.
class RowOrder {
 public:
  /// Of the families that there are (MarginEvaluator::families).
  explicit RowOrder(std::span<const MarginFamily> families);

  int size() const { return static_cast<int>(families_.size()); }  ///< how many have a row
  /// The family of a row.
  MarginFamily family(int row) const { return Nth(families_, row % size()); }
  /// The row of a family, or of the one whose row it shares; −1: it has none.
  int row(MarginFamily family) const { return Nth(rows_, family); }

 private:
  std::vector<MarginFamily> families_;
  std::array<int, kNumMarginFamilies> rows_ = {};
};

}  // namespace halfstep
