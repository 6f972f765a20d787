#!/usr/bin/env python3
"""Checks a proof that travels: second_checker.py PROOF.json

Written from experiments/proof.md; shares nothing with halfstep. Exit status 0: proved, 1: not, 2: refused.
Trusted beside what that page says: this file, outward.py and what it trusts, Python's reader of JSON."""
import json
import math
import sys

import numpy as np
from outward import (I, T, added, angle, axis_turn, back, column, cross, dot, down, evaluate, horner, many, product,
                     profile, scaled, series, sine_cosine, stack, total, turned, under, up)

SIDES, UP = ("left", "right"), np.array([0.0, 0.0, 1.0])
ON_FLOOR, FINEST, MISSED, MOST = 1e-8, 1e-9, 1e-9, 1_000_000  # m; s; units of margins; intervals
S = [0.0, 0.0, 0.0, 10.0, -15.0, 6.0]


def need(holds, words):
    if not holds:
        raise ValueError(words)


def ramped_step(begin, end, r):
    width, share = end - begin, 15.0 - 14.0 * I(r)
    a, v, ramp = 16.0 * I(r) / share, 15.0 / share, r * width
    return profile([(begin, begin + ramp, begin, 2.0 * ramp, scaled(a, S), 0.0),
                    (begin + ramp, end - ramp, 0.5 * (begin + end), width, [I(0.5), v], 0.0),
                    (end - ramp, end, end, -2.0 * ramp, [I(1.0)] + scaled(-a, S)[1:], 0.0)])


def pendulum(theta_squared, shift, ramp):
    """CoM and ZMP from rest to rest."""
    at_end = lambda c, tail, x: [f + I(-tail, tail) for f in horner(c, I(x), 2)]
    first, delta, part = 0.5 - 0.5 * I(shift), 0.5 * I(shift), min(ramp, 0.5)
    mixed = 2.0 * I(ramp) - 1.0 if ramp > 0.5 else I(0.0)
    rise = added(scaled(mixed, [0, 0, 0, -8, 12, -6, 1]), scaled(1.0 - mixed, [0, 0, 0, -10, 15, -6]))
    fall = added(scaled(mixed, [-1, 0, 3, 0, -3, 0, 1]), scaled(1.0 - mixed, [-1, 0, 0, 10, -15, 6]))
    flat = [(1.0 - 2.0 * I(part), [I(-1.0)])] if part < 0.5 else []
    com, zmp, begin, value, rate = [], [], I(0.0), I(0.0), I(0.0)  # for a = 1
    for share, p in [(I(part), rise)] + flat + [(I(part), fall)]:
        width = share * first
        c, tail = series(theta_squared * width.square(), p, value, rate * width)
        com.append((begin, begin + width, begin, width, c, tail))
        zmp.append((begin, begin + width, begin, width, p, 0.0))
        value, slope = at_end(c, tail, 1.0)
        rate, begin = slope / width, begin + width
    shifting, square = scaled(I(1.0), [0.5, 0.9375, 0.0, -0.625, 0.0, 0.1875]), theta_squared * delta.square()
    forced, free = series(square, shifting, I(0.5), I(0.0)), series(square, [], I(0.0), I(1.0))
    (p, p1), (q, q1), slope = at_end(*forced, -1.0), at_end(*free, -1.0), rate * delta
    determinant = slope * q - value * q1
    a, gamma = (p1 * q - p * q1) / determinant, (value * p1 - slope * p) / determinant
    com, zmp = ([(*piece[:4], scaled(a, piece[4]), float((a * piece[5]).size())) for piece in of] for of in (com, zmp))
    tail = float((forced[1] + I(float(gamma.size())) * free[1]).hi)
    com.append((first, I(0.5), I(0.5), delta, added(forced[0], scaled(gamma, free[0])), tail))
    zmp.append((first, I(0.5), I(0.5), delta, shifting, 0.0))
    for pieces in (com, zmp):  # 1 - f(1 - sigma)
        pieces += [(1.0 - e, 1.0 - b, 1.0 - m, -w, [1.0 - c[0]] + scaled(I(-1.0), c[1:]), tail)
                   for b, e, m, w, c, tail in reversed(pieces)]
    return profile(com), profile(zmp)


def point(place, ahead, aside):
    """Of a sole at (x, y, yaw)."""
    s, c = sine_cosine(place[2])
    return [place[0] + c * ahead - s * aside, place[1] + s * ahead + c * aside]


class Motion:
    """Half-steps, flights, and rests between half-steps: CoM x, y, ZMP x, y, waist's yaw, x, y, z, yaw of soles."""

    def __init__(self, motion, com_height):
        rows, feet = motion["half_steps"], motion["footsteps"]
        need(rows and len(rows) == 2 * (len(feet) - 2), "half-steps are not two for each footstep")
        self.rests, self.steps, self.flights, soles = [], [], [], [None, None]
        step = lambda begin, end: profile([(begin, end, begin, end - begin, scaled(I(1.0), S), 0.0)])
        omega_squared = I(motion["gravity_m_s2"]) / (I(com_height) - I(motion["crouch_m"]))
        place = lambda foot: [I(foot["x_m"]), I(foot["y_m"]), I(foot["yaw_rad"])]
        for foot in feet[:2]:
            soles[SIDES.index(foot["foot"])] = place(foot)

        def rest(com=None, yaw=None, z=(I(0.0), I(0.0))):
            mean = [0.5 * (p + q) for p, q in zip(*soles)]
            com, yaw = com or mean[:2], yaw or mean[2]
            self.rests.append(stack([*com, *com, yaw, *soles[0][:2], z[0], soles[0][2], *soles[1][:2], z[1], soles[1][2]]))

        rest()
        for i, row in enumerate(rows):
            up_way, support = i % 2 == 0, SIDES.index(row["support"])
            swing, foot, ramp, delay, shift = 1 - support, feet[i // 2 + 2], *(
                row[k] for k in ("foot_ramp", "foot_delay", "zmp_shift"))
            same = ("support", "support_point_m", "height_scale", "via_lateral_m", "via_along_m")
            need(row["kind"] == ("up" if up_way else "down") and foot["foot"] == SIDES[swing]
                 and all(row[k] == rows[i ^ 1][k] for k in same) and 0 < row["duration_s"] <= 60 and 0 < shift <= 0.5
                 and 0.1 <= row["zmp_bump_ramp"] <= 1 and 0.1 <= ramp <= 0.5 and 0 < row["lift_share"] <= 1
                 and 0 <= delay < 0.45 * (1 - shift), f"half-step {i + 1} is none that there can be")
            length, start = I(row["duration_s"]), I(0.0)
            if "starts_s" in motion:
                start = I(motion["starts_s"][i])
            elif i > 0:
                start = self.steps[-1]["end"] - I(motion["overlaps_s"][i - 1])
            first, square = 0.5 - 0.5 * I(shift), omega_squared * length.square()
            second, lift = 1.0 - first, I(row["lift_share"]) * first
            com, zmp = pendulum(square, shift, row["zmp_bump_ramp"])
            self.steps.append({
                "start": start, "T": length, "end": start + length, "shift": I(shift) * length, "swing": swing,
                "com": com, "zmp": zmp, "square": square, "yaw": step(I(0.0), I(1.0)),
                "way": ramped_step(second + delay, I(1.0), ramp) if up_way else ramped_step(I(0.0), first - delay, ramp),
                "height": step(second, second + lift) if up_way else step(first - lift, first)})
            before, this = self.steps[max(0, i - 1)], self.steps[i]
            need(all(before[k].lo <= this[k].lo + 1e-9 for k in ("start", "end")),
                 f"half-step {i + 1} begins or ends before the one before it")
            if up_way:
                on, aside, z = soles[support], 1.0 if swing == 0 else -1.0, [I(0.0), I(0.0)]
                soles[swing] = [*point(on, row["via_along_m"], aside * I(row["via_lateral_m"])), on[2]]
                z[swing] = I(row["height_scale"]) * I(foot["via_height_m"])
                rest(point(on, 0.0, aside * I(row["support_point_m"])), on[2], z)
                continue
            x, y, yaw = foot["moved"]
            soles[swing] = [*point(place(foot), x, y), I(foot["yaw_rad"]) + yaw]
            rest()
            time = lambda of, sigma: of["start"] + sigma * of["T"]
            self.flights.append({
                "side": swing, "begin": float(time(before, before["height"][1][0]).lo),
                "end": float(time(this, this["height"][-1][0]).hi),
                "from": float(min(time(before, before["way"][1][0]).lo, start.lo)),
                "to": float(max(time(this, this["way"][-1][0]).hi, before["end"].hi))})
        self.end = float(self.steps[-1]["end"].hi)

    def on(self, lo, hi):
        """All numbers on intervals of time. What has ended has brought everything to a rest."""
        m = 0.5 * lo + 0.5 * hi
        h = np.maximum(up(hi - m), up(m - lo)) * (hi > lo)
        ended = np.array([[s["end"].hi < t for s in self.steps] + [False] for t in lo])
        first, rests = np.argmin(ended, 1), stack(self.rests)
        f = T.constant(rests[first].swap(), h)
        for i, s in enumerate(self.steps):
            on = np.nonzero((first <= i) & (s["start"].lo <= hi))[0]
            if not on.size:
                continue
            sigma, rate = (stack([I(m[on]), I(lo[on], hi[on])]) - s["start"]) / s["T"], 1.0 / s["T"]

            curve = lambda g: T.of([g[0][0], g[1][0] * rate, g[2][0] * rate.square()],
                                   g[3][1] * (rate * rate.square()), h[on])
            c, p = evaluate(s["com"], sigma, 2), evaluate(s["zmp"], sigma)
            com = curve([c[0], c[1], s["square"] * (c[0] - p[0]), s["square"] * (c[1] - p[1])])
            zmp, way, yaw, height = curve(p), *(curve(evaluate(s[k], sigma)) for k in ("way", "yaw", "height"))
            numbers = [0, 1, 2, 3, 4] + [5 + 4 * s["swing"] + k for k in range(4)]
            for k, shape in zip(numbers, [com, com, zmp, zmp, yaw, way, way, height, way]):
                f.set(k, on, f[k].cut(on) + shape * (self.rests[i + 1][k] - self.rests[i][k]))
        return f


class Leg:
    """Inverse kinematics in closed form."""

    def __init__(self, leg):
        self.w = w = [np.array(joint["axis"]) for joint in leg["joints"]]
        self.hip, knee, self.ankle = (np.array(leg[k]) for k in ("hip_m", "knee_m", "ankle_m"))
        self.points = [self.hip] * 3 + [knee] + [self.ankle] * 2
        axis, self.h, self.a = I(w[3]), I(self.hip) - I(knee), I(self.ankle) - I(knee)
        h, a = (x - dot(axis, x) * axis for x in (self.h, self.a))
        self.levers, along = (dot(h, h) * dot(a, a)).root(), dot(axis, self.a - self.h)
        self.squares = along.square() + dot(h, h) + dot(a, a)
        self.cos0, self.sin0 = dot(h, a) / self.levers, dot(axis, cross(h, a)) / self.levers
        self.sole_R, self.sole_p = np.array(leg["sole"]["R"]), np.array(leg["sole"]["p_m"])
        def rotate(u, angle, x):
            return x * math.cos(angle) + np.cross(u, x) * math.sin(angle) + u * (u @ x) * (1 - math.cos(angle))
        q, sign = leg["standing_rad"], lambda x: 1.0 if x >= 0 else -1.0  # of its branch
        self.knee_sign = sign(math.sin(q[3]) * self.cos0.middle() + math.cos(q[3]) * self.sin0.middle())
        seen = rotate(w[4], -q[4], rotate(w[3], -q[3], self.hip - knee) + knee - self.ankle)
        self.ankle_sign, self.hip_sign = sign(np.cross(w[5], w[4]) @ seen), sign(np.cross(w[0], w[1]) @ rotate(w[1], q[1], w[2]))

    def pose(self, X_B, X_S):
        """Stretched leg less hip-ankle distance, joint angles, and how far links are displaced from q = 0."""
        (R_B, p_B), w = X_B, self.w
        R_C = total(X_S[0][:, :, None] * column(self.sole_R.T[None]), 1)
        p_C = X_S[1] - total(R_C * column(self.sole_p[None]), 1)
        constant = lambda x: T.constant(I(column(x)) if not isinstance(x, I) else column(x), R_B.h)
        at = lambda R, x: total(R * column(x[None]), 1)
        between = at(R_C, self.ankle) + p_C - at(R_B, self.hip) - p_B
        square = dot(between, between)
        reach = (self.squares + 2.0 * self.levers).root() - square.root()

        def about(u, turn, v):
            s, c, u = *turn, column(u)
            return v * c[None] + cross(u, v) * s[None] + dot(u, v)[None] * (1.0 - c)[None] * u

        def from_to(u, p, t, across):  # the turn about u that brings p to t, by what of both is across
            scale, u = across.inverse(), column(u)
            return dot(u, cross(p, t)) * scale, (dot(p, t) - dot(u, p) * dot(u, t)) * scale

        def between_turns(u, v, p, t, square, sign):  # R(v) p where R(u) R(v) p = t
            d, n = dot(I(u), I(v)), cross(I(u), I(v))
            ut, vp, scale = dot(column(u), t), dot(column(v), p), 1.0 / (1.0 - d.square())
            alpha, beta = (ut - vp * d) * scale, (vp - ut * d) * scale
            rest = square - alpha * alpha - beta * beta - alpha * beta * (2.0 * d)
            gamma = (rest * scale).root() * sign
            return alpha[None] * column(u) + beta[None] * column(v) + gamma[None] * column(n)

        reverse, away = lambda turn: (-turn[0], turn[1]), lambda of, along: of - along * along
        cos_psi = (self.squares - square) * (0.5 / self.levers)
        sin_psi = ((1.0 - cos_psi) * (1.0 + cos_psi)).root() * self.knee_sign
        turns = [None] * 6
        turns[3] = (sin_psi * self.cos0 - cos_psi * self.sin0, cos_psi * self.cos0 + sin_psi * self.sin0)
        p = about(w[3], reverse(turns[3]), constant(self.h)) - column(self.a)
        t = turned(back(R_C), -between)
        c = between_turns(w[5], w[4], p, t, square, self.ankle_sign)
        turns[4] = reverse(from_to(w[4], p, c, away(square, dot(column(w[4]), p))))
        turns[5] = reverse(from_to(w[5], c, t, away(square, dot(column(w[5]), t))))
        last, one = constant(w[2]), constant(np.array(1.0))
        for i in (3, 4, 5):
            last = about(w[i], reverse(turns[i]), last)
        last = turned(back(R_B), turned(R_C, last))
        c = between_turns(w[0], w[1], constant(w[2]), last, one, self.hip_sign)
        fixed = away(one, constant(dot(I(w[1]), I(w[2]))))
        turns[1] = from_to(w[1], constant(w[2]), c, fixed)
        turns[0] = from_to(w[0], c, last, away(one, dot(column(w[0]), last)))
        second = turned(back(R_C), turned(R_B, about(w[0], turns[0], constant(w[1]))))
        for i in (5, 4, 3):
            second = about(w[i], turns[i], second)
        turns[2] = from_to(w[2], second, constant(w[1]), fixed)
        moved, (R, p) = [None] * 6, X_B
        for i in (0, 1, 2, 5, 4, 3):  # the last three hang on the sole
            if i == 5:
                moved[5] = R, p = R_C, p_C
                continue
            turn, u, center = (turns[i], w[i], self.hip) if i < 3 else (reverse(turns[i + 1]), w[i + 1], self.ankle)
            Q = axis_turn(u, *turn)
            moved[i] = R, p = product(R, Q), turned(R, column(center) - at(Q, center)) + p
        return reach, [angle(*turn) for turn in turns], moved


def farthest(n, body):
    """An upper bound of n x over a body, for directions in columns."""
    along = dot(n[:, :, None], I(body["V"].T[:, None, :]))
    of_disc = (n[0].square() + n[1].square()).root() * body["disc_radius_m"]
    return (I(np.max(along.hi, axis=1)) + of_disc + dot(n, n).root() * body["ball_radius_m"]).hi


def edges_around(rest, sides, size):
    """A closed way around the corners of soles that stand: normals to the left, and their products with corners."""
    corners = []
    for side in sides:
        place = [rest[5 + 4 * side + k] for k in (0, 1, 3)]
        corners += [point(place, I(x) * size[0], I(y) * size[1]) for x, y in ((.5, .5), (-.5, .5), (-.5, -.5), (.5, -.5))]
    at = np.array([[float(v.middle()) for v in corner] for corner in corners])
    order, hull, edges = list(np.argsort(at @ [0.7390851332151607, 0.6736120291832148])), [], []
    for chain in (order, order[::-1]):
        begin = len(hull)
        for i in chain:
            while len(hull) >= begin + 2 and np.linalg.det([at[hull[-1]] - at[hull[-2]], at[i] - at[hull[-1]]]) <= 1e-12:
                hull.pop()
            hull.append(i)
        hull.pop()
    for a, b in zip(hull, hull[1:] + hull[:1]):
        (ax, ay), (bx, by) = corners[a], corners[b]
        length = ((bx - ax).square() + (by - ay).square()).root()
        n = (ay - by) / length, (bx - ax) / length
        edges.append((n, n[0] * ax + n[1] * ay))
    return edges


class State:
    """The walk on intervals of time, in each of which the same soles stand. Margins are lower bounds."""

    def __init__(self, proof, lo, hi):
        self.proof, self.m = proof, 0.5 * lo + 0.5 * hi
        motion, flights, rests = proof.motion, proof.motion.flights, proof.rests
        self.flight = np.searchsorted([f["end"] for f in flights], self.m)
        of_flight = lambda k, last: np.array([f[k] for f in flights] + [last])[self.flight]
        self.flies, self.side = of_flight("begin", np.inf) <= self.m, of_flight("side", 0)
        self.moves = self.flies & (of_flight("from", 0.0) <= self.m) & (self.m <= of_flight("to", 0.0))
        self.rest, self.x = 2 * self.flight + self.flies, motion.on(lo, hi)
        x, self.h = self.x, self.x.h
        for side in range(2):  # a foot that stands has one place
            on = np.nonzero(~(self.flies & (self.side == side)))[0]
            for k in range(5 + 4 * side, 9 + 4 * side):
                x.set(k, on, T.constant(rests[self.rest[on], k], self.h[on]))
        s, c = x[4].sine_cosine()
        height = T.constant((I(proof.robot["waist_height_m"]) - I(proof.crouch)) + I(np.zeros_like(self.h)), self.h)
        X_B = axis_turn(UP, s, c), many([x[0] - c * proof.robot["com_ahead_m"], x[1] - s * proof.robot["com_ahead_m"], height])
        self.reach, self.q, self.moved = [], [], [X_B]
        for side, leg in enumerate(proof.legs):
            k = 5 + 4 * side
            reach, q, moved = leg.pose(X_B, (axis_turn(UP, *x[k + 3].sine_cosine()), x[[k, k + 1, k + 2]]))
            self.reach, self.q, self.moved = self.reach + [reach], self.q + q, self.moved + moved
        frames = self.moved + [self.place(o) for o in proof.obstacles]
        R, p = many([f[0] for f in frames], 3), many([f[1] for f in frames], 2)
        self.p = total(R * column(proof.link_p[None]), 1) + p
        self.R = total(R[:, :, None] * column(proof.link_R[None]), 1)
        of = proof.frame_of
        self.center = total(self.R[:, :, of] * column(proof.centers[None]), 1).over() + self.p[:, of].over()

    def place(self, obstacle):
        """An obstacle goes straight from waypoint to waypoint, and turns steadily about the vertical."""
        R, p = np.array(obstacle["pose"]["R"]), np.array(obstacle["pose"]["p_m"])
        way = [(0.0, p, 0.0)] + [(w["t_s"], np.array(w["position_m"]), w["yaw_rad"]) for w in obstacle["waypoints"]]
        k = np.searchsorted([w[0] for w in way], self.m, side="right") - 1
        t, x, yaw = (np.array([w[i] for w in way + [(way[-1][0] + 1.0, *way[-1][1:])]]) for i in range(3))
        rate, zero = 1.0 / (I(t[k + 1]) - I(t[k])), I(np.zeros_like(self.m))
        share = T.of([(I(self.m) - I(t[k])) * rate, rate, zero], zero, self.h)
        between = lambda a: share[None] * (I(a[k + 1].T) - I(a[k].T)) + I(a[k].T)
        Q = axis_turn(UP, *between(yaw[:, None])[0].sine_cosine())
        return total(Q[:, :, None] * column(R[None]), 1), between(x)

    def uncertain(self, obstacle):
        """How far points of it may be from there."""
        horizon = np.inf if obstacle["horizon_s"] is None else obstacle["horizon_s"]
        since = np.minimum(up(up(np.abs(self.m - obstacle["measured_at_s"])) + self.h), horizon)
        return up(obstacle["error_m"] + up(obstacle["speed_m_s"] * since))

    def pairs(self, pairs, needed, undecided):
        """How far bodies a and b are apart, along directions in b's frame that are told; where none is told."""
        proof, bodies = self.proof, self.proof.bodies
        a, b = np.array([pair["a"] for pair in pairs]), np.array([pair["b"] for pair in pairs])
        d, missing = self.center[:, a] - self.center[:, b], np.zeros(needed.shape, bool)
        bound = (dot(d, d).root() - (I(proof.radii[a]) + I(proof.radii[b]))[:, None]).lo
        which, when = np.nonzero(undecided & ~(bound >= needed))
        if which.size:
            fa, fb, h = proof.frame_of[a[which]], proof.frame_of[b[which]], self.h[when]
            take = lambda x, frame: T(x.v[..., frame, when], h)
            to_b = back(take(self.R, fb))
            R = product(to_b, take(self.R, fa)).over()
            p = turned(to_b, take(self.p, fa) - take(self.p, fb)).over()
        for k in np.unique(which):
            items = np.nonzero(which == k)[0]
            at = np.searchsorted(pairs[k]["times"], self.m[when[items]], side="right") - 1
            missing[k, when[items[at < 0]]] = True
            items, at = items[at >= 0], at[at >= 0]
            if items.size:
                n = I(pairs[k]["directions"][at].T)
                seen = total(R[..., items] * n[:, None])
                gap = dot(n, p[:, items]) - I(farthest(-seen, bodies[a[k]])) - I(farthest(n, bodies[b[k]]))
                bound[k, when[items]] = np.fmax(bound[k, when[items]], (I(gap.lo) / dot(n, n).root()).lo)
        return bound, missing

    def ground(self, body):
        frame = self.proof.frame_of[body]
        if frame in (6, 12):  # a foot's reaches no lower than its sole
            z = self.x[7 if frame == 6 else 11].over().lo
            return np.where(z >= -ON_FLOOR, np.inf, z)
        return (self.p.over()[2, frame] - I(farthest(-self.R.over()[2, :, frame], self.proof.bodies[body]))).lo

    def swing(self, family, limit):
        bound, f = np.full(len(self.m), np.inf), np.nonzero(self.moves if family == "floor" else self.flies)[0]
        sole = T(self.x.v[:, 5 + 4 * self.side[f] + np.arange(4)[:, None], f], self.h[f])
        if family == "floor":
            bound[f] = sole[2].over().lo
        elif family == "foot_speed":
            bound[f] = under(limit, dot(sole.over(1), sole.over(1)).root())
        elif family == "foot_yaw_rate":
            bound[f] = under(limit, sole[3].over(1))
        else:  # v max(1, z / 1 cm) is at least either
            z, rate = (T(sole[2].v[rows], self.h[f]) for rows in ([0, 1, 3, 4, 5], [1, 2, 4, 5, 6]))
            bound[f] = np.maximum((rate + limit).over().lo, (rate + z * (I(limit) / 0.01)).over().lo)
        return bound

    def by_support(self, of):
        bound = np.full(len(self.m), np.nan)
        for rest in np.unique(self.rest):
            on = np.nonzero(self.rest == rest)[0]
            bound[on] = of(self.proof.supports[rest], on)
        return bound

    def inside(self, p):
        left = lambda edge, on: (p[0].cut(on) * edge[0][0] + p[1].cut(on) * edge[0][1] - edge[1]).over().lo
        return self.by_support(lambda edges, on: np.min([left(edge, on) for edge in edges], 0))

    def dynamics(self):
        """What moves the waist and the links, and the floor's part of it; moments about `corner`."""
        proof, R = self.proof, self.R[:, :, :13]
        center = total(R * column(proof.com[None]), 1) + self.p[:, :13]
        force = center.lower(2)
        self.force = many([force[0], force[1], force[2] + proof.gravity]) * column(proof.mass)
        self.corner = np.vstack([self.x.v[0][2:4].middle(), np.zeros_like(self.h)])
        spread = total(R.lower(0)[:, :, None] * column(proof.second)[None], 1)  # R Sigma
        M = lambda k, l: dot(spread[k], R.lower(2)[l])
        turning = many([M(1, 2) - M(2, 1), M(2, 0) - M(0, 2), M(0, 1) - M(1, 0)])
        self.moment = cross(center.lower(0) - I(self.corner[:, None]), self.force) + turning
        self.floor = F, N = [sum((w[:, k] for k in range(1, 13)), w[:, 0]) for w in (self.force, self.moment)]
        self.inverse = F[2].inverse(positive=True)
        self.from_corner = -N[1] * self.inverse, N[0] * self.inverse
        self.zmp = [z + I(at) for z, at in zip(self.from_corner, self.corner)]

    def friction(self, limit):
        """Two points p +- rho u, u along an edge, each with half of the push."""
        (F, N), p = self.floor, self.from_corner
        yaw, square = N[2] - (p[0] * F[1] - p[1] * F[0]), F[0] * F[0] + F[1] * F[1]
        side, smooth = square.over().root(), square.root().over()
        side = I(np.fmax(side.lo, smooth.lo), np.fmin(side.hi, smooth.hi))

        def of(edges, on):
            left = [self.zmp[0].cut(on) * n[0] + self.zmp[1].cut(on) * n[1] - at for n, at in edges]
            part = np.array([[float((n[0] * u[1] - n[1] * u[0]).size()) for u, _ in edges] for n, _ in edges])
            room = np.min(np.array([x.at().middle() for x in left])[:, None] / np.maximum(part, 1e-300)[:, :, None], 0)
            best = np.argmax(np.nan_to_num(room), 0)
            needs = [yaw.cut(on) * x.inverse(positive=True) * share[best] for x, share in zip(left, part)]
            needs = [(side[on] + I(x.over().size())) * self.inverse.over()[on] for x in needs]
            return np.min([(limit - x).lo for x in needs], 0)
        return self.by_support(of)

    def torque(self, number, limit):
        side, joint, k = number // 6, number % 6, number + 1
        leg, (R, p) = self.proof.legs[side], (x.lower(0) for x in self.moved[k])
        e = total(R * column(leg.w[joint][None]), 1)
        r = total(R * column(leg.points[joint][None]), 1) + p - I(self.corner)
        about = lambda f, n: dot(e, n - cross(r, f))
        links = sum((about(self.force[:, i], self.moment[:, i]) for i in range(k + 1, 7 + 6 * side)),
                    about(self.force[:, k], self.moment[:, k]))
        floor, away, centers = about(*self.floor), [], []
        for s in range(2):
            x, y, yaw = (self.proof.rests[self.rest, 5 + 4 * s + i] for i in (0, 1, 3))
            (sine, cosine), u, v = sine_cosine(yaw), self.zmp[0].over() - x, self.zmp[1].over() - y
            out = []
            for along, size in zip((cosine * u + sine * v, cosine * v - sine * u), self.proof.robot["sole_size_m"]):
                past, before = along - 0.5 * size, -along - 0.5 * size
                out.append(I(np.maximum(0.0, np.maximum(past.lo, before.lo)), np.maximum(0.0, np.maximum(past.hi, before.hi))))
            away.append((out[0].square() + out[1].square()).root())
            centers.append((x, y))
        share = away[0] / (away[0] + away[1]).positive()
        share = I(np.maximum(0.0, share.lo), np.minimum(1.0, share.hi))
        couple, d = share * (1.0 - share) * self.floor[0][2].over(), [q - p for p, q in zip(*centers)]
        turn = couple * (e[0].over() * d[1] - e[1].over() * d[0])
        carried = share * floor.over() + turn if side == 1 else (1.0 - share) * floor.over() - turn
        both, alone = links.over() - carried, (links - floor).over()
        aloft, other = self.flies & (self.side == side), self.flies & (self.side != side)
        choose = lambda k: np.select([aloft, other], [getattr(links.over(), k), getattr(alone, k)], getattr(both, k))
        return under(limit, I(choose("lo"), choose("hi")))


class Proof:
    def __init__(self, data):
        need(data.get("format") == "halfstep proof 1", "is no proof of this format")
        self.robot, scene, self.said, motion = data["robot"], data["scene"], data["statement"], data["motion"]
        self.obstacles, self.crouch, self.gravity = scene["obstacles"], motion["crouch_m"], motion["gravity_m_s2"]
        legs = [self.robot["legs"][side] for side in SIDES]
        joints = [joint for leg in legs for joint in leg["joints"]]
        frames = [joint["link"] for joint in joints]
        for frame in frames + [leg["sole"] for leg in legs] + [o["pose"] for o in self.obstacles]:
            R = np.array(frame["R"])
            need(R.shape == (3, 3) and np.linalg.norm(R @ R.T - np.eye(3)) < 1e-12 and np.linalg.det(R) > 0, "no rotation")
        need(all(abs(np.dot(j["axis"], j["axis"]) - 1.0) < 1e-12 for j in joints), "an axis is no unit vector")
        need(self.crouch < self.robot["com_height_m"] and [len(leg["joints"]) for leg in legs] == [6, 6], "no such robot")
        still = {"R": np.eye(3).tolist(), "p_m": [0.0, 0.0, 0.0]}
        frames = [still] + frames + [still] * len(self.obstacles)
        self.link_R = np.array([f["R"] for f in frames]).transpose(1, 2, 0)
        self.link_p = np.array([f["p_m"] for f in frames]).T
        own, self.bodies = self.robot["bodies"], self.robot["bodies"] + self.obstacles
        frame = lambda body: 0 if body["leg"] is None else 1 + 6 * SIDES.index(body["leg"]) + range(6)[body["link"]]
        self.frame_of = np.array([frame(b) for b in own] + [13 + k for k in range(len(self.obstacles))], dtype=int)
        for body in self.bodies:
            body["V"] = np.array(body["vertices_m"], dtype=float).reshape(-1, 3)
            away, disc, ball = I(body["V"].T) - I(column(body["center_m"])), body["disc_radius_m"], body["ball_radius_m"]
            beside = (away[0].square() + away[1].square()).root() + disc
            far = ((beside.square() + away[2].square()).root() + ball).hi
            need(disc >= 0 and ball >= 0 and np.all(far <= body["radius_m"]),
                 f"{body['name']} is not within its sphere")
        self.radii, self.centers = (np.array([b[k] for b in self.bodies]).T for k in ("radius_m", "center_m"))
        masses = [self.robot["masses"]["waist"]] + [m for side in SIDES for m in self.robot["masses"]["links"][side]]
        self.mass, self.com = (np.array([m[k] for m in masses]).T for k in ("mass_kg", "com_m"))
        J = I(np.array([m["inertia_kg_m2"] for m in masses]).transpose(1, 2, 0))
        self.second = 0.5 * (J[0, 0] + J[1, 1] + J[2, 2]) * column(np.eye(3)) - J
        self.motion, self.legs = Motion(motion, self.robot["com_height_m"]), [Leg(leg) for leg in legs]
        rests, self.rests, flights = self.motion.rests, stack(self.motion.rests), self.motion.flights
        self.supports = [edges_around(rest, [1 - flights[k // 2]["side"]] if k % 2 else (0, 1), self.robot["sole_size_m"])
                         for k, rest in enumerate(rests)]
        self.hints = {(h["family"], h["a"], h["b"]): h["from"] for h in data["hints"]["directions"]}
        self.times, self.areas, self.statements, self.found = data["hints"]["times_s"], scene["no_step_m"], [], []
        self.demands = {family["family"]: family["demanded"] for family in self.said["families"]}
        need(len(self.demands) == len(self.said["families"]), "a family is demanded twice")
        for times in [[0.0] + [w["t_s"] for w in obstacle["waypoints"]] for obstacle in self.obstacles]:
            need(all(t < later for t, later in zip(times, times[1:])), "times of waypoints do not increase")
        limits = {"floor": 0.0, "foot_speed": self.said["foot_speed_m_s"], "foot_yaw_rate": self.said["foot_yaw_rate_rad_s"],
                  "landing_speed": self.said["landing_speed_m_s"], "zmp": 0.0, "zmp_robot": 0.0, "friction": scene["friction"]}
        scale, k_own = I(self.said["joint_speed_scale"]), range(len(own))
        pairs = {"self_clearance": self.robot["watched_pairs"], "ground": [(k, k) for k in k_own],
                 "clearance": [(k, o) for o in range(len(self.obstacles)) for k in k_own]}
        for family, demanded in self.demands.items():
            need(family in (*limits, *pairs, *OF_JOINTS, "reach", "no_step", "double_support"), f"{family} is not known")
            add = lambda subject, **more: self.statements.append(dict(more, family=family, subject=subject, demanded=demanded))
            if limits.get(family) is not None:
                add("", limit=limits[family])
            for k, side in enumerate(SIDES if family == "reach" else []):
                add(side, a=k)
            for k, joint in enumerate(joints if family in OF_JOINTS else []):
                limit = joint[OF_JOINTS[family]]
                if limit is not None:
                    add(joint["name"], a=k, joint=joint, limit=(scale * limit).lo if family == "joint_speed" else limit)
            for a, b in pairs.get(family, []):
                other, told = b + len(own) if family == "clearance" else b, self.hints.get((family, a, b), [])
                need(a in k_own and 0 <= other < len(self.bodies), "a pair counts too far")
                add(f"{self.bodies[a]['name']} - {self.bodies[other]['name']}", a=a, b=other, obstacle=b,
                    times=np.array([n[0] for n in told]), directions=np.array([n[1:] for n in told]).reshape(-1, 3))

    def margins(self, state, family, of, undecided):
        """Lower bounds of statements (rows) on intervals (columns), and where a direction is missing."""
        if family in ("self_clearance", "clearance"):
            away = [state.uncertain(self.obstacles[s["obstacle"]]) if family == "clearance" else 0.0 * state.m for s in of]
            bound, missing = state.pairs(of, up(self.demands[family] + np.array(away)), undecided)
            return down(bound - np.array(away)), missing
        if family in ("zmp_robot", "friction", "torque") and not hasattr(state, "floor"):
            state.dynamics()
        q = lambda s: state.q[s["a"]].over
        look = {"zmp": lambda s: state.inside([state.x[2], state.x[3]]),
                "zmp_robot": lambda s: state.inside(state.zmp),
                "friction": lambda s: state.friction(s["limit"]),
                "torque": lambda s: state.torque(s["a"], s["limit"]),
                "reach": lambda s: state.reach[s["a"]].over().lo,
                "ground": lambda s: state.ground(s["a"]),
                "joint": lambda s: np.minimum(down(q(s)().lo - s["joint"]["lower_rad"]), down(s["limit"] - q(s)().hi)),
                "joint_speed": lambda s: under(s["limit"], q(s)(1)),
                "joint_acceleration": lambda s: under(s["limit"], q(s)(2))}
        look = look.get(family, lambda s: state.swing(family, s["limit"]))
        return np.array([look(s) for s in of]), np.zeros(undecided.shape, bool)

    def tell(self, family, subject, t, margin, missing=False):
        said = f"{family}{' ' if subject else ''}{subject} at {t:.6f} s: {margin:.6g}"
        self.found.append((float(t), ("hint missing: " if missing else "not proved: ") + said))

    def at_once(self):
        """What is known without looking at intervals."""
        flights = self.motion.flights
        for j, (f, g) in enumerate(zip(flights, flights[1:])):
            if not down(g["begin"] - f["end"]) > 0:
                self.tell("one foot in the air", f"steps {j + 1} and {j + 2}", f["end"], g["begin"] - f["end"])
        for i, s in enumerate(self.motion.steps if "double_support" in self.demands else []):
            if not s["shift"].lo >= self.demands["double_support"] - 1e-12:
                self.tell("double_support", f"half-step {i + 1}", s["start"].lo, float(s["shift"].lo))
        outline = [I(np.array(self.robot["sole_outline_m"])[:, k]) for k in range(2)]
        for i, (side, rest) in enumerate([(0, 0), (1, 0)] + [(f["side"], 2 * j + 2) for j, f in enumerate(flights)]):
            at = point([self.rests[rest, 5 + 4 * side + k] for k in (0, 1, 3)], *outline)
            for k, area in enumerate(self.areas if "no_step" in self.demands else []):
                (x, y), told = np.array(area).T, self.hints.get(("no_step", i, k))
                n = [I(v) for v in told[0][1:3]] if told else [I(0.0), I(0.0)]
                gap = I(np.min((n[0] * at[0] + n[1] * at[1]).lo)) - I(np.max((n[0] * x + n[1] * y).hi))
                gap = float((I(gap.lo) / (n[0].square() + n[1].square()).root().positive()).lo)
                if not (gap > 0 and gap >= self.demands["no_step"]):
                    self.tell("no_step", f"place {i}, area {k}", 0.0 if rest == 0 else flights[i - 2]["end"], gap, not told)

    def prove(self):
        """How many intervals of time were looked at."""
        self.at_once()
        end, flights = self.motion.end, self.motion.flights
        knots = {0.0, end, *self.times, *(f[k] for f in flights for k in ("begin", "end", "from", "to"))}
        knots |= {w["t_s"] for obstacle in self.obstacles for w in obstacle["waypoints"]}
        knots, statements = np.array(sorted(t for t in knots if 0.0 <= t <= end)), self.statements
        families = {f: [k for k, s in enumerate(statements) if s["family"] == f] for f in self.demands}
        demanded, alive = np.array([s["demanded"] for s in statements]), np.ones(len(statements), bool)
        work, looked = [(knots[:-1], knots[1:], np.ones((len(statements), len(knots) - 1), bool))], 0

        def margins(lo, hi, undecided):
            state, found, gone = State(self, lo, hi), np.zeros(undecided.shape), np.zeros(undecided.shape, bool)
            for family, rows in families.items():
                if rows and undecided[rows].any():
                    found[rows], gone[rows] = self.margins(state, family, [statements[k] for k in rows], undecided[rows])
            return found, gone, state.m

        while work:
            lo, hi, undecided = work.pop()
            if len(lo) > 256:
                work += [(lo[k:k + 256], hi[k:k + 256], undecided[:, k:k + 256]) for k in range(0, len(lo), 256)][::-1]
                continue
            undecided, looked = undecided & alive[:, None], looked + len(lo)
            bound, _, m = margins(lo, hi, undecided)
            undecided &= ~(bound >= demanded[:, None])
            on = undecided.any(0)
            if not on.any():
                continue
            lo, hi, m, undecided, bound = lo[on], hi[on], m[on], undecided[:, on], bound[:, on]
            at, missing, _ = margins(m, m, undecided)  # where halving does not help, nothing is proved
            helpless = (at < demanded[:, None] - MISSED) | (at - bound < MISSED) | (hi - lo < FINEST) | (looked > MOST)
            for row in np.nonzero((undecided & helpless).any(1))[0]:
                k = np.argmax(undecided[row] & helpless[row])
                self.tell(statements[row]["family"], statements[row]["subject"], m[k], at[row, k], missing[row, k])
                alive[row] = False
            work.append((np.stack([lo, m], 1).ravel(), np.stack([m, hi], 1).ravel(), np.repeat(undecided, 2, 1)))
        return looked


OF_JOINTS = {"joint": "upper_rad", "joint_speed": "max_speed_rad_s", "joint_acceleration": "max_acceleration_rad_s2",
             "torque": "max_torque_n_m"}


def main(path):
    try:
        with open(path, encoding="utf-8") as file, np.errstate(all="ignore"):
            proof = Proof(json.load(file, parse_constant=lambda text: float("refused")))
            looked = proof.prove()
    except (KeyError, ValueError, TypeError, IndexError, OSError, AttributeError) as error:
        print(f"{path}: is no proof: {error!r}", file=sys.stderr)
        return 2
    proved = f"proved: {len(proof.statements)} statements of {len(proof.demands)} families"
    print(*([line for _, line in sorted(proof.found)] or [proved]), f"{looked} intervals of time",
          *(f"not looked at: {line}" for line in proof.said["not_covered"]), sep="\n")
    return 1 if proof.found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
