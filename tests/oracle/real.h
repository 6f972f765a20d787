#pragma once

#if __has_include(<quadmath.h>) && defined(__SIZEOF_FLOAT128__)
#include <quadmath.h>
#else
#include <cmath>
#endif

namespace halfstep::oracle {

/// The oracle's number: 113 bits of mantissa where the compiler has them (gcc, libquadmath), else
/// what long double has.
#if __has_include(<quadmath.h>) && defined(__SIZEOF_FLOAT128__)
__extension__ using Real = __float128;
inline Real Cosh(Real x) { return coshq(x); }
inline Real Sinh(Real x) { return sinhq(x); }
inline Real Cos(Real x) { return cosq(x); }
inline Real Sin(Real x) { return sinq(x); }
inline Real Sqrt(Real x) { return sqrtq(x); }
#else
using Real = long double;
inline Real Cosh(Real x) { return std::cosh(x); }
inline Real Sinh(Real x) { return std::sinh(x); }
inline Real Cos(Real x) { return std::cos(x); }
inline Real Sin(Real x) { return std::sin(x); }
inline Real Sqrt(Real x) { return std::sqrt(x); }
#endif

/// Of all that falls [m/s²].
inline constexpr double kGravity = 9.81;

}  // namespace halfstep::oracle
