#include "wpg/motion/rest_to_rest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "wpg/check.h"
#include "wpg/motion/pre_bump.h"
#include "wpg/motion/smoothstep.h"
#include "wpg/rounded.h"

namespace halfstep {
namespace {

// ½ + (15x − 10x³ + 3x⁵)/16 in powers of x = (σ − ½)/δ.
constexpr std::array<double, 6> kShift = {0.5, 15.0 / 16, 0, -10.0 / 16, 0, 3.0 / 16};

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

// RestToRest on [0, ½], and what its derivatives need.
template <typename Number>
struct HalfMotion {
  Number a, gamma;                        // the bump's amplitude, the slope in the middle
  std::vector<UnitPiece<Number>> pieces;  // those of the bump, and the shift's
  // Of forced and free motion on the shift, at σ₁; the system's determinant.
  Number delta, p, p_slope, h, h_slope, determinant;
  std::vector<Number> free;
};

// RestToRest on [0, ½], and its derivative with respect to the bump's ramp.
struct UnitMotion {
  HalfMotion<UnitDual> half;
  double bump_by_ramp;                       // a'/a
  std::vector<UnitPiece<UnitDual>> by_ramp;  // but for what a' multiplies
};

template <typename Number>
void Scale(const Number& amplitude, std::vector<UnitPiece<Number>>* pieces) {
  for (UnitPiece<Number>& piece : *pieces) {
    for (Number& c : piece.com) c = amplitude * c;
    for (Number& p : piece.zmp) p = amplitude * p;
  }
}

template <typename Number>
HalfMotion<Number> SolveHalf(const Number& theta, const Number& fraction, double bump_ramp) {
  const Number delta = 0.5 * fraction, first = 0.5 - Number(0.5 * fraction);
  // From rest under the unit pre-bump, piece by piece; through (½, ½) with slope γ: c = forced +
  // γ·free.
  std::vector<UnitPiece<Number>> bump = PreBump<Number>(theta, first, bump_ramp);
  const UnitPiece<Number>& last = bump.back();
  const Number lambda = theta * delta;
  std::vector<Number> shift_zmp, none = {Number(0.0)};
  for (const double p : kShift) shift_zmp.emplace_back(p);
  const std::vector<Number> forced = SolveLipm<Number>(lambda, shift_zmp, Number(0.5), Number(0.0));
  const std::vector<Number> free = SolveLipm<Number>(lambda, none, Number(0.0), Number(1.0));

  // Value and slope continuous at σ₁: a·F = P + γ·H,  a·F'/σ₁ = (P' + γ·H')/δ.
  const auto [f, f_slope] = Ends(last.com, 1.0);
  const auto [p, p_slope] = Ends(forced, -1.0);
  const auto [h, h_slope] = Ends(free, -1.0);
  const Number s = f_slope * (delta / last.width);
  const Number determinant = f * h_slope - s * h;
  const Number a = (p * h_slope - p_slope * h) / determinant;
  const Number gamma = (s * p - f * p_slope) / determinant;
  UnitPiece<Number> shift{Number(0.5), delta, {}, shift_zmp};
  for (size_t k = 0; k < forced.size() || k < free.size(); ++k) {
    Number c(0.0);
    if (k < forced.size()) c = c + forced[k];
    if (k < free.size()) c = c + gamma * free[k];
    shift.com.push_back(c);
  }
  Scale(a, &bump);
  bump.push_back(std::move(shift));
  return {a, gamma, std::move(bump), delta, p, p_slope, h, h_slope, determinant, free};
}

UnitMotion SolveMotion(const UnitDual& theta, const UnitDual& fraction, double bump_ramp) {
  UnitMotion motion{
      .half = SolveHalf(theta, fraction, bump_ramp), .bump_by_ramp = 0.0, .by_ramp = {}};
  const auto& [a, gamma, pieces, delta, p, p_slope, h, h_slope, determinant, free] = motion.half;
  const UnitDual first = 0.5 - UnitDual(0.5 * fraction);
  // With F and F' changed by dF and dF', a and γ change so that both equations still hold.
  std::vector<UnitPiece<UnitDual>> slope = PreBumpByRamp(theta, first, bump_ramp);
  const auto [df, df_slope] = Ends(slope.back().com, 1.0);
  const UnitDual ds = df_slope * (delta / slope.back().width);
  const double relative = UnitDual((df * h_slope - ds * h) / determinant).value();
  const double gamma_by_ramp =
      UnitDual((ds * p - df * p_slope) / determinant).value() - gamma.value() * relative;
  UnitPiece<UnitDual> shift_by_ramp{UnitDual(0.5), delta, {}, {}};
  for (const UnitDual& c : free) shift_by_ramp.com.emplace_back(gamma_by_ramp * c.value());
  Scale(a, &slope);
  slope.push_back(std::move(shift_by_ramp));
  motion.bump_by_ramp = -relative;
  motion.by_ramp = std::move(slope);
  return motion;
}

}  // namespace

RestToRest::RestToRest(double theta, double shift_fraction, double bump_ramp)
    : theta_(theta), first_(0.5 - 0.5 * shift_fraction) {
  HALFSTEP_CHECK(theta >= 0.5 && theta <= 60.0, "theta = " << theta);
  HALFSTEP_CHECK(shift_fraction >= 0.01 && shift_fraction <= 0.5,
                 "shift_fraction = " << shift_fraction);
  HALFSTEP_CHECK(bump_ramp >= 0.1 && bump_ramp <= 1.0, "bump_ramp = " << bump_ramp);
  const double round = std::max(0.0, 2.0 * bump_ramp - 1.0), ramp = std::min(bump_ramp, 0.5);
  bump_second_ = round * 24.0 + (1.0 - round) * 10.0 / (std::sqrt(3.0) * ramp * ramp);

  const UnitMotion motion =
      SolveMotion(UnitDual(theta, 2, 0), UnitDual(shift_fraction, 2, 1), bump_ramp);
  const auto coefficient = [](const UnitDual& x) {
    return Coefficient{x.value(), x.derivatives()[0], x.derivatives()[1]};
  };
  const auto add = [&](const UnitPiece<UnitDual>& of, double end,
                       const std::vector<UnitDual>& series, std::vector<Piece>* pieces) {
    Piece piece{of.center.value(),          of.width.value(),          end,
                of.center.derivatives()[1], of.width.derivatives()[1], {}};
    piece.coefficients.reserve(series.size());
    for (const UnitDual& c : series) piece.coefficients.push_back(coefficient(c));
    pieces->push_back(std::move(piece));
  };
  // The bump's pieces end at σ₁, the shift's at ½.
  const auto add_all = [&](const std::vector<UnitPiece<UnitDual>>& of, std::vector<Piece>* com,
                           std::vector<Piece>* zmp) {
    for (size_t i = 0; i < of.size(); ++i) {
      const double end = i + 1 == of.size()   ? 0.5
                         : i + 2 == of.size() ? first_
                                              : of[i].center.value() + of[i].width.value();
      add(of[i], end, of[i].com, com);
      add(of[i], end, of[i].zmp, zmp);
    }
  };
  bump_ = coefficient(motion.half.a);
  bump_by_ramp_ = motion.bump_by_ramp;
  add_all(motion.half.pieces, &com_, &zmp_);
  add_all(motion.by_ramp, &com_by_ramp_, &zmp_by_ramp_);
  FindAccuracy(shift_fraction, bump_ramp, round);
}

void RestToRest::FindAccuracy(double shift_fraction, double bump_ramp, double round) {
  const HalfMotion<WithError> half =
      SolveHalf(WithError(theta_, 4.0 * kRoundoff * theta_), WithError(shift_fraction), bump_ramp);
  UnitAccuracy &com = com_accuracy_, &zmp = zmp_accuracy_;
  for (const UnitPiece<WithError>& piece : half.pieces) {
    AddSeries(piece.com, piece.center, piece.width, &com.error, &com.most);
    AddSeries(piece.zmp, piece.center, piece.width, &zmp.error, &zmp.most);
  }
  const double a = half.a.most(), square = theta_ * theta_ * (1.0 + 16.0 * kRoundoff);
  com.most.value = zmp.most.value = 1.0 + a;
  // c is convex on [0, ½], and antisymmetric.
  com.most.ss = square * (0.5 + a);
  com.most.s = 0.5 * com.most.ss;
  const double ramp = std::min(bump_ramp, 0.5);
  zmp.most.s = std::max(1.0 / (0.5 * shift_fraction),
                        a / first_ * (4.0 * round + 2.0 * (1.0 - round) / ramp));
  zmp.most.ss = ZmpSecondBound(0.0, 1.0) * (1.0 + half.a.error() / bump_.value) * 1.001;
  com.most.sss = square * (com.most.s + zmp.most.s);
}

template <bool with_theta>
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
    if constexpr (!with_theta) continue;
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
  UnitJet f = At<false>(sigma).Moved(-(center_shift + x * width_shift), -width_shift * r);
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
  UnitJet f = PieceAt(by_ramp, sigma).At<false>(sigma);
  if (sigma < first_) {
    const UnitJet bump = PieceAt(pieces, sigma).At<false>(sigma);
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
  const double off = theta_ * theta_ * (com_accuracy_.error.s + zmp_accuracy_.error.s);
  return {Com(0.5 * (from + to)).sss, 0.5 * (to - from) * fourth + 2.0 * off};
}

}  // namespace halfstep
