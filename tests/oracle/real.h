#pragma once

#if defined(HALFSTEP_ORACLE_MPFR)
#include <boost/multiprecision/mpfr.hpp>
#elif __has_include(<quadmath.h>) && defined(__SIZEOF_FLOAT128__)
#include <quadmath.h>
#else
#include <cmath>
#endif

namespace halfstep::oracle {

/// The oracle's number: 50 digits of MPFR where it is built so (CMake: HALFSTEP_ORACLE_MPFR), else
/// 113 bits of mantissa where the compiler has them (gcc, libquadmath), else what long double has.
#if defined(HALFSTEP_ORACLE_MPFR)
using Real = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<50, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;
inline Real Cosh(const Real& x) { return cosh(x); }
inline Real Sinh(const Real& x) { return sinh(x); }
inline Real Cos(const Real& x) { return cos(x); }
inline Real Sin(const Real& x) { return sin(x); }
inline Real Sqrt(const Real& x) { return sqrt(x); }
#elif __has_include(<quadmath.h>) && defined(__SIZEOF_FLOAT128__)
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
