#include "wpg/motion/rest_to_rest.h"

#include <Eigen/Core>
#include <cmath>
#include <unsupported/Eigen/AutoDiff>

#include "wpg/check.h"
#include "wpg/motion/smoothstep.h"

namespace halfstep {
namespace {

// A number with its derivative with respect to θ.
using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>;
using Series = std::vector<Dual>;

// −B(y) = −64y³(1 − y)³ in powers of y = σ/σ₁.
constexpr std::array<double, 7> kPreBump = {0, 0, 0, -64, 192, -192, 64};
// ½ + (15x − 10x³ + 3x⁵)/16 in powers of x = (σ − ½)/δ.
constexpr std::array<double, 6> kShift = {0.5, 15.0 / 16, 0, -10.0 / 16, 0, 3.0 / 16};

// Power series of the solution of c_xx = λ²·(c − p): (k+2)(k+1)·c_{k+2} = λ²·(c_k − p_k), summed
// until what is left out is below rounding on |x| ≤ 1.
template <size_t n>
Series Solve(const Dual& lambda, const std::array<double, n>& p, double c0, double c1) {
  Series c = {Dual(c0), Dual(c1)};
  for (size_t k = 0;
       k < n || std::abs(c[k].value()) + std::abs(c[k + 1].value()) > 1e-22 * (1.0 + c[0].value());
       ++k) {
    const double p_k = k < n ? p[k] : 0.0;
    c.push_back(lambda * lambda * (c[k] - p_k) / static_cast<double>((k + 2) * (k + 1)));
  }
  return c;
}

// Σ c_k·x^k and Σ k·c_k·x^{k−1} at x = ±1.
std::array<Dual, 2> Ends(const Series& c, double x) {
  Dual value(0.0), slope(0.0);
  double power = 1.0;
  for (size_t k = 0; k < c.size(); ++k) {
    value = value + c[k] * power;
    slope = slope + c[k] * (power * x * static_cast<double>(k));
    power *= x;
  }
  return {value, slope};
}

// F(σ) = 1 − F(1 − σ).
UnitJet Reflected(const UnitJet& f) {
  return {.value = 1.0 - f.value,
          .s = f.s,
          .ss = -f.ss,
          .sss = f.sss,
          .theta = -f.theta,
          .theta_s = f.theta_s,
          .theta_ss = -f.theta_ss};
}

}  // namespace

RestToRest::RestToRest(double theta, double shift_fraction)
    : theta_(theta), first_(0.5 - 0.5 * shift_fraction) {
  HALFSTEP_CHECK(theta >= 0.5 && theta <= 60.0, "theta = " << theta);
  HALFSTEP_CHECK(shift_fraction >= 0.01 && shift_fraction <= 0.5,
                 "shift_fraction = " << shift_fraction);
  const double delta = 0.5 * shift_fraction;
  const Dual th(theta, 1, 0);

  // From rest under the unit pre-bump; through (½, ½) with slope γ: c = forced + γ·free.
  const Series first = Solve(Dual(th * first_), kPreBump, 0.0, 0.0);
  const Series forced = Solve(Dual(th * delta), kShift, 0.5, 0.0);
  const Series free = Solve(Dual(th * delta), std::array<double, 1>{0.0}, 0.0, 1.0);

  // Value and slope continuous at σ₁: a·F = P + γ·H,  a·F'/σ₁ = (P' + γ·H')/δ.
  const auto [f, f_slope] = Ends(first, 1.0);
  const auto [p, p_slope] = Ends(forced, -1.0);
  const auto [h, h_slope] = Ends(free, -1.0);
  const Dual s = f_slope * (delta / first_);
  const Dual determinant = f * h_slope - s * h;
  const Dual a = (p * h_slope - p_slope * h) / determinant;
  const Dual gamma = (s * p - f * p_slope) / determinant;

  const auto coefficient = [](const Dual& x) { return Coefficient{x.value(), x.derivatives()[0]}; };
  bump_ = coefficient(a);
  com_ = {Piece{0.0, first_, {}}, Piece{0.5, delta, {}}};
  zmp_ = com_;
  for (const Dual& c : first) com_[0].coefficients.push_back(coefficient(a * c));
  for (size_t k = 0; k < forced.size() || k < free.size(); ++k) {
    Dual c(0.0);
    if (k < forced.size()) c = c + forced[k];
    if (k < free.size()) c = c + gamma * free[k];
    com_[1].coefficients.push_back(coefficient(c));
  }
  for (double b : kPreBump) zmp_[0].coefficients.push_back(coefficient(a * b));
  for (double c : kShift) zmp_[1].coefficients.push_back({c, 0.0});
}

UnitJet RestToRest::Piece::At(double sigma) const {
  const double r = 1.0 / width;
  const double x = (sigma - center) * r;
  UnitJet f;
  for (size_t k = coefficients.size(); k-- > 0;) {  // Horner, with its derivatives in x
    const Coefficient& c = coefficients[k];
    f.sss = f.sss * x + 3.0 * f.ss;
    f.ss = f.ss * x + 2.0 * f.s;
    f.s = f.s * x + f.value;
    f.value = f.value * x + c.value;
    f.theta_ss = f.theta_ss * x + 2.0 * f.theta_s;
    f.theta_s = f.theta_s * x + f.theta;
    f.theta = f.theta * x + c.theta;
  }
  f.s *= r;
  f.ss *= r * r;
  f.sss *= r * r * r;
  f.theta_s *= r;
  f.theta_ss *= r * r;
  return f;
}

UnitJet RestToRest::Com(double sigma) const {
  if (sigma <= 0.0) return {};
  if (sigma >= 1.0) return {.value = 1.0};
  if (sigma > 0.5) return Reflected(Com(1.0 - sigma));
  return com_[sigma < first_ ? 0 : 1].At(sigma);
}

UnitJet RestToRest::Zmp(double sigma) const {
  if (sigma <= 0.0) return {};
  if (sigma >= 1.0) return {.value = 1.0};
  if (sigma > 0.5) return Reflected(Zmp(1.0 - sigma));
  return zmp_[sigma < first_ ? 0 : 1].At(sigma);
}

double RestToRest::ZmpSecondBound(double from, double to) const {
  if (to <= 0.0 || from >= 1.0) return 0.0;
  const double on_shift = Smoothstep{first_, 1.0 - first_}.SecondBound(from, to);
  const bool touches_bump = from < first_ || to > 1.0 - first_;
  return std::max(on_shift, touches_bump ? 24.0 * bump_.value / (first_ * first_) : 0.0);
}

Range RestToRest::ComThirdRange(double from, double to) const {
  if (to <= 0.0 || from >= 1.0) return {};
  const double fourth = theta_ * theta_ * (ComSecondBound() + ZmpSecondBound(from, to));
  return {Com(0.5 * (from + to)).sss, 0.5 * (to - from) * fourth};
}

}  // namespace halfstep
