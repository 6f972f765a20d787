#include "opt/adapters/box_transform.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wpg/elementary.h"

namespace halfstep::opt {
namespace {

double Root(double z) { return std::sqrt(z * z + 1.0); }

}  // namespace

BoxTransform::BoxTransform(Eigen::VectorXd lower, Eigen::VectorXd upper)
    : lower_(std::move(lower)), upper_(std::move(upper)) {}

Eigen::VectorXd BoxTransform::ToBox(const Eigen::VectorXd& z) const {
  Eigen::VectorXd x = z;
  for (Eigen::Index j = 0; j < z.size(); ++j) {
    const double l = lower_[j], u = upper_[j];
    if (std::isfinite(l) && std::isfinite(u)) {
      x[j] = std::clamp(l + (u - l) * 0.5 * (1.0 + Sin(z[j])), l, u);
    } else if (std::isfinite(l)) {
      x[j] = std::max(l, l - 1.0 + Root(z[j]));
    } else if (std::isfinite(u)) {
      x[j] = std::min(u, u + 1.0 - Root(z[j]));
    }
  }
  return x;
}

Eigen::VectorXd BoxTransform::FromBox(const Eigen::VectorXd& x) const {
  Eigen::VectorXd z = x;
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const double l = lower_[j], u = upper_[j];
    if (std::isfinite(l) && std::isfinite(u)) {
      z[j] = u > l ? Asin(std::clamp(2.0 * (x[j] - l) / (u - l) - 1.0, -1.0, 1.0)) : 0.0;
    } else if (std::isfinite(l)) {
      z[j] = std::sqrt(std::max(0.0, (x[j] - l) * (x[j] - l + 2.0)));
    } else if (std::isfinite(u)) {
      z[j] = std::sqrt(std::max(0.0, (u - x[j]) * (u - x[j] + 2.0)));
    }
  }
  return z;
}

Eigen::VectorXd BoxTransform::Slope(const Eigen::VectorXd& z) const {
  Eigen::VectorXd slope = Eigen::VectorXd::Ones(z.size());
  for (Eigen::Index j = 0; j < z.size(); ++j) {
    const double l = lower_[j], u = upper_[j];
    if (std::isfinite(l) && std::isfinite(u)) {
      slope[j] = (u - l) * 0.5 * Cos(z[j]);
    } else if (std::isfinite(l)) {
      slope[j] = z[j] / Root(z[j]);
    } else if (std::isfinite(u)) {
      slope[j] = -z[j] / Root(z[j]);
    }
  }
  return slope;
}

Eigen::VectorXd BoxTransform::OffTheBounds(const Eigen::VectorXd& x,
                                           const Eigen::VectorXd& gradient, double fraction) const {
  Eigen::VectorXd moved = x;
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const double l = lower_[j], u = upper_[j];
    const bool both = std::isfinite(l) && std::isfinite(u);
    if (gradient[j] < 0.0 && std::isfinite(l)) {
      const double width = both ? u - l : std::max(1.0, std::abs(l));
      moved[j] = std::max(x[j], l + fraction * width);
    } else if (gradient[j] > 0.0 && std::isfinite(u)) {
      const double width = both ? u - l : std::max(1.0, std::abs(u));
      moved[j] = std::min(x[j], u - fraction * width);
    }
  }
  return moved;
}

}  // namespace halfstep::opt
