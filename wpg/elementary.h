#pragma once

#include <cmath>

/// The C library's transcendental functions, but with the same bits on every machine. glibc chooses
/// among variants of sin, cos, atan2, exp, log, pow … when a program starts, by whether the CPU has
/// FMA, and these differ in the last bit; and a compiler folds calls with constants, which depends
/// on its options. Files would differ, since a search goes on from each bit. These here are SLEEF's
/// without FMA, off by less than one unit in the last place. What is not here is exact in every
/// library (sqrt, floor, remainder …) or must not be used (`tests/structure/same_functions.py`).
namespace halfstep {

/// Sine and cosine of an angle.
struct SineCosine {
  double sin;  ///< in [−1, 1]
  double cos;  ///< in [−1, 1]
};

SineCosine SinCos(double angle);   ///< of an angle [rad]
double Asin(double x);             ///< [rad] in [−π/2, π/2]; NaN outside of [−1, 1]
double Acos(double x);             ///< [rad] in [0, π]; NaN outside of [−1, 1]
double Atan2(double y, double x);  ///< direction of (x, y) [rad] in [−π, π], as std::atan2
double Exp(double x);              ///< eˣ
double Log(double x);              ///< natural logarithm
double Log10(double x);            ///< to the base 10
double Pow(double x, double y);    ///< xʸ

inline double Sin(double angle) { return SinCos(angle).sin; }  ///< of an angle [rad]
inline double Cos(double angle) { return SinCos(angle).cos; }  ///< of an angle [rad]

/// √(x² + y²), for lengths whose squares are finite numbers (std::hypot differs by C library).
inline double Hypot(double x, double y) { return std::sqrt(x * x + y * y); }

}  // namespace halfstep
