#include "wpg/motion/pre_bump.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

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

// A number that was computed before, with a relative error of at most `rounded`.
template <typename Number>
Number Given(double number, double rounded) {
  if constexpr (std::is_same_v<Number, WithError>)
    return WithError(number, rounded * std::abs(number));
  return Number(number);
}

// Goes on from rest, or from where the last piece ends. `rounded`: of the coefficients.
template <typename Number>
void AddPiece(const Number& theta, const Number& center, const Number& width,
              std::span<const double> zmp, std::vector<UnitPiece<Number>>* pieces,
              double rounded = 0.0) {
  Number value(0.0), slope(0.0);
  if (!pieces->empty()) {
    const UnitPiece<Number>& before = pieces->back();
    const auto [end, end_slope] = Ends(before.com, 1.0);
    value = end;
    slope = end_slope * (width / before.width);
  }
  std::vector<Number> p;
  for (const double coefficient : zmp) p.push_back(Given<Number>(coefficient, rounded));
  pieces->push_back({center, width, SolveLipm<Number>(Number(theta * width), p, value, slope), p});
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
template <typename Number>
std::vector<Number> SolveLipm(const Number& lambda, std::span<const Number> p, const Number& c0,
                              const Number& c1) {
  std::vector<Number> c = {c0, c1};
  for (size_t k = 0; k < p.size() || std::abs(c[k].value()) + std::abs(c[k + 1].value()) >
                                         1e-22 * (1.0 + std::abs(c[0].value()));
       ++k) {
    const Number p_k = k < p.size() ? p[k] : Number(0.0);
    c.push_back(lambda * lambda * (c[k] - p_k) / static_cast<double>((k + 2) * (k + 1)));
  }
  return c;
}

template <typename Number>
std::array<Number, 2> Ends(const std::vector<Number>& c, double x) {
  Number value(0.0), slope(0.0);
  double power = 1.0;
  for (size_t k = 0; k < c.size(); ++k) {
    value = value + c[k] * power;
    slope = slope + c[k] * (power * x * static_cast<double>(k));
    power *= x;
  }
  return {value, slope};
}

template <typename Number>
std::vector<UnitPiece<Number>> PreBump(const Number& theta, const Number& first, double r) {
  std::vector<UnitPiece<Number>> bump;
  // Mixtures are sums of two products of one sign.
  const double rounded = r > 0.5 && r < 1.0 ? 4.0 * kRoundoff : 0.0;
  const auto extend = [&](const Number& center, const Number& width, const auto& zmp) {
    AddPiece<Number>(theta, center, width, zmp, &bump, rounded);
  };
  if (r == 1.0) {
    extend(Number(0.0), first, kPreBump);
    return bump;
  }
  const Number ramp = std::min(r, 0.5) * first;
  if (r > 0.5) {
    extend(Number(0.0), ramp, Mixed(2.0 * r - 1.0, kRoundRise, kPreBumpRise));
    extend(Number(first - ramp), ramp, Mixed(2.0 * r - 1.0, kRoundFall, kPreBumpFall));
    return bump;
  }
  extend(Number(0.0), ramp, kPreBumpRise);
  if (r < 0.5) extend(ramp, Number(first - 2.0 * ramp), kPreBumpTop);
  extend(Number(first - ramp), ramp, kPreBumpFall);
  return bump;
}

std::vector<UnitPiece<UnitDual>> PreBumpByRamp(const UnitDual& theta, const UnitDual& first,
                                               double r) {
  std::vector<UnitPiece<UnitDual>> slope;
  const UnitDual ramp = std::min(r, 0.5) * first;
  if (r > 0.5) {
    AddPiece<UnitDual>(theta, UnitDual(0.0), ramp, kRiseByMixture, &slope);
    AddPiece<UnitDual>(theta, UnitDual(first - ramp), ramp, kFallByMixture, &slope);
    return slope;
  }
  const auto over_r = [r](std::array<double, 6> p) {
    for (double& c : p) c /= r;
    return p;
  };
  AddPiece<UnitDual>(theta, UnitDual(0.0), ramp, over_r(kRiseByRamp), &slope);
  const std::array<double, 1> none = {0.0};
  if (r < 0.5) AddPiece<UnitDual>(theta, ramp, UnitDual(first - 2.0 * ramp), none, &slope);
  AddPiece<UnitDual>(theta, UnitDual(first - ramp), ramp, over_r(kFallByRamp), &slope);
  return slope;
}

void AddSeries(const std::vector<WithError>& series, const WithError& center,
               const WithError& width, UnitJet* error, UnitJet* size) {
  std::array<double, 4> sums{}, errors{};
  double k = 0.0;
  for (const WithError& c : series) {
    double factor = 1.0;
    for (size_t d = 0; d < 4; ++d) {
      sums[d] += factor * c.most();
      errors[d] += factor * c.error();
      factor *= std::max(0.0, k - static_cast<double>(d));
    }
    k += 1.0;
  }
  // Each coefficient goes through at most three roundings for each power.
  const double rounded = (3.0 * k + 8.0) * kRoundoff, w = width.value() - width.error();
  const double left_out = 1e-21 * sums[0];
  const double x = (center.error() + width.error() + 4.0 * kRoundoff) / w + 4.0 * kRoundoff;
  const auto at = [&](size_t d) { return errors[d] + rounded * sums[d] + x * sums[d + 1]; };
  // Of 1/width and its powers.
  const double r = 1.0 / w, of_r = width.error() * r + 4.0 * kRoundoff;
  error->value = std::max(error->value, at(0) + left_out + kRoundoff);
  error->s = std::max(error->s, r * (at(1) + k * left_out + of_r * sums[1]));
  error->ss = std::max(
      error->ss,
      r * r * (at(2) + k * k * left_out + 2.0 * of_r * sums[2] + 4.0 * kRoundoff * r * sums[3]));
  size->sss = std::max(size->sss, r * r * r * sums[3]);
}

template std::vector<UnitDual> SolveLipm(const UnitDual&, std::span<const UnitDual>,
                                         const UnitDual&, const UnitDual&);
template std::vector<WithError> SolveLipm(const WithError&, std::span<const WithError>,
                                          const WithError&, const WithError&);
template std::array<UnitDual, 2> Ends(const std::vector<UnitDual>&, double);
template std::array<WithError, 2> Ends(const std::vector<WithError>&, double);
template std::vector<UnitPiece<UnitDual>> PreBump(const UnitDual&, const UnitDual&, double);
template std::vector<UnitPiece<WithError>> PreBump(const WithError&, const WithError&, double);

}  // namespace halfstep
