#include "wpg/motion/pre_bump.h"

#include <algorithm>
#include <cmath>

namespace halfstep {
namespace {

// −B(y) = −64y³(1 − y)³ in powers of y = σ/σ₁.
constexpr std::array<double, 7> kPreBump = {0, 0, 0, -64, 192, -192, 64};
// Those of a flat top: −S(x), −1 and −(1 − S(x)) on their pieces.
constexpr std::array<double, 6> kPreBumpRise = {0, 0, 0, -10, 15, -6};
constexpr std::array<double, 1> kPreBumpTop = {-1};
constexpr std::array<double, 6> kPreBumpFall = {-1, 0, 0, 10, -15, 6};
// The two halves of the round one, each in powers of its own x, and derivatives: of a flat top's
// ramps with respect to r, times r, and of the mixture with respect to r.
constexpr std::array<double, 7> kRoundRise = {0, 0, 0, -8, 12, -6, 1};
constexpr std::array<double, 7> kRoundFall = {-1, 0, 3, 0, -3, 0, 1};
constexpr std::array<double, 6> kRiseByRamp = {0, 0, 0, 30, -60, 30};
constexpr std::array<double, 6> kFallByRamp = {0, 0, 30, -90, 90, -30};
constexpr std::array<double, 7> kRiseByMixture = {0, 0, 0, 4, -6, 0, 2};
constexpr std::array<double, 7> kFallByMixture = {0, 0, 6, -20, 24, -12, 2};

// Goes on from rest, or from where the last piece ends.
void AddPiece(const UnitDual& theta, const UnitDual& center, const UnitDual& width,
              std::span<const double> zmp, std::vector<UnitPiece>* pieces) {
  UnitDual value(0.0), slope(0.0);
  if (!pieces->empty()) {
    const UnitPiece& before = pieces->back();
    const auto [end, end_slope] = Ends(before.com, 1.0);
    value = end;
    slope = end_slope * (width / before.width);
  }
  pieces->push_back({center, width, SolveLipm(UnitDual(theta * width), zmp, value, slope),
                     UnitSeries(zmp.begin(), zmp.end())});
}

// w·a + (1 − w)·b.
std::array<double, 7> Mixed(double w, const std::array<double, 7>& a,
                            const std::array<double, 6>& b) {
  std::array<double, 7> mixed;
  for (size_t k = 0; k < 7; ++k) mixed[k] = w * a[k] + (k < 6 ? (1.0 - w) * b[k] : 0.0);
  return mixed;
}

}  // namespace

// (k+2)(k+1)·c_{k+2} = λ²·(c_k − p_k).
UnitSeries SolveLipm(const UnitDual& lambda, std::span<const double> p, const UnitDual& c0,
                     const UnitDual& c1) {
  UnitSeries c = {c0, c1};
  for (size_t k = 0; k < p.size() || std::abs(c[k].value()) + std::abs(c[k + 1].value()) >
                                         1e-22 * (1.0 + std::abs(c[0].value()));
       ++k) {
    const double p_k = k < p.size() ? p[k] : 0.0;
    c.push_back(lambda * lambda * (c[k] - p_k) / static_cast<double>((k + 2) * (k + 1)));
  }
  return c;
}

std::array<UnitDual, 2> Ends(const UnitSeries& c, double x) {
  UnitDual value(0.0), slope(0.0);
  double power = 1.0;
  for (size_t k = 0; k < c.size(); ++k) {
    value = value + c[k] * power;
    slope = slope + c[k] * (power * x * static_cast<double>(k));
    power *= x;
  }
  return {value, slope};
}

std::vector<UnitPiece> PreBump(const UnitDual& theta, const UnitDual& first, double r) {
  std::vector<UnitPiece> bump;
  const auto extend = [&](const UnitDual& center, const UnitDual& width, const auto& zmp) {
    AddPiece(theta, center, width, zmp, &bump);
  };
  if (r == 1.0) {
    extend(UnitDual(0.0), first, kPreBump);
    return bump;
  }
  const UnitDual ramp = std::min(r, 0.5) * first;
  if (r > 0.5) {
    extend(UnitDual(0.0), ramp, Mixed(2.0 * r - 1.0, kRoundRise, kPreBumpRise));
    extend(UnitDual(first - ramp), ramp, Mixed(2.0 * r - 1.0, kRoundFall, kPreBumpFall));
    return bump;
  }
  extend(UnitDual(0.0), ramp, kPreBumpRise);
  if (r < 0.5) extend(ramp, UnitDual(first - 2.0 * ramp), kPreBumpTop);
  extend(UnitDual(first - ramp), ramp, kPreBumpFall);
  return bump;
}

std::vector<UnitPiece> PreBumpByRamp(const UnitDual& theta, const UnitDual& first, double r) {
  std::vector<UnitPiece> slope;
  const UnitDual ramp = std::min(r, 0.5) * first;
  if (r > 0.5) {
    AddPiece(theta, UnitDual(0.0), ramp, kRiseByMixture, &slope);
    AddPiece(theta, UnitDual(first - ramp), ramp, kFallByMixture, &slope);
    return slope;
  }
  const auto over_r = [r](std::array<double, 6> p) {
    for (double& c : p) c /= r;
    return p;
  };
  AddPiece(theta, UnitDual(0.0), ramp, over_r(kRiseByRamp), &slope);
  const std::array<double, 1> none = {0.0};
  if (r < 0.5) AddPiece(theta, ramp, UnitDual(first - 2.0 * ramp), none, &slope);
  AddPiece(theta, UnitDual(first - ramp), ramp, over_r(kFallByRamp), &slope);
  return slope;
}

}  // namespace halfstep
