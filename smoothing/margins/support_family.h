#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "smoothing/margins/margin_statements.h"
#include "wpg/motion/contact_gradient.h"
#include "wpg/rounded.h"

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
  /// How far rounding may carry the margin of a point inside the support polygon of soles that are
  /// off by at most `off` [m]. Edges below 1e-9 m are left out of it, which is at most (1e-9
  /// m)²/margin. Source: smoothing/README.md, "Rounding", 4.
  static double OfPolygon(const WalkState& x, const WalkState& off,
                          const Eigen::Vector2d& sole_size, double margin) {
    double corners = 0.0, far = 0.0;
    for (const int foot : {FootIndex(Side::kLeft), FootIndex(Side::kRight)}) {
      corners =
          std::max(corners, off[foot] + off[foot + 1] + 0.5 * sole_size.norm() * off[foot + 3]);
      far = std::max(far, std::abs(x[foot]) + std::abs(x[foot + 1]));
    }
    return corners + 16.0 * kRoundoff * (far + sole_size.norm()) + 1e-18 / std::max(margin, 1e-9);
  }
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
