#include "experiments/verify/described_sway.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace halfstep::verify {
namespace {

// The n-th derivative of the truncated power series of B.
double TruncatedSpline(int n, double u) {
  constexpr std::array<double, 5> kSignedChoices = {1, -4, 6, -4, 1};
  constexpr std::array<double, 3> kFactorials = {6, 2, 1};  // (3 − n)!
  if (u <= 0 || u >= 4) return 0;
  double sum = 0;
  for (size_t j = 0; j < kSignedChoices.size(); ++j) {
    const double beyond = u - static_cast<double>(j);
    if (beyond > 0) sum += kSignedChoices[j] * std::pow(beyond, 3 - n);
  }
  return sum / kFactorials[static_cast<size_t>(n)];
}

}  // namespace

Eigen::Vector2d DescribedSway::Derivative(int n, double tau) const {
  Eigen::Vector2d d(0, 0);
  if (tau <= 0 || tau >= duration) return d;
  const double rate = static_cast<double>(control_points.size() + 3) / duration;
  for (size_t k = 0; k < control_points.size(); ++k) {
    d += TruncatedSpline(n, rate * tau - static_cast<double>(k)) * control_points[k];
  }
  return d * std::pow(rate, n);
}

double DescribedSway::ThirdBound() const {
  const auto c = [&](size_t i) {  // three zeros on either side
    return i < 3 || i >= control_points.size() + 3 ? Eigen::Vector2d(0, 0) : control_points[i - 3];
  };
  double most = 0;
  for (size_t i = 3; i < control_points.size() + 6; ++i) {
    most = std::max(most, (c(i) - 3 * c(i - 1) + 3 * c(i - 2) - c(i - 3)).norm());
  }
  return most * std::pow(static_cast<double>(control_points.size() + 3) / duration, 3);
}

}  // namespace halfstep::verify
