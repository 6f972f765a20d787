#pragma once

#include <string>
#include <vector>

#include "smoothing/margins/margin_statements.h"
#include "wpg/motion/contact_gradient.h"

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

 protected:
  /// The gradient of a number whose gradient with respect to what the floor gives is `by_contact`.
  /// Precondition: at->dynamics() is not null.
  static PostureGradient GradientOf(Instant* at, const Vector6d& by_contact) {
    const ContactGradient by(at->robot(), at->jet(), at->posture(), *at->dynamics(), by_contact);
    PostureGradient gradient;
    gradient.jet = by.jet;
    gradient.q = by.q;
    gradient.speeds = by.speeds;
    return gradient;
  }
};

}  // namespace halfstep
