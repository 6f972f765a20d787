#include "wpg/motion/waist_sway.h"

#include <algorithm>
#include <cmath>

namespace halfstep {
namespace {

using Eigen::Vector2d;

constexpr double kPerUnit = WaistSway::kPieces;  // pieces a unit of σ

// Control k, or zero where there is none.
Vector2d Control(const WaistSway& sway, int k) {
  if (k < 0 || k >= WaistSway::kControls) return Vector2d::Zero();
  return sway.controls[static_cast<size_t>(k)];
}

int PieceAt(double sigma) {
  return std::clamp(static_cast<int>(std::floor(sigma * kPerUnit)), 0, WaistSway::kPieces - 1);
}

// d and its derivatives with respect to σ, on the piece that σ ∈ [0, 1] lies in.
struct SplineJet {
  Vector2d value, s, ss, sss;

  SplineJet(const WaistSway& sway, double sigma) {
    const int piece = PieceAt(sigma);
    const double x = sigma * kPerUnit - piece, y = 1.0 - x;
    const Vector2d a = Control(sway, piece - 3), b = Control(sway, piece - 2),
                   c = Control(sway, piece - 1), d = Control(sway, piece);
    value = (y * y * y * a + (3 * x * x * x - 6 * x * x + 4) * b +
             (3 * y * y * y - 6 * y * y + 4) * c + x * x * x * d) /
            6.0;
    s = 0.5 * kPerUnit *
        (-y * y * a + (3 * x * x - 4 * x) * b - (3 * y * y - 4 * y) * c + x * x * d);
    ss = kPerUnit * kPerUnit * (y * a + (3 * x - 2) * b + (3 * y - 2) * c + x * d);
    sss = kPerUnit * kPerUnit * kPerUnit * (d - a + 3.0 * (b - c));
  }
};

template <typename Change>
WaistSway Changed(WaistSway sway, const Change& change) {
  for (Vector2d& control : sway.controls) control = change(control);
  return sway;
}

}  // namespace

std::array<ProfileJet, 2> WaistSway::At(double tau, double duration) const {
  if (none() || tau <= 0.0 || tau >= duration) return {};
  const double sigma = tau / duration;
  const SplineJet d(*this, sigma);
  const auto axis = [&](Eigen::Index i) {
    return ToTime({.value = d.value[i], .s = d.s[i], .ss = d.ss[i], .sss = d.sss[i]}, sigma,
                  duration, 0.0);
  };
  return {axis(0), axis(1)};
}

Vector2d WaistSway::SecondBound(double from, double to, double duration) const {
  Vector2d bound(0, 0);
  if (none() || to <= 0.0 || from >= duration) return bound;
  const double a = std::max(from / duration, 0.0), b = std::min(to / duration, 1.0);
  const auto include = [&](double sigma) {
    bound = bound.cwiseMax(SplineJet(*this, sigma).ss.cwiseAbs());
  };
  // It is affine between knots.
  include(a);
  include(b);
  for (int knot = PieceAt(a) + 1; knot <= PieceAt(b); ++knot) include(knot / kPerUnit);
  return bound / (duration * duration);
}

std::array<Range, 2> WaistSway::ThirdRange(double from, double to, double duration) const {
  constexpr double kNear = 1e-9;  // of σ: a knot so near counts as touched
  if (none() || to <= 0.0 || from >= duration) return {};
  const double a = from / duration, b = to / duration;
  Vector2d low = Vector2d::Constant(INFINITY), high = -low;
  const auto include = [&](const Vector2d& x) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  };
  if (a < 0.0 || b > 1.0) include(Vector2d::Zero());
  for (int piece = PieceAt(a - kNear); piece <= PieceAt(b + kNear); ++piece) {
    include(SplineJet(*this, (piece + 0.5) / kPerUnit).sss);
  }
  const double r = 1.0 / (duration * duration * duration);
  return {Range::Between(r * low.x(), r * high.x()), Range::Between(r * low.y(), r * high.y())};
}

WaistSway WaistSway::Turned(const Eigen::Matrix2d& R) const {
  return Changed(*this, [&](const Vector2d& x) { return Vector2d(R * x); });
}

WaistSway WaistSway::Mirrored() const {
  return Changed(*this, [](const Vector2d& x) { return Vector2d(x.x(), -x.y()); });
}

WaistSway WaistSway::Scaled(double factor) const {
  return Changed(*this, [&](const Vector2d& x) { return Vector2d(factor * x); });
}

Eigen::Vector3d CubicBSpline(double u) {
  if (u <= 0.0 || u >= 4.0) return Eigen::Vector3d::Zero();
  const double v = std::min(u, 4.0 - u), sign = u < 2.0 ? 1.0 : -1.0;  // it is even about 2
  if (v < 1.0) return {v * v * v / 6.0, sign * 0.5 * v * v, v};
  const double x = v - 1.0;
  return {(1.0 + 3.0 * x + 3.0 * x * x - 3.0 * x * x * x) / 6.0,
          sign * 0.5 * (1.0 + 2.0 * x - 3.0 * x * x), 1.0 - 3.0 * x};
}

}  // namespace halfstep
