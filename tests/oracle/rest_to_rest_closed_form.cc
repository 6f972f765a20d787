#include "tests/oracle/rest_to_rest_closed_form.h"

#include <cstddef>

namespace halfstep::oracle {
namespace {

constexpr size_t kTerms = 7;

Real Value(const std::array<Real, kTerms>& p, Real x) {
  Real sum = 0;
  for (size_t k = kTerms; k-- > 0;) sum = sum * x + p[k];
  return sum;
}

Real Slope(const std::array<Real, kTerms>& p, Real x) {
  Real sum = 0;
  for (size_t k = kTerms; k-- > 1;) sum = sum * x + static_cast<Real>(k) * p[k];
  return sum;
}

std::array<Real, kTerms> SecondDerivative(const std::array<Real, kTerms>& p) {
  std::array<Real, kTerms> d{};
  for (size_t k = 2; k < kTerms; ++k) d[k - 2] = static_cast<Real>(k * (k - 1)) * p[k];
  return d;
}

}  // namespace

RestToRestClosedForm::Polynomial RestToRestClosedForm::Particular(const Polynomial& p,
                                                                  Real lambda) {
  Polynomial sum = p, term = p;
  for (int k = 0; k < 3; ++k) {
    term = SecondDerivative(term);
    for (Real& coefficient : term) coefficient /= lambda * lambda;
    for (size_t j = 0; j < kTerms; ++j) sum[j] += term[j];
  }
  return sum;
}

ComZmp RestToRestClosedForm::Piece::At(Real x) const {
  const Real c = Cosh(lambda * x), s = Sinh(lambda * x);
  return {Value(particular, x) + cosh * c + sinh * s,
          (Slope(particular, x) + lambda * (cosh * s + sinh * c)) / width, Value(zmp, x),
          Slope(zmp, x) / width, 0};
}

// The piece whose CoM goes on from `at` where x = 0.
RestToRestClosedForm::Piece RestToRestClosedForm::Begun(Real theta, Real center, Real width,
                                                        const Polynomial& zmp, const ComZmp& at) {
  Piece piece{.center = center, .width = width, .lambda = theta * width, .zmp = zmp};
  piece.particular = Particular(zmp, piece.lambda);
  piece.cosh = at.c - piece.particular[0];
  piece.sinh = (at.c_rate * width - piece.particular[1]) / piece.lambda;
  return piece;
}

RestToRestClosedForm::RestToRestClosedForm(Real theta, Real shift, Real bump_ramp)
    : theta_(theta), sigma1_((1 - shift) / 2), delta_(shift / 2) {
  // −B on its pieces, from rest at 0, and (15x − 10x³ + 3x⁵)/16, the shift less its centre ½.
  if (bump_ramp == 1) {
    bump_ = {Begun(theta, 0, sigma1_, {0, 0, 0, -64, 192, -192, 64}, {})};
  } else if (bump_ramp > Real(1) / 2) {
    // Of both halves: (1 − w)·S(x) + w·64y³(1 − y)³ with y = x/2, and the same with 1 − x.
    const Real w = 2 * bump_ramp - 1, half = sigma1_ / 2;
    const Polynomial up = {0, 0, 0, 10 - 2 * w, -15 + 3 * w, 6, -w};
    Polynomial rise{}, fall{};
    const Real binomial[7][7] = {{1},
                                 {1, 1},
                                 {1, 2, 1},
                                 {1, 3, 3, 1},
                                 {1, 4, 6, 4, 1},
                                 {1, 5, 10, 10, 5, 1},
                                 {1, 6, 15, 20, 15, 6, 1}};
    for (size_t k = 0; k < kTerms; ++k) {
      rise[k] = -up[k];
      for (size_t j = 0; j <= k; ++j) fall[j] -= (j % 2 == 0 ? 1 : -1) * binomial[k][j] * up[k];
    }
    bump_ = {Begun(theta, 0, half, rise, {})};
    bump_.push_back(Begun(theta, half, half, fall, bump_.back().At(1)));
  } else {
    const Real ramp = bump_ramp * sigma1_;
    bump_ = {Begun(theta, 0, ramp, {0, 0, 0, -10, 15, -6}, {})};
    bump_.push_back(Begun(theta, ramp, sigma1_ - 2 * ramp, {-1}, bump_.back().At(1)));
    bump_.push_back(Begun(theta, sigma1_ - ramp, ramp, {-1, 0, 0, 10, -15, 6}, bump_.back().At(1)));
  }
  shift_ =
      Begun(theta, Real(1) / 2, delta_, {0, Real(15) / 16, 0, -Real(10) / 16, 0, Real(3) / 16}, {});
  shift_.cosh = shift_.sinh = 0;
  const Real cosh = Cosh(shift_.lambda), sinh = Sinh(shift_.lambda);
  // a·F = ½ + Q(−1) − G sinh λ,  a·F' = Q'(−1) + G λ cosh λ, slopes in σ.
  const ComZmp F = bump_.back().At(1), Q = shift_.At(-1);
  const Real middle = Real(1) / 2 + Q.c, cosh_rate = shift_.lambda * cosh / delta_;
  const Real determinant = -F.c * cosh_rate - sinh * F.c_rate;
  amplitude_ = (-middle * cosh_rate - sinh * Q.c_rate) / determinant;
  shift_.sinh = (F.c * Q.c_rate - F.c_rate * middle) / determinant;
}

ComZmp RestToRestClosedForm::At(Real sigma) const {
  ComZmp at = ByPieces(sigma);
  at.c_second = theta_ * theta_ * (at.c - at.p);
  return at;
}

ComZmp RestToRestClosedForm::ByPieces(Real sigma) const {
  if (sigma <= 0) return {};
  if (sigma >= 1) return {.c = 1, .p = 1};
  if (sigma > Real(1) / 2) {
    const ComZmp mirrored = ByPieces(1 - sigma);
    return {1 - mirrored.c, mirrored.c_rate, 1 - mirrored.p, mirrored.p_rate, 0};
  }
  if (sigma >= sigma1_) {
    ComZmp at = shift_.At((sigma - shift_.center) / shift_.width);
    at.c += Real(1) / 2;
    at.p += Real(1) / 2;
    return at;
  }
  size_t i = 0;
  while (i + 1 < bump_.size() && sigma >= bump_[i + 1].center) ++i;
  const ComZmp at = bump_[i].At((sigma - bump_[i].center) / bump_[i].width);
  return {amplitude_ * at.c, amplitude_ * at.c_rate, amplitude_ * at.p, amplitude_ * at.p_rate, 0};
}

}  // namespace halfstep::oracle
