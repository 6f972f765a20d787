"""Numbers of outward-rounded arithmetic for second_checker.py: intervals, functions of time, profiles.

Trusted of numpy: that sums, products, quotients and roots of doubles are rounded to nearest (IEEE 754), and
minima, comparisons and indices."""
import numpy as np


def down(x):
    """Less than x by at least half a unit in its last place; no result is subnormal."""
    return x - (np.abs(x) * 2.0**-52 + 1e-120)


def up(x):
    return x + (np.abs(x) * 2.0**-52 + 1e-120)


class I:
    """All real numbers from lo to hi, element by element; NaN where nothing is known."""

    __array_ufunc__ = None

    def __init__(self, lo, hi=None):
        self.lo = np.asarray(lo, dtype=float)
        self.hi = self.lo if hi is None else np.asarray(hi, dtype=float)

    def __getitem__(self, k):
        return I(self.lo[k], self.hi[k])

    def __neg__(self):
        return I(-self.hi, -self.lo)

    def __add__(self, b):
        b = interval(b)
        if isinstance(b, T):
            return b + self
        return I(down(self.lo + b.lo), up(self.hi + b.hi))

    def __sub__(self, b):
        return self + (-interval(b))

    def __rsub__(self, b):
        return interval(b) - self

    def __mul__(self, b):
        if isinstance(b, T):
            return b * self
        b = interval(b)
        p, q, r, s = self.lo * b.lo, self.lo * b.hi, self.hi * b.lo, self.hi * b.hi
        return I(down(np.minimum(np.minimum(p, q), np.minimum(r, s))),
                 up(np.maximum(np.maximum(p, q), np.maximum(r, s))))

    def __truediv__(self, b):
        b = interval(b)
        known = np.where((b.lo > 0) | (b.hi < 0), 1.0, np.nan)
        return self * I(down(1.0 / b.hi * known), up(1.0 / b.lo * known))

    def __rtruediv__(self, b):
        return interval(b) / self

    __radd__, __rmul__ = __add__, __mul__

    def square(self):
        least = np.maximum(0.0, np.maximum(self.lo, -self.hi))
        return I(np.maximum(0.0, down(least * least)), up(self.size()**2))

    def root(self):
        """Of what of it is not negative."""
        return I(np.maximum(0.0, down(np.sqrt(np.maximum(0.0, self.lo)))), up(np.sqrt(np.maximum(0.0, self.hi))))

    def swap(self):
        return I(self.lo.swapaxes(0, 1), self.hi.swapaxes(0, 1))

    def size(self):
        return np.maximum(np.abs(self.lo), np.abs(self.hi))

    def positive(self):
        """Known where it is."""
        return I(np.where(self.lo > 0, self.lo, np.nan), self.hi)

    def middle(self):
        return 0.5 * self.lo + 0.5 * self.hi


def interval(x):
    return x if isinstance(x, (I, T)) else I(x)


def stack(items):
    items = [interval(x) for x in items]
    return I(np.stack(np.broadcast_arrays(*[x.lo for x in items])), np.stack(np.broadcast_arrays(*[x.hi for x in items])))


HALF_PI = I(1.5707963267948966, 1.5707963267948968)


def sine_cosine(x):
    """By their series at the middle, less a multiple of a quarter turn; neither changes faster than x."""
    m = x.middle()
    r = np.maximum(up(x.hi - m), up(m - x.lo))
    k = np.rint(m * 0.6366197723675814)
    y = I(m) - HALF_PI * k
    square, s, c = y.square(), I(np.ones_like(m)), I(np.ones_like(m))
    for n in range(22, 1, -2):
        c = 1.0 - square * c / float(n * (n - 1))
        s = 1.0 - square * s / float(n * (n + 1))
    s, error = y * s, I(-1e-22, 1e-22)  # |y| < 1: what is left out is below 1/24!
    s, c, turn = s + error, c + error, np.mod(k, 4)
    usable = np.where(y.size() < 1.0, 1.0, np.nan)

    def pick(a, b):  # by the quarter of the turn
        of = [a, b, -a, -b]
        lo = sum(np.where(turn == i, f.lo, 0.0) for i, f in enumerate(of)) * usable
        hi = sum(np.where(turn == i, f.hi, 0.0) for i, f in enumerate(of)) * usable
        return I(np.maximum(-1.0, down(lo - r)), np.minimum(1.0, up(hi + r)))

    return pick(s, c), pick(c, -s)


class T:
    """A function of time on [m - h, m + h]: its value and derivatives below order N at m, the same at every t,
    and its Nth derivative at every t; N is 3 or 1. Axes of v: order, components, intervals of time."""

    __array_ufunc__ = None
    LEIBNIZ = {3: ([0, 0, 1, 0, 1, 2, 3, 4, 5, 6], [0, 1, 0, 2, 1, 0, 6, 5, 4, 3]), 1: ([0, 1, 2], [0, 2, 1])}

    def __init__(self, v, h):
        self.v, self.h, self.n = v, h, v.lo.shape[0] // 2

    @staticmethod
    def of(at, top, h):
        """Lower orders at every t, by Taylor's theorem."""
        over = []
        for k in range(len(at)):
            off = top.size()
            for i in range(len(at) - 1, k, -1):
                off = at[i].size() + h / (i + 1 - k) * off
            off = off * h * (1.0 + 2.0**-44) + 1e-120
            over.append(I(down(at[k].lo - off), up(at[k].hi + off)))
        return T(stack(list(at) + over + [top]), h)

    @staticmethod
    def constant(x, h):
        x = x + I(np.zeros_like(h))
        zero = I(np.zeros_like(x.lo))
        return T(stack([x, zero, zero, x, zero, zero, zero]), h)

    def at(self, k=0):
        return self.v[k]

    def over(self, k=0):
        return self.v[self.n + k]

    def __getitem__(self, k):
        return T(self.v[(slice(None), ) + (k if isinstance(k, tuple) else (k, ))], self.h)

    def cut(self, columns):
        return T(self.v[..., columns], self.h[columns])

    def __neg__(self):
        return T(-self.v, self.h)

    def __add__(self, b):
        if isinstance(b, T):
            at = [self.at(k) + b.at(k) for k in range(self.n)]
            return T.of(at, self.over(self.n) + b.over(self.n), self.h)
        b = interval(b)
        rows = [self.v[k] + b if k in (0, self.n) else self.v[k] for k in range(2 * self.n + 1)]
        return T(stack(rows), self.h)

    def __sub__(self, b):
        return self + (-b)

    def __rsub__(self, b):
        return -self + b

    def __mul__(self, b):
        if not isinstance(b, T):
            return T(self.v * b, self.h)
        i, k = T.LEIBNIZ[self.n]
        p = self.v[i] * b.v[k]
        if self.n == 1:
            return T.of([p[0]], p[1] + p[2], self.h)
        return T.of([p[0], p[1] + p[2], p[3] + 2.0 * p[4] + p[5]], p[6] + p[9] + 3.0 * (p[7] + p[8]), self.h)

    __radd__, __rmul__ = __add__, __mul__

    def chain(self, outer):
        """outer(x): the outer function and its first N derivatives on x."""
        g = outer(stack([self.at(), self.over()]))
        x = [self.v[[k, self.n + k]] if k < self.n else self.v[[self.n + k, self.n + k]] for k in range(self.n + 1)]
        f = [g[0], g[1] * x[1]]
        if self.n == 3:
            f += [g[2] * x[1].square() + g[1] * x[2],
                  g[3] * (x[1] * x[1].square()) + 3.0 * (g[2] * (x[1] * x[2])) + g[1] * x[3]]
        return T.of([f[k][0] for k in range(self.n)], f[self.n][1], self.h)

    def set(self, k, columns, f):
        """A component of some intervals."""
        self.v.lo[:, k, columns], self.v.hi[:, k, columns] = f.v.lo, f.v.hi

    def inverse(self, positive=False):
        def outer(x):
            y = 1.0 / (x.positive() if positive else x)
            return [y, -y.square(), 2.0 * (y * y.square()), -6.0 * y.square().square()]
        return self.chain(outer)

    def root(self):
        def outer(x):
            y = x.positive().root()
            return [y, 0.5 / y, -0.25 / (y * x), 0.375 / (y * x.square())]
        return self.chain(outer)

    def sine_cosine(self):
        s, c = sine_cosine(stack([self.at(), self.over()]))
        return self.chain(lambda x: [s, c, -s, -c]), self.chain(lambda x: [c, -s, -c, s])

    def lower(self, k):
        """The derivative of order k as a function with N = 1."""
        return T(self.v[[k, 3 + k, 4 + k]], self.h)


def column(x):
    """Constants, as a factor of components."""
    return x[..., None] if isinstance(x, I) else np.asarray(x, dtype=float)[..., None]


def total(x, axis=0):
    k = (slice(None), ) * axis
    return x[k + (0, )] + x[k + (1, )] + x[k + (2, )]


def dot(a, b):
    return total(a * b)


def cross(a, b):
    return a[[1, 2, 0]] * b[[2, 0, 1]] - a[[2, 0, 1]] * b[[1, 2, 0]]


def turned(R, x):
    return total(R * x[None], 1)


def back(R):
    return T(I(R.v.lo.swapaxes(1, 2), R.v.hi.swapaxes(1, 2)), R.h)


def product(R, S):
    return total(R[:, :, None] * S[None], 1)


def axis_turn(u, s, c):
    """R = c 1 + s [u] + (1 - c) u u'."""
    uu = I(u)[:, None] * I(u)[None, :]
    skew = np.array([[0, -u[2], u[1]], [u[2], 0, -u[0]], [-u[1], u[0], 0]])
    c, s = c[None, None], s[None, None]
    return c * column(np.eye(3)) + s * column(skew) + (1.0 - c) * column(uu)


def many(items, axis=1):
    """One function of all components."""
    return T(I(np.stack([x.v.lo for x in items], axis), np.stack([x.v.hi for x in items], axis)), items[0].h)


# Profiles are lists of pieces (begin, end, centre, width, powers of x = (sigma - centre) / width, tail).


def horner(powers, x, orders):
    """Value and k!^-1 times the derivatives."""
    f = [I(np.zeros_like(x.lo)) for _ in range(orders)]
    for p in reversed(powers):
        for i in range(orders - 1, 0, -1):
            f[i] = f[i] * x + f[i - 1]
        f[0] = f[0] * x + p
    return f


def evaluate(pieces, sigma, orders=4):
    """Value and derivatives in sigma, of every piece that an interval meets."""
    lo, hi = (np.full((orders, ) + sigma.lo.shape, x) for x in (np.inf, -np.inf))
    for begin, end, center, width, powers, tail in pieces:
        part = I(np.maximum(sigma.lo, begin.lo), np.minimum(sigma.hi, end.hi))
        on = part.lo <= part.hi
        if on.any():
            f, scale = horner(powers, (part[on] - center) / width, orders), I(1.0)
            for k in range(orders):
                f[k] = (f[k] + I(-tail, tail) if k < 2 else f[k]) * scale
                lo[k, on], hi[k, on] = np.minimum(lo[k, on], f[k].lo), np.maximum(hi[k, on], f[k].hi)
                scale = scale * float(k + 1) / width
    return I(lo, hi)


def profile(pieces):
    """0 before and 1 after."""
    return [(I(-1e9), pieces[0][0], I(0.0), I(1.0), [I(0.0)], 0.0), *pieces,
            (pieces[-1][1], I(1e9), I(0.0), I(1.0), [I(1.0)], 0.0)]


def scaled(scale, powers):
    return [scale * I(p) if not isinstance(p, I) else scale * p for p in powers]


def added(a, b):
    n = max(len(a), len(b))
    return [p + q for p, q in zip(a + [I(0.0)] * (n - len(a)), b + [I(0.0)] * (n - len(b)))]


def series(square, p, c0, c1):
    """Of c'' = square (c - p) on |x| <= 1; from where p ends and square <= k k / 4 every second term is at most a
    quarter, so that what is left out of c and c' is below (k + 1) times the last two terms."""
    c = [c0, c1]
    for k in range(402):
        tail = float((k + 1) * (c[k].size() + c[k + 1].size()))
        if k >= len(p) and square.hi <= k * k / 4.0 and tail < 1e-24:
            return c, tail
        c.append(square * (c[k] - p[k] if k < len(p) else c[k]) / float((k + 2) * (k + 1)))
    raise ValueError("a half-step is too long")


def angle(s, c):
    """Within half a turn of 0 at m, by the guess and an angle that lies between 0 and its tangent."""
    guess = np.arctan2(s.at().middle(), c.at().middle())
    s0, c0 = sine_cosine(I(guess))
    tangent = (s.at() * c0 - c.at() * s0) / (c.at() * c0 + s.at() * s0).positive()
    at = I(guess) + I(np.minimum(0.0, tangent.lo), np.maximum(0.0, tangent.hi))
    top = c.over() * s.over(3) - s.over() * c.over(3) + c.over(1) * s.over(2) - s.over(1) * c.over(2)
    return T.of([at, *(c.at() * s.at(k) - s.at() * c.at(k) for k in (1, 2))], top, s.h)


def under(limit, x):
    """At least limit - |x|, which is not below 0 where |x| is not above the limit."""
    return np.where(limit >= x.size(), np.maximum(0.0, down(limit - x.size())), down(limit - x.size()))
