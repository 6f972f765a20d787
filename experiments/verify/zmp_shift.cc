#include "experiments/verify/zmp_shift.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "wpg/check.h"

namespace halfstep::verify {
namespace {

using Powers = std::vector<double>;

// The two halves of the round bump −(4x(1 − x))³, and of one that rises and falls by S.
constexpr std::array<double, 7> kRoundRise = {0, 0, 0, -8, 12, -6, 1};
constexpr std::array<double, 7> kRoundFall = {-1, 0, 3, 0, -3, 0, 1};
constexpr std::array<double, 7> kFlatRise = {0, 0, 0, -10, 15, -6, 0};
constexpr std::array<double, 7> kFlatFall = {-1, 0, 0, 10, -15, 6, 0};

// s·a + t·b.
Powers Sum(double s, std::span<const double> a, double t, std::span<const double> b) {
  Powers sum(std::max(a.size(), b.size()));
  for (size_t k = 0; k < a.size(); ++k) sum[k] += s * a[k];
  for (size_t k = 0; k < b.size(); ++k) sum[k] += t * b[k];
  return sum;
}

// The solution of c'' = λ²(c − p) from c(0) and c'(0): (k + 2)(k + 1) c_{k+2} = λ²(c_k − p_k).
Powers Pendulum(double lambda, const Powers& p, double c0, double c1) {
  Powers c = {c0, c1};
  for (size_t k = 0;
       k < p.size() || std::abs(c[k]) + std::abs(c[k + 1]) > 1e-22 * (1 + std::abs(c0)); ++k) {
    const double push = c[k] - (k < p.size() ? p[k] : 0);
    c.push_back(lambda * lambda * push / static_cast<double>((k + 2) * (k + 1)));
  }
  return c;
}

Jet Evaluate(const Powers& c, double x) {
  Jet f;
  for (size_t k = c.size(); k-- > 0;) {
    f.second = f.second * x + 2 * f.first;
    f.first = f.first * x + f.value;
    f.value = f.value * x + c[k];
  }
  return f;
}

}  // namespace

Jet StepAt(double sigma, double begin, double end) {
  const double width = end - begin, x = (sigma - begin) / width, y = (end - sigma) / width;
  if (!(x > 0)) return {};
  if (!(y > 0)) return {.value = 1};
  const double z = std::min(x, y), low = z * z * z * (10 - 15 * z + 6 * z * z);
  return {.value = x < y ? low : 1 - low,
          .first = 30 * x * x * y * y / width,
          .second = 60 * x * y * (y - x) / (width * width)};
}

double StepSecondBound(double from, double to, double begin, double end) {
  const double width = end - begin;
  const double a = std::clamp((from - begin) / width, 0.0, 1.0);
  const double b = std::clamp((to - begin) / width, 0.0, 1.0);
  double most = 0;
  for (const double x : {a, b, std::clamp(0.5 - std::sqrt(1.0 / 12), a, b),
                         std::clamp(0.5 + std::sqrt(1.0 / 12), a, b)}) {
    most = std::max(most, std::abs(60 * x * (1 - x) * (1 - 2 * x)));
  }
  return most / (width * width);
}

ZmpShift::ZmpShift(double theta, double shift, double ramp)
    : theta_(theta), first_(0.5 - 0.5 * shift) {
  HALFSTEP_CHECK(theta >= 0.5 && theta <= 60, "omega T = " << theta);
  HALFSTEP_CHECK(shift >= 0.01 && shift <= 0.5, "ZMP's shift = " << shift);
  HALFSTEP_CHECK(ramp >= 0.1 && ramp <= 1, "ZMP's bump ramp = " << ramp);
  const double delta = 0.5 * shift, round = std::max(0.0, 2 * ramp - 1);
  const double rise = std::min(ramp, 0.5);  // of the bump's length
  bump_second_ = 24 * round + (1 - round) * 10 / (std::sqrt(3.0) * rise * rise);

  // From rest under the bump of a = 1.
  double begin = 0, rate = 0;  // where a piece begins; c' there
  const auto add = [&](double share, const Powers& zmp) {
    const double width = share * first_;
    const double value = pieces_.empty() ? 0 : Evaluate(pieces_.back().com, 1).value;
    const Powers com = Pendulum(theta * width, zmp, value, rate * width);
    pieces_.push_back({begin, width, begin + width, com, zmp});
    rate = Evaluate(com, 1).first / width;
    begin += width;
  };
  add(rise, Sum(round, kRoundRise, 1 - round, kFlatRise));
  if (rise < 0.5) add(1 - 2 * rise, {-1});
  add(rise, Sum(round, kRoundFall, 1 - round, kFlatFall));
  pieces_.back().end = first_;
  const double value = Evaluate(pieces_.back().com, 1).value;
  // Through (½, ½) with the slope γ: forced + γ·free, as high and as steep as a·c at σ₁.
  const Powers step = {0.5, 15.0 / 16, 0, -10.0 / 16, 0, 3.0 / 16};  // S from −1 to 1
  const Powers forced = Pendulum(theta * delta, step, 0.5, 0);
  const Powers free = Pendulum(theta * delta, {0}, 0, 1);
  const Jet p = Evaluate(forced, -1), h = Evaluate(free, -1);
  const double slope = rate * delta, determinant = slope * h.value - value * h.first;
  bump_ = (p.first * h.value - p.value * h.first) / determinant;
  const double gamma = (value * p.first - slope * p.value) / determinant;
  for (Piece& piece : pieces_) {
    for (Powers* powers : {&piece.com, &piece.zmp}) {
      for (double& c : *powers) c *= bump_;
    }
  }
  pieces_.push_back({0.5, delta, 0.5, Sum(1, forced, gamma, free), step});
}

Jet ZmpShift::At(std::vector<double> Piece::*powers, double sigma) const {
  if (sigma <= 0) return {};
  if (sigma >= 1) return {.value = 1};
  if (sigma > 0.5) {
    const Jet f = At(powers, 1 - sigma);
    return {1 - f.value, f.first, -f.second};
  }
  const Piece& piece = *std::ranges::find_if(
      pieces_, [&](const Piece& one) { return sigma < one.end || &one == &pieces_.back(); });
  const Jet f = Evaluate(piece.*powers, (sigma - piece.center) / piece.width);
  return {f.value, f.first / piece.width, f.second / (piece.width * piece.width)};
}

double ZmpShift::ZmpSecondBound(double from, double to) const {
  if (to <= 0 || from >= 1) return 0;
  const double step = StepSecondBound(from, to, first_, 1 - first_);
  if (from >= first_ && to <= 1 - first_) return step;
  return std::max(step, bump_second_ * bump_ / (first_ * first_));
}

}  // namespace halfstep::verify
