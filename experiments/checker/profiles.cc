#include "experiments/checker/profiles.h"

#include <algorithm>

namespace halfstep::checker {
namespace {

using Powers = std::vector<Interval>;

constexpr double kEver = 1e9;

// s·a + t·b.
Powers Sum(const Interval& s, const Powers& a, const Interval& t, const Powers& b) {
  Powers sum(std::max(a.size(), b.size()));
  for (size_t k = 0; k < a.size(); ++k) sum[k] = s * a[k];
  for (size_t k = 0; k < b.size(); ++k) sum[k] = sum[k] + t * b[k];
  return sum;
}

// The value and k!⁻¹ times the derivatives of Σ c_k x^k.
std::array<Interval, 4> Horner(const Powers& c, const Interval& x) {
  std::array<Interval, 4> f;
  for (size_t k = c.size(); k-- > 0;) {
    for (size_t i = 3; i > 0; --i) f[i] = f[i] * x + f[i - 1];
    f[0] = f[0] * x + c[k];
  }
  return f;
}

// Of c_xx = λ²(c − p) on |x| ≤ 1: (k + 2)(k + 1) c_{k+2} = λ²(c_k − p_k). From K on, where p has no
// more powers and λ² ≤ K²/4, every second term is at most a quarter, of c and of k·c, so that what
// is left out is at most a third of the last two terms; twice that is told.
struct Series {
  Powers c;
  double tail = 0.0;

  Series(const Interval& lambda_squared, const Powers& p, const Interval& c0, const Interval& c1)
      : c{c0, c1} {
    for (size_t k = 0;; ++k) {
      const double last = c[k].Magnitude() + c[k + 1].Magnitude(), n = static_cast<double>(k);
      tail = (n + 1.0) * last;
      if (k >= p.size() && lambda_squared.hi <= n * n / 4.0 && (tail < 1e-24 || k > 400)) break;
      const Interval push = k < p.size() ? c[k] - p[k] : c[k];
      c.push_back(lambda_squared * push / Interval((n + 2.0) * (n + 1.0)));
    }
  }
  // Value and slope at x.
  std::array<Interval, 2> At(double x) const {
    const std::array<Interval, 4> f = Horner(c, x);
    const Interval off(-tail, tail);
    return {f[0] + off, f[1] + off};
  }
};

// 1 − π(1 − σ) of the pieces up to ½, in the order of σ.
void AppendMirrored(std::vector<Profile::Piece>* pieces) {
  for (size_t i = pieces->size(); i-- > 0;) {
    Profile::Piece piece = (*pieces)[i];
    std::swap(piece.begin, piece.end);
    for (Interval* x : {&piece.begin, &piece.end, &piece.center}) *x = Interval(1.0) - *x;
    piece.width = -piece.width;
    for (Interval& c : piece.powers) c = -c;
    piece.powers[0] = Interval(1.0) + piece.powers[0];
    pieces->push_back(std::move(piece));
  }
}

}  // namespace

Profile::Profile(const std::vector<Piece>& pieces) {
  pieces_.push_back({-kEver, pieces.front().begin, 0.0, 1.0, {0.0}});
  pieces_.insert(pieces_.end(), pieces.begin(), pieces.end());
  pieces_.push_back({pieces.back().end, kEver, 0.0, 1.0, {1.0}});
}

Profile Profile::Step(const Interval& begin, const Interval& end) {
  return Profile({{begin, end, begin, end - begin, {0.0, 0.0, 0.0, 10.0, -15.0, 6.0}}});
}

Profile Profile::RampedStep(const Interval& begin, const Interval& end, double r) {
  const Interval width = end - begin, ramp = Interval(r) * width;
  const Interval share = Interval(15.0) - Interval(14.0) * Interval(r);
  const Interval a = Interval(16.0) * Interval(r) / share, v = Interval(15.0) / share;
  const Powers step = Sum(a, {0.0, 0.0, 0.0, 10.0, -15.0, 6.0}, 0.0, {});
  const Interval center = Interval(0.5) * (begin + end), twice = Interval(2.0) * ramp;
  return Profile({{begin, begin + ramp, begin, twice, step},
                  {begin + ramp, end - ramp, center, width, {0.5, v}},
                  {end - ramp, end, end, -twice, {1.0, 0.0, 0.0, -step[3], -step[4], -step[5]}}});
}

std::array<Interval, 4> Profile::At(const Interval& sigma) const {
  std::array<Interval, 4> all;
  bool any = false;
  for (const Piece& piece : pieces_) {
    const Interval of(std::max(sigma.lo, piece.begin.lo), std::min(sigma.hi, piece.end.hi));
    if (of.lo > of.hi) continue;
    const Interval scale = Interval(1.0) / piece.width;
    std::array<Interval, 4> f = Horner(piece.powers, (of - piece.center) * scale);
    const Interval off(-piece.tail, piece.tail);
    f = {f[0] + off, (f[1] + off) * scale, Interval(2.0) * (f[2] * Square(scale)),
         Interval(6.0) * (f[3] * (scale * Square(scale)))};
    for (size_t k = 0; k < 4; ++k) all[k] = any ? Hull(all[k], f[k]) : f[k];
    any = true;
  }
  return all;
}

// From rest under the bump of a = 1, piece after piece; then through (½, ½) with the slope γ such
// that value and slope agree where bump and shift meet.
Pendulum Pendulum::Of(const Interval& theta_squared, const Interval& shift, double ramp) {
  const Interval first = Interval(0.5) - Interval(0.5) * shift, delta = Interval(0.5) * shift;
  const Interval round = ramp > 0.5 ? Interval(2.0) * Interval(ramp) - Interval(1.0) : 0.0;
  const Interval flat = Interval(1.0) - round;
  const double rise = std::min(ramp, 0.5);
  // −(4x(1 − x))³ and −S, up and down.
  const Powers up =
      Sum(round, {0.0, 0.0, 0.0, -8.0, 12.0, -6.0, 1.0}, flat, {0.0, 0.0, 0.0, -10.0, 15.0, -6.0});
  const Powers down =
      Sum(round, {-1.0, 0.0, 3.0, 0.0, -3.0, 0.0, 1.0}, flat, {-1.0, 0.0, 0.0, 10.0, -15.0, 6.0});
  std::vector<Profile::Piece> com, zmp;
  Interval begin = 0.0, value = 0.0, rate = 0.0;  // of the next piece; c, c' there
  const auto add = [&](const Interval& share, const Powers& p) {
    const Interval width = share * first;
    const Series series(theta_squared * Square(width), p, value, rate * width);
    com.push_back({begin, begin + width, begin, width, series.c, series.tail});
    zmp.push_back({begin, begin + width, begin, width, p});
    const auto [c, slope] = series.At(1.0);
    value = c;
    rate = slope / width;
    begin = begin + width;
  };
  add(rise, up);
  if (rise < 0.5) add(Interval(1.0) - Interval(2.0) * Interval(rise), {-1.0});
  add(rise, down);

  const Powers step = {0.5, 15.0 / 16.0, 0.0, -10.0 / 16.0, 0.0, 3.0 / 16.0};
  const Interval lambda_squared = theta_squared * Square(delta);
  const Series forced(lambda_squared, step, 0.5, 0.0), free(lambda_squared, {}, 0.0, 1.0);
  const auto [p, p_slope] = forced.At(-1.0);
  const auto [q, q_slope] = free.At(-1.0);
  const Interval slope = rate * delta, determinant = slope * q - value * q_slope;
  const Interval a = (p_slope * q - p * q_slope) / determinant;
  const Interval gamma = (value * p_slope - slope * p) / determinant;
  for (std::vector<Profile::Piece>* pieces : {&com, &zmp}) {
    for (Profile::Piece& piece : *pieces) {
      for (Interval& c : piece.powers) c = a * c;
      piece.tail = (a * Interval(piece.tail)).Magnitude();
    }
  }
  com.push_back({first, 0.5, 0.5, delta, Sum(1.0, forced.c, gamma, free.c),
                 Above(forced.tail + Above(gamma.Magnitude() * free.tail))});
  zmp.push_back({first, 0.5, 0.5, delta, step});
  AppendMirrored(&com);
  AppendMirrored(&zmp);
  return {theta_squared, Profile(com), Profile(zmp)};
}

std::array<Interval, 4> Pendulum::ComAt(const Interval& sigma) const {
  const std::array<Interval, 4> c = com.At(sigma), p = zmp.At(sigma);
  return {c[0], c[1], theta_squared * (c[0] - p[0]), theta_squared * (c[1] - p[1])};
}

}  // namespace halfstep::checker
