#!/usr/bin/env python3
"""Draws HRP-2: writes hrp2.urdf and the convex bodies hrp2/*.obj beside this file.

Dimensions, masses and limits are the published numbers of the robot. The bodies are our own: each
is the convex hull of a few chamfered rectangles, and fills the published extents of its link's hull
exactly. Right limbs are drawn, left ones mirrored in y. Inertias are those of the bodies filled
evenly with the link's mass; links without a body are taken as balls of water.

Needs Python 3 only. Run again after changing a number; the output is the same byte for byte.
"""

import itertools
import math
import os

HERE = os.path.dirname(os.path.abspath(__file__))
WATER = 1000.0  # kg/m^3

# Body: extents (min, max) [m] in its joint frame, then sections
# (z, x0, x1, y0, y1, chamfer): rectangles with cut corners, stacked along z.
# Of the waist the lower sides and the lower front are cut, of the thigh the top on the outside: the
# published extents fix how far each reaches, and there the legs swing. Without the cuts the two
# would run into each other in postures that HRP-2 walks in. As drawn they are 48 mm apart when
# standing, and at least 6 mm at hip yaws of -30 to 30, rolls of -30 to 20 and pitches of -80 to 40
# degrees; a thigh lifted higher meets the waist, and is watched.
BODIES = {
    "waist": ((-0.173, -0.164, 0.065), (0.123, 0.164, 0.330), [
        (0.065, -0.100, 0.060, -0.060, 0.060, 0.030),
        (0.150, -0.173, 0.123, -0.164, 0.164, 0.040),
        (0.270, -0.173, 0.123, -0.164, 0.164, 0.040),
        (0.330, -0.120, 0.080, -0.120, 0.120, 0.030)]),
    "chest": ((-0.223, -0.195, -0.030), (0.131, 0.195, 0.289), [
        (-0.030, -0.110, 0.080, -0.110, 0.110, 0.030),
        (0.060, -0.223, 0.120, -0.165, 0.165, 0.040),
        (0.170, -0.223, 0.131, -0.195, 0.195, 0.050),
        (0.240, -0.200, 0.115, -0.195, 0.195, 0.050),
        (0.289, -0.150, 0.060, -0.130, 0.130, 0.030)]),
    "head1": ((-0.173, -0.104, 0.003), (0.128, 0.104, 0.210), [
        (0.003, -0.080, 0.070, -0.060, 0.060, 0.020),
        (0.060, -0.150, 0.120, -0.104, 0.104, 0.035),
        (0.130, -0.173, 0.128, -0.104, 0.104, 0.040),
        (0.185, -0.140, 0.095, -0.085, 0.085, 0.035),
        (0.210, -0.090, 0.050, -0.050, 0.050, 0.020)]),
    "arm1": ((-0.064, -0.056, -0.042), (0.055, 0.037, 0.048), [
        (-0.042, -0.035, 0.030, -0.035, 0.018, 0.010),
        (-0.010, -0.064, 0.055, -0.056, 0.037, 0.022),
        (0.020, -0.064, 0.055, -0.056, 0.037, 0.022),
        (0.048, -0.038, 0.032, -0.036, 0.020, 0.010)]),
    "arm2": ((-0.051, -0.060, -0.290), (0.040, 0.044, -0.040), [
        (-0.290, -0.030, 0.028, -0.042, 0.030, 0.012),
        (-0.230, -0.046, 0.037, -0.058, 0.042, 0.018),
        (-0.100, -0.051, 0.040, -0.060, 0.044, 0.020),
        (-0.040, -0.034, 0.026, -0.040, 0.028, 0.012)]),
    "arm3": ((-0.038, -0.060, -0.155), (0.039, 0.039, 0.039), [
        (-0.155, -0.028, 0.028, -0.036, 0.026, 0.012),
        (-0.060, -0.036, 0.036, -0.050, 0.035, 0.015),
        (0.005, -0.038, 0.039, -0.060, 0.039, 0.016),
        (0.039, -0.022, 0.022, -0.040, 0.024, 0.008)]),
    "arm5": ((-0.046, -0.069, -0.205), (0.046, 0.062, 0.027), [
        (-0.205, -0.024, 0.024, -0.036, 0.034, 0.010),
        (-0.130, -0.044, 0.044, -0.066, 0.060, 0.020),
        (-0.080, -0.046, 0.046, -0.069, 0.062, 0.022),
        (0.000, -0.036, 0.036, -0.042, 0.038, 0.016),
        (0.027, -0.020, 0.020, -0.024, 0.022, 0.008)]),
    "leg0": ((-0.064, -0.037, -0.037), (0.047, 0.037, 0.102), [
        (-0.037, -0.034, 0.026, -0.020, 0.020, 0.008),
        (0.000, -0.056, 0.043, -0.037, 0.037, 0.014),
        (0.050, -0.064, 0.047, -0.037, 0.037, 0.016),
        (0.102, -0.046, 0.036, -0.028, 0.028, 0.012)]),
    "leg1": ((-0.031, -0.035, -0.034), (0.028, 0.034, 0.034), [
        (-0.034, -0.018, 0.016, -0.020, 0.020, 0.008),
        (-0.012, -0.031, 0.028, -0.035, 0.034, 0.014),
        (0.012, -0.031, 0.028, -0.035, 0.034, 0.014),
        (0.034, -0.018, 0.016, -0.020, 0.020, 0.008)]),
    "leg2": ((-0.050, -0.136, -0.337), (0.057, 0.001, 0.040), [
        (-0.337, -0.026, 0.030, -0.105, -0.022, 0.012),
        (-0.290, -0.045, 0.052, -0.124, -0.006, 0.020),
        (-0.110, -0.050, 0.057, -0.136, 0.001, 0.026),
        (-0.030, -0.046, 0.050, -0.126, -0.008, 0.028),
        (0.040, -0.020, 0.022, -0.085, -0.045, 0.012)]),
    "leg3": ((-0.077, -0.126, -0.336), (0.106, 0.015, 0.104), [
        (-0.336, -0.030, 0.034, -0.078, 0.000, 0.012),
        (-0.290, -0.050, 0.052, -0.092, 0.010, 0.018),
        (-0.130, -0.077, 0.086, -0.118, 0.015, 0.028),
        (0.020, -0.060, 0.106, -0.126, 0.008, 0.026),
        (0.070, -0.030, 0.100, -0.120, 0.000, 0.022),
        (0.104, 0.020, 0.080, -0.096, -0.026, 0.012)]),
    "leg4": ((-0.031, -0.025, -0.021), (0.046, 0.033, 0.022), [
        (-0.021, -0.018, 0.030, -0.014, 0.020, 0.006),
        (-0.008, -0.031, 0.046, -0.025, 0.033, 0.012),
        (0.008, -0.031, 0.046, -0.025, 0.033, 0.012),
        (0.022, -0.018, 0.030, -0.014, 0.020, 0.006)]),
    "leg5": ((-0.106, -0.079, -0.105), (0.136, 0.058, 0.035), [
        (-0.105, -0.106, 0.136, -0.079, 0.058, 0.0),  # the sole: flat, full extents
        (-0.080, -0.106, 0.136, -0.079, 0.058, 0.0),
        (-0.062, -0.096, 0.112, -0.070, 0.050, 0.010),
        (0.000, -0.050, 0.060, -0.056, 0.038, 0.014),
        (0.035, -0.028, 0.034, -0.036, 0.022, 0.008)]),
}

# Joint: axis, parent link, translation [m], limits [deg], max speed [rad/s], mass [kg], CoM [m],
# body. Limits and speeds of the upper body are not published with these numbers: it is rigid while
# walking, and the values here only let its standing posture through.
FREE = (-180, 180, 5.0)
LEG = [
    ("z", (0, -0.060, 0), (-45, 30, 3.54108), 1.23548, (-0.01070, 0.00461, 0.06745), "leg0"),
    ("x", (0, 0, 0), (-35, 20, 3.80952), 0.80553, (-0.00040, -0.02613, -0.00292), "leg1"),
    ("y", (0, 0, 0), (-125, 42, 4.42233), 2.07632, (0.00346, -0.07794, -0.15168), "leg2"),
    ("y", (0, 0, -0.300), (-2, 150, 3.98010), 1.74762, (0.01799, -0.05792, -0.13839), "leg3"),
    ("y", (0, -0.035, -0.300), (-75, 42, 5.07937), 0.65375, (0.00827, -0.00133, -0.00242), "leg4"),
    ("x", (0, 0, 0), (-20, 35, 9.14286), 1.63877, (-0.00066, -0.00469, -0.06538), "leg5"),
]
ARM = [
    ("y", (0.008, -0.250, 0.181), FREE, 0.81008, (-0.00989, 0.04645, -0.00015), None),
    ("x", (0, 0, 0), FREE, 1.03448, (-0.01056, -0.01204, -0.00948), "arm1"),
    ("z", (0, 0, 0), FREE, 1.59929, (-0.00543, -0.00480, -0.16687), "arm2"),
    ("y", (0, 0, -0.250), FREE, 0.77725, (-0.00001, -0.01617, -0.06270), "arm3"),
    ("z", (0, 0, -0.250), FREE, 0.55467, (-0.00345, -0.00362, 0.04150), None),
    ("y", (0, 0, 0), FREE, 0.92511, (0.00219, -0.00367, -0.08312), "arm5"),
    ("x", (0, 0.020, -0.095), FREE, 0.22136, (0.00956, -0.00325, -0.04151), None),
]
CHEST = [
    ("z", (0.032, 0, 0.3507), FREE, 0.78637, (-0.01580, 0.00530, -0.02520), None),
    ("y", (0, 0, 0), FREE, 11.52457, (-0.02905, 0.00716, 0.12102), "chest"),
]
HEAD = [
    ("z", (-0.007, 0, 0.2973), FREE, 0.37477, (-0.00088, 0.00426, -0.00803), None),
    ("y", (0, 0, 0), FREE, 0.99335, (0.01299, 0.00009, 0.07876), "head1"),
]
WAIST_MASS, WAIST_COM = 15.02949, (-0.01435, 0, 0.22308)


def sub(a, b):
    return tuple(p - q for p, q in zip(a, b))


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def section(z, x0, x1, y0, y1, c):
    """Corners of a rectangle cut by c."""
    if c == 0:
        return [(x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)]
    return [(x0 + c, y0, z), (x1 - c, y0, z), (x1, y0 + c, z), (x1, y1 - c, z),
            (x1 - c, y1, z), (x0 + c, y1, z), (x0, y1 - c, z), (x0, y0 + c, z)]


def hull(points):
    """Extreme points and outward polygons (indices) of the convex hull: tries every plane."""
    points = sorted(set(points))
    flat = 1e-12
    polygons = {}
    for i, j, k in itertools.combinations(range(len(points)), 3):
        normal = cross(sub(points[j], points[i]), sub(points[k], points[i]))
        length = math.sqrt(dot(normal, normal))
        if length < flat:
            continue
        normal = tuple(n / length for n in normal)
        heights = [dot(normal, sub(p, points[i])) for p in points]
        if max(heights) > 1e-9:
            normal = tuple(-n for n in normal)
            heights = [-h for h in heights]
        if max(heights) > 1e-9:
            continue
        face = tuple(n for n, h in enumerate(heights) if h > -1e-9)
        if face not in polygons:
            polygons[face] = rim(points, face, normal)
    used = sorted({v for polygon in polygons.values() for v in polygon})
    index = {v: n for n, v in enumerate(used)}
    faces = sorted([index[v] for v in polygon] for polygon in polygons.values())
    return [points[v] for v in used], faces


def rim(points, face, normal):
    """The corners of a flat set of points, counter-clockwise about the normal."""
    rest = list(face)
    corner = min(rest, key=lambda v: points[v])
    order = []
    while not order or corner != order[0]:
        order.append(corner)
        following = next(v for v in rest if v != corner)
        for v in rest:
            if v in (corner, following):
                continue
            a, b = sub(points[following], points[corner]), sub(points[v], points[corner])
            turn = dot(normal, cross(a, b))
            if turn < -1e-12 or (abs(turn) <= 1e-12 and dot(b, b) > dot(a, a)):
                following = v
        corner = following
    return order


def draw(name):
    low, high, sections = BODIES[name]
    vertices, faces = hull([p for s in sections for p in section(*s)])
    for axis in range(3):
        values = [v[axis] for v in vertices]
        assert (min(values), max(values)) == (low[axis], high[axis]), (name, axis)
    assert 16 <= len(vertices) <= 56, (name, len(vertices))
    return vertices, faces


def triangles(faces):
    return [(f[0], f[n], f[n + 1]) for f in faces for n in range(1, len(f) - 1)]


def solid_inertia(vertices, faces, mass):
    """Inertia (xx, xy, xz, yy, yz, zz) of the filled body about its own centroid."""
    volume, first, second = 0.0, [0.0] * 3, [[0.0] * 3 for _ in range(3)]
    for t in triangles(faces):
        a, b, c = (vertices[v] for v in t)
        v6 = dot(a, cross(b, c))
        volume += v6 / 6
        total = tuple(p + q + r for p, q, r in zip(a, b, c))
        for m in range(3):
            first[m] += v6 / 24 * total[m]
            for n in range(3):
                second[m][n] += v6 / 120 * (a[m] * a[n] + b[m] * b[n] + c[m] * c[n]
                                            + total[m] * total[n])
    centre = [f / volume for f in first]
    s = [[mass * (second[m][n] / volume - centre[m] * centre[n]) for n in range(3)]
         for m in range(3)]
    return (s[1][1] + s[2][2], -s[0][1], -s[0][2], s[0][0] + s[2][2], -s[1][2], s[0][0] + s[1][1])


def ball_inertia(mass):
    radius = (3 * mass / (4 * math.pi * WATER)) ** (1 / 3)
    i = 0.4 * mass * radius * radius
    return (i, 0, 0, i, 0, i)


def mirrored(vertices, faces):
    return [(x, -y, z) for x, y, z in vertices], [f[::-1] for f in faces]


def number(value):
    return f"{value:.9g}" if value else "0"


def numbers(values):
    return " ".join(number(v) for v in values)


def flip_y(v, side):
    return (v[0], v[1] * side, v[2])


class Robot:
    """Gathers the URDF text, and writes bodies on the way."""

    def __init__(self):
        self.links, self.joints = [], []

    def body(self, name, mesh, side):
        vertices, faces = draw(name)
        if side < 0:
            vertices, faces = mirrored(vertices, faces)
        with open(os.path.join(HERE, "hrp2", mesh + ".obj"), "w") as out:
            out.write(f"# {mesh}: convex body of HRP-2 drawn by draw_hrp2.py [m]\n")
            out.writelines(f"v {numbers(v)}\n" for v in vertices)
            out.writelines(f"f {t[0] + 1} {t[1] + 1} {t[2] + 1}\n" for t in triangles(faces))
        return vertices, faces

    def link(self, name, mass, com, body=None, mesh=None, side=1):
        inertia = ball_inertia(mass)
        shape = ""
        if body:
            inertia = solid_inertia(*self.body(body, mesh, side), mass)
            geometry = (f'<geometry><mesh filename="package://hrp2_bodies/{mesh}.obj"/>'
                        "</geometry>")
            shape = (f"    <visual>{geometry}</visual>\n"
                     f"    <collision>{geometry}</collision>\n")
        names = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        moments = " ".join(f'{n}="{number(round(i, 8))}"' for n, i in zip(names, inertia))
        self.links.append(
            f'  <link name="{name}">\n    <inertial>\n      <origin xyz="{numbers(com)}"/>\n'
            f'      <mass value="{number(mass)}"/>\n      <inertia {moments}/>\n'
            f"    </inertial>\n{shape}  </link>\n")

    def joint(self, name, axis, parent, child, xyz, limits):
        low, high, speed = limits
        axis = {"x": "1 0 0", "y": "0 1 0", "z": "0 0 1"}[axis]
        self.joints.append(
            f'  <joint name="{name}" type="revolute">\n'
            f'    <parent link="{parent}"/>\n    <child link="{child}"/>\n'
            f'    <origin xyz="{numbers(xyz)}"/>\n    <axis xyz="{axis}"/>\n'
            f'    <limit lower="{math.radians(low):.15g}" upper="{math.radians(high):.15g}" '
            f'velocity="{speed:.6g}" effort="0"/>\n  </joint>\n')

    def chain(self, prefix, parent, rows, side=1, suffix=""):
        for n, (axis, xyz, (low, high, speed), mass, com, body) in enumerate(rows):
            if side < 0 and axis != "y":
                low, high = -high, -low
            link = f"{prefix}_LINK{n}"
            self.link(link, mass, flip_y(com, side), body, body and body + suffix, side)
            self.joint(f"{prefix}_JOINT{n}", axis, parent, link, flip_y(xyz, side),
                       (low, high, speed))
            parent = link


def main():
    os.makedirs(os.path.join(HERE, "hrp2"), exist_ok=True)
    robot = Robot()
    robot.link("WAIST", WAIST_MASS, WAIST_COM, "waist", "waist")
    robot.chain("CHEST", "WAIST", CHEST)
    robot.chain("HEAD", "CHEST_LINK1", HEAD)
    for name, side, suffix in (("R", 1, "_right"), ("L", -1, "_left")):
        robot.chain(name + "LEG", "WAIST", LEG, side, suffix)
        robot.chain(name + "ARM", "CHEST_LINK1", ARM, side, suffix)
    with open(os.path.join(HERE, "hrp2.urdf"), "w") as out:
        out.write('<?xml version="1.0"?>\n'
                  "<!-- HRP-2. Written by draw_hrp2.py: change it there.\n"
                  "     Frames are parallel at the zero posture, x forward, y left, z up; WAIST is\n"
                  "     midway between the hips. Inertias are estimated from the bodies. Limits of\n"
                  "     chest, head and arms and all efforts (0) are not published: not for use. -->\n"
                  '<robot name="hrp2">\n')
        out.writelines(robot.links)
        out.writelines(robot.joints)
        out.write("</robot>\n")


if __name__ == "__main__":
    main()
