#pragma once

#include <string>
#include <vector>

#include "smoothing/margins/margin_statements.h"

namespace halfstep {

/// Families with one statement about what the soles on the floor give. Subject: the step in the
/// air, or −1.
class SupportFamily : public WholeFamily {
 public:
  /// The traits of the class.
  using WholeFamily::WholeFamily;
  int count() const final { return 1; }
  std::string Subject(const Margin& margin) const final {
    return margin.subject < 0 ? "both soles" : "support sole";
  }
  std::vector<Side> PlacedFeet(const Margin&) const final { return {}; }
};

}  // namespace halfstep
