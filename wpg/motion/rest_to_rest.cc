#include "wpg/motion/rest_to_rest.h"

#include <Eigen/Core>
#include <cmath>
#include <unsupported/Eigen/AutoDiff>

#include "wpg/check.h"
#include "wpg/motion/smoothstep.h"

namespace halfstep {
namespace {

// A number with its derivatives with respect to θ and to the shift's fraction.
using Dual = Eigen::AutoDiffScalar<Eigen::Vector2d>;
using Series = std::vector<Dual>;

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
// ½ + (15x − 10x³ + 3x⁵)/16 in powers of x = (σ − ½)/δ.
constexpr std::array<double, 6> kShift = {0.5, 15.0 / 16, 0, -10.0 / 16, 0, 3.0 / 16};

// Power series of the solution of c_xx = λ²·(c − p): (k+2)(k+1)·c_{k+2} = λ²·(c_k − p_k), summed
// until what is left out is below rounding on |x| ≤ 1.
template <size_t n>
Series Solve(const Dual& lambda, const std::array<double, n>& p, const Dual& c0, const Dual& c1) {
  Series c = {c0, c1};
  for (size_t k = 0; k < n || std::abs(c[k].value()) + std::abs(c[k + 1].value()) >
                                  1e-22 * (1.0 + std::abs(c[0].value()));
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
  Dual center, width;
  Series com;
  std::vector<double> zmp;
};

// Goes on from rest, or from where the last piece ends.
template <size_t n>
void AddPiece(const Dual& theta, const Dual& center, const Dual& width,
              const std::array<double, n>& zmp, std::vector<UnitPiece>* pieces) {
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

// w·a + (1 − w)·b.
std::array<double, 7> Mixed(double w, const std::array<double, 7>& a,
                            const std::array<double, 6>& b) {
  std::array<double, 7> mixed;
  for (size_t k = 0; k < 7; ++k) mixed[k] = w * a[k] + (k < 6 ? (1.0 - w) * b[k] : 0.0);
  return mixed;
}

// The unit pre-bump on [0, σ₁], from rest.
std::vector<UnitPiece> PreBump(const Dual& theta, const Dual& first, double r) {
  std::vector<UnitPiece> bump;
  const auto extend = [&](const Dual& center, const Dual& width, const auto& zmp) {
    AddPiece(theta, center, width, zmp, &bump);
  };
  if (r == 1.0) {
    extend(Dual(0.0), first, kPreBump);
    return bump;
  }
  const Dual ramp = std::min(r, 0.5) * first;
  if (r > 0.5) {
    extend(Dual(0.0), ramp, Mixed(2.0 * r - 1.0, kRoundRise, kPreBumpRise));
    extend(Dual(first - ramp), ramp, Mixed(2.0 * r - 1.0, kRoundFall, kPreBumpFall));
    return bump;
  }
  extend(Dual(0.0), ramp, kPreBumpRise);
  if (r < 0.5) extend(ramp, Dual(first - 2.0 * ramp), kPreBumpTop);
  extend(Dual(first - ramp), ramp, kPreBumpFall);
  return bump;
}

// Its derivative with respect to r, which is from rest, too.
std::vector<UnitPiece> PreBumpByRamp(const Dual& theta, const Dual& first, double r) {
  std::vector<UnitPiece> slope;
  const Dual ramp = std::min(r, 0.5) * first;
  if (r > 0.5) {
    AddPiece(theta, Dual(0.0), ramp, kRiseByMixture, &slope);
    AddPiece(theta, Dual(first - ramp), ramp, kFallByMixture, &slope);
    return slope;
  }
  const auto over_r = [r](std::array<double, 6> p) {
    for (double& c : p) c /= r;
    return p;
  };
  AddPiece(theta, Dual(0.0), ramp, over_r(kRiseByRamp), &slope);
  const std::array<double, 1> none = {0.0};
  if (r < 0.5) AddPiece(theta, ramp, Dual(first - 2.0 * ramp), none, &slope);
  AddPiece(theta, Dual(first - ramp), ramp, over_r(kFallByRamp), &slope);
  return slope;
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

// The same of a derivative of F with respect to a parameter.
UnitJet ReflectedSlope(const UnitJet& f) { return {.value = -f.value, .s = f.s, .ss = -f.ss}; }

}  // namespace

RestToRest::RestToRest(double theta, double shift_fraction, double bump_ramp)
    : theta_(theta), first_(0.5 - 0.5 * shift_fraction) {
  HALFSTEP_CHECK(theta >= 0.5 && theta <= 60.0, "theta = " << theta);
  HALFSTEP_CHECK(shift_fraction >= 0.01 && shift_fraction <= 0.5,
                 "shift_fraction = " << shift_fraction);
  HALFSTEP_CHECK(bump_ramp >= 0.1 && bump_ramp <= 1.0, "bump_ramp = " << bump_ramp);
  const Dual th(theta, 2, 0), fraction(shift_fraction, 2, 1);
  const Dual delta = 0.5 * fraction, first = 0.5 - Dual(0.5 * fraction);
  const double round = std::max(0.0, 2.0 * bump_ramp - 1.0), ramp = std::min(bump_ramp, 0.5);
  bump_second_ = round * 24.0 + (1.0 - round) * 10.0 / (std::sqrt(3.0) * ramp * ramp);

  // From rest under the unit pre-bump, piece by piece; through (½, ½) with slope γ: c = forced +
  // γ·free.
  const std::vector<UnitPiece> bump = PreBump(th, first, bump_ramp);
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

  const auto coefficient = [](const Dual& x) {
    return Coefficient{x.value(), x.derivatives()[0], x.derivatives()[1]};
  };
  const auto piece_on = [](const Dual& center, const Dual& width, double end) {
    return Piece{center.value(),          width.value(),          end,
                 center.derivatives()[1], width.derivatives()[1], {}};
  };
  const auto add = [&](const std::vector<UnitPiece>& pieces, std::vector<Piece>* com,
                       std::vector<Piece>* zmp) {
    for (const UnitPiece& piece : pieces) {
      const double end =
          &piece == &pieces.back() ? first_ : piece.center.value() + piece.width.value();
      com->push_back(piece_on(piece.center, piece.width, end));
      zmp->push_back(com->back());
      for (const Dual& c : piece.com) com->back().coefficients.push_back(coefficient(a * c));
      for (double b : piece.zmp) zmp->back().coefficients.push_back(coefficient(a * b));
    }
  };
  bump_ = coefficient(a);
  add(bump, &com_, &zmp_);
  com_.push_back(piece_on(Dual(0.5), delta, 0.5));
  zmp_.push_back(com_.back());
  for (size_t k = 0; k < forced.size() || k < free.size(); ++k) {
    Dual c(0.0);
    if (k < forced.size()) c = c + forced[k];
    if (k < free.size()) c = c + gamma * free[k];
    com_.back().coefficients.push_back(coefficient(c));
  }
  for (double c : kShift) zmp_.back().coefficients.push_back({c, 0.0, 0.0});

  // With F and F' changed by dF and dF', a and γ change so that both equations still hold.
  const std::vector<UnitPiece> slope = PreBumpByRamp(th, first, bump_ramp);
  const auto [df, df_slope] = Ends(slope.back().com, 1.0);
  const Dual ds = df_slope * (delta / slope.back().width);
  const double relative = Dual((df * h_slope - ds * h) / determinant).value();
  bump_by_ramp_ = -relative;
  const double gamma_by_ramp =
      Dual((ds * p - df * p_slope) / determinant).value() - gamma.value() * relative;
  add(slope, &com_by_ramp_, &zmp_by_ramp_);
  com_by_ramp_.push_back(piece_on(Dual(0.5), delta, 0.5));
  zmp_by_ramp_.push_back(com_by_ramp_.back());
  for (const Dual& c : free) {
    com_by_ramp_.back().coefficients.push_back({gamma_by_ramp * c.value(), 0.0, 0.0});
  }
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

// With x(σ; fraction) the pieces move: F is at x, so it moves like the time w = −(center' +
// x·width').
UnitJet RestToRest::Piece::ByShift(double sigma) const {
  const double r = 1.0 / width;
  const double x = (sigma - center) * r;
  UnitJet f = At(sigma).Moved(-(center_shift + x * width_shift), -width_shift * r);
  double value = 0.0, s = 0.0, ss = 0.0;
  for (size_t k = coefficients.size(); k-- > 0;) {
    ss = ss * x + 2.0 * s;
    s = s * x + value;
    value = value * x + coefficients[k].shift;
  }
  f.value += value;
  f.s += s * r;
  f.ss += ss * r * r;
  return f;
}

const RestToRest::Piece& RestToRest::PieceAt(const std::vector<Piece>& pieces, double sigma) {
  size_t i = 0;
  while (i + 1 < pieces.size() && sigma >= pieces[i].end) ++i;
  return pieces[i];
}

UnitJet RestToRest::At(const std::vector<Piece>& pieces, double sigma) {
  if (sigma <= 0.0) return {};
  if (sigma >= 1.0) return {.value = 1.0};
  if (sigma > 0.5) return Reflected(At(pieces, 1.0 - sigma));
  return PieceAt(pieces, sigma).At(sigma);
}

UnitJet RestToRest::ByShift(const std::vector<Piece>& pieces, double sigma) {
  if (sigma <= 0.0 || sigma >= 1.0) return {};
  if (sigma > 0.5) return ReflectedSlope(ByShift(pieces, 1.0 - sigma));
  return PieceAt(pieces, sigma).ByShift(sigma);
}

UnitJet RestToRest::ByBumpRamp(const std::vector<Piece>& pieces, const std::vector<Piece>& by_ramp,
                               double sigma) const {
  if (sigma <= 0.0 || sigma >= 1.0) return {};
  if (sigma > 0.5) return ReflectedSlope(ByBumpRamp(pieces, by_ramp, 1.0 - sigma));
  UnitJet f = PieceAt(by_ramp, sigma).At(sigma);
  if (sigma < first_) {
    const UnitJet bump = PieceAt(pieces, sigma).At(sigma);
    f.value += bump_by_ramp_ * bump.value;
    f.s += bump_by_ramp_ * bump.s;
    f.ss += bump_by_ramp_ * bump.ss;
  }
  return f;
}

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
