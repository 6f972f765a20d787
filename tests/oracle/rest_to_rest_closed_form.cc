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

RestToRestClosedForm::RestToRestClosedForm(Real theta, Real shift)
    : sigma1_((1 - shift) / 2),
      delta_(shift / 2),
      lambda_bump_(theta * (1 - shift) / 2),
      lambda_shift_(theta * shift / 2) {
  // −(4x(1 − x))³ and (15x − 10x³ + 3x⁵)/16, the shift less its centre ½.
  bump_ = {0, 0, 0, -64, 192, -192, 64};
  shift_ = {0, Real(15) / 16, 0, -Real(10) / 16, 0, Real(3) / 16, 0};
  bump_particular_ = Particular(bump_, lambda_bump_);
  shift_particular_ = Particular(shift_, lambda_shift_);
  // From rest at 0.
  bump_cosh_ = -bump_particular_[0];
  bump_sinh_ = -bump_particular_[1] / lambda_bump_;
  // a·F = ½ + Q(−1) − G sinh λ,  a·F'/σ₁ = (Q'(−1) + G λ cosh λ)/δ.
  const Real F = Value(bump_particular_, 1) + bump_cosh_ * Cosh(lambda_bump_) +
                 bump_sinh_ * Sinh(lambda_bump_);
  const Real F_rate =
      (Slope(bump_particular_, 1) +
       lambda_bump_ * (bump_cosh_ * Sinh(lambda_bump_) + bump_sinh_ * Cosh(lambda_bump_))) /
      sigma1_;
  const Real Q = Real(1) / 2 + Value(shift_particular_, -1);
  const Real Q_rate = Slope(shift_particular_, -1) / delta_;
  const Real sinh = Sinh(lambda_shift_), cosh_rate = lambda_shift_ * Cosh(lambda_shift_) / delta_;
  // F a + sinh G = Q,  F_rate a − cosh_rate G = Q_rate.
  const Real determinant = -F * cosh_rate - sinh * F_rate;
  amplitude_ = (-Q * cosh_rate - sinh * Q_rate) / determinant;
  shift_sinh_ = (F * Q_rate - F_rate * Q) / determinant;
}

ComZmp RestToRestClosedForm::OnBump(Real sigma) const {
  const Real x = sigma / sigma1_, cosh = Cosh(lambda_bump_ * x), sinh = Sinh(lambda_bump_ * x);
  return {
      amplitude_ * (Value(bump_particular_, x) + bump_cosh_ * cosh + bump_sinh_ * sinh),
      amplitude_ *
          (Slope(bump_particular_, x) + lambda_bump_ * (bump_cosh_ * sinh + bump_sinh_ * cosh)) /
          sigma1_,
      amplitude_ * Value(bump_, x), amplitude_ * Slope(bump_, x) / sigma1_};
}

ComZmp RestToRestClosedForm::OnShift(Real sigma) const {
  const Real x = (sigma - Real(1) / 2) / delta_;
  return {Real(1) / 2 + Value(shift_particular_, x) + shift_sinh_ * Sinh(lambda_shift_ * x),
          (Slope(shift_particular_, x) + shift_sinh_ * lambda_shift_ * Cosh(lambda_shift_ * x)) /
              delta_,
          Real(1) / 2 + Value(shift_, x), Slope(shift_, x) / delta_};
}

ComZmp RestToRestClosedForm::At(Real sigma) const {
  if (sigma <= 0) return {};
  if (sigma >= 1) return {1, 0, 1, 0};
  if (sigma > Real(1) / 2) {
    const ComZmp mirrored = At(1 - sigma);
    return {1 - mirrored.c, mirrored.c_rate, 1 - mirrored.p, mirrored.p_rate};
  }
  return sigma < sigma1_ ? OnBump(sigma) : OnShift(sigma);
}

}  // namespace halfstep::oracle
