#pragma once

#include <cmath>

namespace halfstep {

/// What one operation rounds by at most, as a fraction of its result: 2⁻⁵³.
inline constexpr double kRoundoff = 0x1p-53;

/// A number as it is computed, and a bound of how far the exact one is from it: the exact result of
/// the same operations on exact operands. For running error analysis of a formula that is a
/// template of its number. Source: smoothing/README.md, "Rounding", 1.
class WithError {
 public:
  WithError() = default;
  /// From a number, exact unless said.
  explicit WithError(double value, double error = 0.0) : value_(value), error_(error) {}

  double value() const { return value_; }                    ///< as it is computed
  double error() const { return error_; }                    ///< |exact − value| at most
  double most() const { return std::abs(value_) + error_; }  ///< |exact| at most

  friend WithError operator+(const WithError& a, const WithError& b) {
    return Of(a.value_ + b.value_, a.error_ + b.error_);
  }  ///< plus
  friend WithError operator-(const WithError& a, const WithError& b) {
    return Of(a.value_ - b.value_, a.error_ + b.error_);
  }  ///< minus
  friend WithError operator*(const WithError& a, const WithError& b) {
    return Of(a.value_ * b.value_, std::abs(a.value_) * b.error_ + a.error_ * b.most());
  }  ///< times
  /// The error is not finite where b may be 0.
  friend WithError operator/(const WithError& a, const WithError& b) {
    const double value = a.value_ / b.value_, least = std::abs(b.value_) - b.error_;
    return Of(value, least > 0.0 ? (a.error_ + std::abs(value) * b.error_) / least : HUGE_VAL);
  }
  friend WithError operator+(const WithError& a, double b) { return a + WithError(b); }  ///< plus
  friend WithError operator-(const WithError& a, double b) { return a - WithError(b); }  ///< minus
  friend WithError operator*(const WithError& a, double b) { return a * WithError(b); }  ///< times
  friend WithError operator/(const WithError& a, double b) { return a / WithError(b); }  ///< over
  friend WithError operator+(double a, const WithError& b) { return WithError(a) + b; }  ///< plus
  friend WithError operator-(double a, const WithError& b) { return WithError(a) - b; }  ///< minus
  friend WithError operator*(double a, const WithError& b) { return WithError(a) * b; }  ///< times

 private:
  // The operation's own rounding besides; outward, for the few by which the bound is found. The
  // last term is for results next to zero.
  static WithError Of(double value, double error) {
    return WithError(value,
                     (error + kRoundoff * std::abs(value)) * (1.0 + 16.0 * kRoundoff) + 1e-300);
  }

  double value_ = 0.0, error_ = 0.0;
};

}  // namespace halfstep
