#pragma once

#include <algorithm>
#include <array>

#include "experiments/checker/frame.h"
#include "experiments/checker/interval.h"

namespace halfstep::checker {

/// Thrown where a function is not defined on a whole interval, for what is divided by may be 0 or a
/// root's argument negative there. Of shorter intervals more may be known.
struct NotDefined {};

/// A function f of time on [m − h, m + h] whose derivative of order N − 1 is Lipschitz, N ≤ 3:
/// enclosures of f, ḟ, … at m, of the same at every t, and of its Nth derivative wherever there is
/// one. Lower orders at every t follow from what is known at m by Taylor's theorem, so that they
/// are off by the order of h² when h is small. Results hold whatever functions the operands hold.
template <int N>
struct Taylor {
  std::array<Interval, N> at{};        ///< at m
  std::array<Interval, N + 1> over{};  ///< at every t
  double h = 0.0;                      ///< [s]; of constants 0

  Taylor() = default;
  /// A constant.
  Taylor(const Interval& x) { at[0] = over[0] = x; }  // NOLINT: a number is a function
  /// The same.
  Taylor(double x) : Taylor(Interval(x)) {}  // NOLINT

  /// Finds over[0 … N − 1]: |f⁽ᵏ⁾(t) − f⁽ᵏ⁾(m)| ≤ h|f⁽ᵏ⁺¹⁾(m)| + ½h²|f⁽ᵏ⁺²⁾(m)| + …
  Taylor& Enclose() {
    for (size_t k = N; k-- > 0;) {
      double off = over[N].Magnitude();
      for (size_t i = N - 1; i > k; --i) {
        off = at[i].Magnitude() + h / static_cast<double>(i + 1 - k) * off;
      }
      off *= h * (1.0 + 0x1p-46);  // more than all rounding
      over[k] = {Below(at[k].lo - off), Above(at[k].hi + off)};
    }
    return *this;
  }

  /// The derivative of order K, of which fewer derivatives are known.
  template <int K, int M>
  Taylor<M> Derivative() const {
    static_assert(K + M <= N);
    Taylor<M> of;
    std::copy_n(at.begin() + K, M, of.at.begin());
    std::copy_n(over.begin() + K, M + 1, of.over.begin());
    of.h = h;
    return of;
  }

  /// −a.
  friend Taylor operator-(Taylor a) {
    for (Interval& x : a.at) x = -x;
    for (Interval& x : a.over) x = -x;
    return a;
  }
  /// a + b.
  friend Taylor operator+(Taylor a, const Taylor& b) {
    for (size_t k = 0; k < N; ++k) a.at[k] = a.at[k] + b.at[k];
    a.over[N] = a.over[N] + b.over[N];
    a.h = std::max(a.h, b.h);
    return a.Enclose();
  }
  /// a − b.
  friend Taylor operator-(const Taylor& a, const Taylor& b) { return a + (-b); }
  /// k·a.
  friend Taylor operator*(const Interval& k, Taylor a) {
    for (Interval& x : a.at) x = k * x;
    for (Interval& x : a.over) x = k * x;
    return a;
  }
  /// The same; by 0 and 1 without rounding.
  friend Taylor operator*(double k, const Taylor& a) {
    return k == 0.0 ? Taylor() : k == 1.0 ? a : Interval(k) * a;
  }
  /// a·b, by Leibniz' rule.
  friend Taylor operator*(const Taylor& a, const Taylor& b) {
    Taylor c;
    c.h = std::max(a.h, b.h);
    for (size_t k = 0; k < N; ++k) c.at[k] = Leibniz(a.at, b.at, k);
    c.over[N] = Leibniz(a.over, b.over, N);
    return c.Enclose();
  }

 private:
  // The kth derivative of a product.
  template <size_t M>
  static Interval Leibniz(const std::array<Interval, M>& a, const std::array<Interval, M>& b,
                          size_t k) {
    Interval sum = a[0] * b[k];
    double choose = 1.0;
    for (size_t i = 1; i <= k; ++i) {
      choose = choose * static_cast<double>(k + 1 - i) / static_cast<double>(i);
      sum = sum + Interval(choose) * (a[i] * b[k - i]);
    }
    return sum;
  }
};

/// g∘f; `of(x)` encloses g and its first three derivatives on an interval.
template <int N, typename Function>
Taylor<N> Composed(const Taylor<N>& f, const Function& of) {
  const auto chain = [](const auto& g, const auto& x, size_t k) {
    if (k == 0) return g[0];
    if (k == 1) return g[1] * x[1];
    if (k == 2) return g[2] * Square(x[1]) + g[1] * x[2];
    return g[3] * (x[1] * Square(x[1])) + Interval(3.0) * (g[2] * (x[1] * x[2])) + g[1] * x[3];
  };
  Taylor<N> composed;
  composed.h = f.h;
  const std::array<Interval, 4> at = of(f.at[0]), over = of(f.over[0]);
  for (size_t k = 0; k < N; ++k) composed.at[k] = chain(at, f.at, k);
  composed.over[N] = chain(over, f.over, N);
  return composed.Enclose();
}

/// 1/f.
template <int N>
Taylor<N> Inverse(const Taylor<N>& f) {
  if (!(f.over[0].lo > 0.0 || f.over[0].hi < 0.0)) throw NotDefined();
  return Composed(f, [](const Interval& x) -> std::array<Interval, 4> {
    const Interval y = Interval(1.0) / x, yy = Square(y);
    return {y, -yy, Interval(2.0) * (y * yy), Interval(-6.0) * Square(yy)};
  });
}
/// √f.
template <int N>
Taylor<N> Sqrt(const Taylor<N>& f) {
  if (!(f.over[0].lo > 0.0)) throw NotDefined();
  return Composed(f, [](const Interval& x) -> std::array<Interval, 4> {
    const Interval y = Sqrt(x), slope = Interval(0.5) / y, second = slope / x;
    return {y, slope, Interval(-0.5) * second, Interval(0.75) * (second / x)};
  });
}
/// Sine and cosine.
template <int N>
std::array<Taylor<N>, 2> SinCosOf(const Taylor<N>& f) {
  return {Composed(f,
                   [](const Interval& x) -> std::array<Interval, 4> {
                     const auto [s, c] = SinCosOf(x);
                     return {s, c, -s, -c};
                   }),
          Composed(f, [](const Interval& x) -> std::array<Interval, 4> {
            const auto [s, c] = SinCosOf(x);
            return {c, -s, -c, s};
          })};
}

using Curve = Taylor<3>;  ///< of the walk: its second derivatives are Lipschitz
/// An angle by its sine and cosine, which are of one.
struct Turn {
  Curve sin = 0.0;  ///< with cos² + sin² = 1
  Curve cos = 1.0;  ///< of the angle

  Turn Back() const { return {-sin, cos}; }  ///< by the opposite angle
  /// The angle [rad], in (−π, π] at m but for rounding: φ̇ = c ṡ − s ċ, and so on.
  Curve Angle() const {
    const double about = Atan2(sin.at[0].Middle(), cos.at[0].Middle());
    const auto [s, c] = SinCosOf(Interval(about));
    const Interval across = sin.at[0] * c - cos.at[0] * s, along = cos.at[0] * c + sin.at[0] * s;
    if (!(along.lo > 0.0)) throw NotDefined();
    Curve angle;
    angle.h = std::max(sin.h, cos.h);
    // Of an angle below a quarter of a turn, which lies between 0 and its tangent.
    angle.at[0] = Interval(about) + Hull(0.0, across / along);
    angle.at[1] = cos.at[0] * sin.at[1] - sin.at[0] * cos.at[1];
    angle.at[2] = cos.at[0] * sin.at[2] - sin.at[0] * cos.at[2];
    angle.over[3] = cos.over[0] * sin.over[3] - sin.over[0] * cos.over[3] +
                    cos.over[1] * sin.over[2] - sin.over[1] * cos.over[2];
    return angle.Enclose();
  }
  /// v turned about a unit axis.
  VectorIn<Curve> About(const Eigen::Vector3d& axis, const VectorIn<Curve>& v) const {
    const VectorIn<Curve> across = Cross(axis, v);
    const Curve along = Dot(axis, v) * (Curve(1.0) - cos);
    VectorIn<Curve> turned;
    for (size_t i = 0; i < 3; ++i) {
      turned[i] = v[i] * cos + across[i] * sin + axis[static_cast<Eigen::Index>(i)] * along;
    }
    return turned;
  }
};

}  // namespace halfstep::checker
