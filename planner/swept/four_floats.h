#pragma once

#include <Eigen/Core>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace halfstep {

/// Four floats side by side. The compiler does not vectorize the tests that need them at -O2.
#if defined(__SSE2__)
struct Four {
  __m128 v;
  explicit Four(__m128 from) : v(from) {}
  explicit Four(float from) : v(_mm_set1_ps(from)) {}
  static Four Load(const float* from) { return Four(_mm_loadu_ps(from)); }
  static Four Load(const uint16_t* from) {
    const __m128i words = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from));
    return Four(_mm_cvtepi32_ps(_mm_unpacklo_epi16(words, _mm_setzero_si128())));
  }
  friend Four operator+(Four a, Four b) { return Four(_mm_add_ps(a.v, b.v)); }
  friend Four operator-(Four a, Four b) { return Four(_mm_sub_ps(a.v, b.v)); }
  friend Four operator*(Four a, Four b) { return Four(_mm_mul_ps(a.v, b.v)); }
  friend Four Min(Four a, Four b) { return Four(_mm_min_ps(a.v, b.v)); }
  friend Four Max(Four a, Four b) { return Four(_mm_max_ps(a.v, b.v)); }
  void Store(float* to) const { _mm_storeu_ps(to, v); }
  Four Abs() const { return Four(_mm_andnot_ps(_mm_set1_ps(-0.0f), v)); }
  /// Bit c: component c is at most that of `most`.
  int Within(Four most) const { return _mm_movemask_ps(_mm_cmple_ps(v, most.v)); }
};
#else
struct Four {
  Eigen::Array4f v;
  explicit Four(const Eigen::Array4f& from) : v(from) {}
  explicit Four(float from) : v(Eigen::Array4f::Constant(from)) {}
  template <typename Number>
  static Four Load(const Number* from) {
    return Four(Eigen::Map<const Eigen::Array<Number, 4, 1> >(from).template cast<float>());
  }
  friend Four operator+(const Four& a, const Four& b) { return Four(a.v + b.v); }
  friend Four operator-(const Four& a, const Four& b) { return Four(a.v - b.v); }
  friend Four operator*(const Four& a, const Four& b) { return Four(a.v * b.v); }
  friend Four Min(const Four& a, const Four& b) { return Four(a.v.min(b.v)); }
  friend Four Max(const Four& a, const Four& b) { return Four(a.v.max(b.v)); }
  void Store(float* to) const { Eigen::Map<Eigen::Array4f>(to) = v; }
  Four Abs() const { return Four(v.abs()); }
  int Within(const Four& most) const {
    int mask = 0;
    for (int c = 0; c < 4; ++c) mask |= (v[c] <= most.v[c] ? 1 : 0) << c;
    return mask;
  }
};
#endif

}  // namespace halfstep
