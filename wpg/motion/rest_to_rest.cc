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
// Those of a flat top: −S(x), −1 and −(1 − S(x)) on their pieces.
constexpr std::array<double, 6> kPreBumpRise = {0, 0, 0, -10, 15, -6};
constexpr std::array<double, 1> kPreBumpTop = {-1};
constexpr std::array<double, 6> kPreBumpFall = {-1, 0, 0, 10, -15, 6};
// ½ + (15x − 10x³ + 3x⁵)/16 in powers of x = (σ − ½)/δ.
constexpr std::array<double, 6> kShift = {0.5, 15.0 / 16, 0, -10.0 / 16, 0, 3.0 / 16};

// Power series of the solution of c_xx = λ²·(c − p): (k+2)(k+1)·c_{k+2} = λ²·(c_k − p_k), summed
// until what is left out is below rounding on |x| ≤ 1.
template <size_t n>
Series Solve(const Dual& lambda, const std::array<double, n>& p, const Dual& c0, const Dual& c1) {
  Series c = {c0, c1};
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

// A piece of the pre-bump of amplitude 1, and the CoM's motion under it.
struct UnitPiece {
  double center, width;
  Series com;
  std::vector<double> zmp;
};

// Goes on from rest, or from where the last piece ends.
template <size_t n>
void AddPiece(const Dual& theta, double center, double width, const std::array<double, n>& zmp,
              std::vector<UnitPiece>* pieces) {
  Dual value(0.0), slope(0.0);
  if (!pieces->empty()) {
    const UnitPiece& before = pieces->back();
    const auto [end, end_slope] = Ends(before.com, 1.0);
    value = end;
    slope = end_slope * (width / before.width);
  }
  pieces->push_back({center, width, Solve(Dual(theta * width), zmp, value, slope),
                     std::vector<double>(zmp.begin(), zmp.end())});
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

RestToRest::RestToRest(double theta, double shift_fraction, std::optional<double> bump_ramp)
    : theta_(theta), first_(0.5 - 0.5 * shift_fraction) {
  HALFSTEP_CHECK(theta >= 0.5 && theta <= 60.0, "theta = " << theta);
  HALFSTEP_CHECK(shift_fraction >= 0.01 && shift_fraction <= 0.5,
                 "shift_fraction = " << shift_fraction);
  HALFSTEP_CHECK(!bump_ramp || (*bump_ramp >= 0.1 && *bump_ramp <= 0.5),
                 "bump_ramp = " << *bump_ramp);
  const double delta = 0.5 * shift_fraction;
  const Dual th(theta, 1, 0);

  // From rest under the unit pre-bump, piece by piece; through (½, ½) with slope γ: c = forced +
  // γ·free.
  std::vector<UnitPiece> bump;
  const auto extend = [&](double center, double width, const auto& zmp) {
    AddPiece(th, center, width, zmp, &bump);
  };
  if (bump_ramp) {
    const double ramp = *bump_ramp * first_;
    bump_second_ = 10.0 / (std::sqrt(3.0) * *bump_ramp * *bump_ramp);
    extend(0.0, ramp, kPreBumpRise);
    if (*bump_ramp < 0.5) extend(ramp, first_ - 2.0 * ramp, kPreBumpTop);
    extend(first_ - ramp, ramp, kPreBumpFall);
  } else {
    bump_second_ = 24.0;
    extend(0.0, first_, kPreBump);
  }
  const UnitPiece& last = bump.back();
  const Series forced = Solve(Dual(th * delta), kShift, Dual(0.5), Dual(0.0));
  const Series free = Solve(Dual(th * delta), std::array<double, 1>{0.0}, Dual(0.0), Dual(1.0));

  // Value and slope continuous at σ₁: a·F = P + γ·H,  a·F'/σ₁ = (P' + γ·H')/δ.
  const auto [f, f_slope] = Ends(last.com, 1.0);
  const auto [p, p_slope] = Ends(forced, -1.0);
  const auto [h, h_slope] = Ends(free, -1.0);
  const Dual s = f_slope * (delta / last.width);
  const Dual determinant = f * h_slope - s * h;
  const Dual a = (p * h_slope - p_slope * h) / determinant;
  const Dual gamma = (s * p - f * p_slope) / determinant;

  const auto coefficient = [](const Dual& x) { return Coefficient{x.value(), x.derivatives()[0]}; };
  bump_ = coefficient(a);
  for (const UnitPiece& piece : bump) {
    const double end = &piece == &last ? first_ : piece.center + piece.width;
    com_.push_back({piece.center, piece.width, end, {}});
    zmp_.push_back(com_.back());
    for (const Dual& c : piece.com) com_.back().coefficients.push_back(coefficient(a * c));
    for (double b : piece.zmp) zmp_.back().coefficients.push_back(coefficient(a * b));
  }
  com_.push_back({0.5, delta, 0.5, {}});
  zmp_.push_back(com_.back());
  for (size_t k = 0; k < forced.size() || k < free.size(); ++k) {
    Dual c(0.0);
    if (k < forced.size()) c = c + forced[k];
    if (k < free.size()) c = c + gamma * free[k];
    com_.back().coefficients.push_back(coefficient(c));
  }
  for (double c : kShift) zmp_.back().coefficients.push_back({c, 0.0});
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

UnitJet RestToRest::At(const std::vector<Piece>& pieces, double sigma) {
  if (sigma <= 0.0) return {};
  if (sigma >= 1.0) return {.value = 1.0};
  if (sigma > 0.5) return Reflected(At(pieces, 1.0 - sigma));
  size_t i = 0;
  while (i + 1 < pieces.size() && sigma >= pieces[i].end) ++i;
  return pieces[i].At(sigma);
}

UnitJet RestToRest::Com(double sigma) const { return At(com_, sigma); }

UnitJet RestToRest::Zmp(double sigma) const { return At(zmp_, sigma); }

double RestToRest::ZmpSecondBound(double from, double to) const {
  if (to <= 0.0 || from >= 1.0) return 0.0;
  const double on_shift = Smoothstep{first_, 1.0 - first_}.SecondBound(from, to);
  const bool touches_bump = from < first_ || to > 1.0 - first_;
  return std::max(on_shift, touches_bump ? bump_second_ * bump_.value / (first_ * first_) : 0.0);
}

Range RestToRest::ComThirdRange(double from, double to) const {
  if (to <= 0.0 || from >= 1.0) return {};
  const double fourth = theta_ * theta_ * (ComSecondBound() + ZmpSecondBound(from, to));
  return {Com(0.5 * (from + to)).sss, 0.5 * (to - from) * fourth};
}

}  // namespace halfstep
