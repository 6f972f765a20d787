"""Draws a robot from a table of numbers: its URDF and convex bodies, beside the table.

The tables are the scripts draw_*.py. A body is the convex hull of a few chamfered rectangles. Right
limbs are drawn, left ones mirrored in y. Inertias are those of the bodies filled evenly with the
link's mass; links without a body are taken as balls of water. At the zero posture all frames are
parallel, x forward, y left, z up.

Needs Python 3 only. Drawn again from the same table, the files are the same byte for byte.
"""

import dataclasses
import itertools
import math
import os

HERE = os.path.dirname(os.path.abspath(__file__))
WATER = 1000.0  # kg/m^3
AXES = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}


@dataclasses.dataclass
class Table:
    """The numbers of a robot.

    A row of a limb is (axis, translation [m], limits, mass [kg], CoM [m], body or None): the axis
    "x", "y" or "z", with a "-" before it when it points the other way; the translation from the
    parent's frame; the limits (lower [deg], upper [deg], speed [rad/s]), and the effort [N m] where
    it is known. Rows of limbs with two sides are the right side's.
    """

    name: str  # of the robot, its URDF and the folder of its bodies
    title: str  # what bodies call it
    comment: str  # second to last line of the URDF's comment
    bodies: dict  # body -> sections
    waist: tuple  # link, mass, CoM, body
    middle: list  # (limb, link that it hangs on, rows)
    sides: list  # (limb, link that it hangs on, rows)
    names: object  # (side "R", "L" or "", limb, number of the row) -> (link, joint)
    # Whether a left joint turns about the axis of the right one (1) or about its opposite (-1).
    left_axes: dict = dataclasses.field(default_factory=lambda: {"x": 1, "y": 1, "z": 1})
    extents: dict = dataclasses.field(default_factory=dict)  # body -> (min, max) that it must fill


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


def one_sided(normal, origin, points):
    """Heights of the points over the plane, or None when some are above and some below."""
    heights, above, below = [], False, False
    for p in points:
        height = dot(normal, sub(p, origin))
        above, below = above or height > 1e-9, below or height < -1e-9
        if above and below:
            return None
        heights.append(height)
    return heights


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
        heights = one_sided(normal, points[i], points)
        if heights is None:
            continue
        if max(heights) > 1e-9:
            normal = tuple(-n for n in normal)
            heights = [-h for h in heights]
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


def shape(sections, extents=None):
    """Vertices and faces of the hull of sections (z, x0, x1, y0, y1, chamfer): rectangles with cut
    corners, stacked along z. With extents (min, max) given, it must fill them exactly."""
    vertices, faces = hull([p for s in sections for p in section(*s)])
    low, high = (tuple(pick(v[axis] for v in vertices) for axis in range(3)) for pick in (min, max))
    assert extents in (None, (low, high)), (low, high)
    assert 16 <= len(vertices) <= 56, len(vertices)
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


class Drawing:
    """Gathers the URDF text, and writes bodies on the way."""

    def __init__(self, table, folder):
        self.table, self.folder = table, folder
        self.links, self.joints, self.shapes = [], [], {}

    def body(self, name, mesh, side):
        table = self.table
        if name not in self.shapes:
            self.shapes[name] = shape(table.bodies[name], table.extents.get(name))
        vertices, faces = self.shapes[name]
        if side < 0:
            vertices, faces = mirrored(vertices, faces)
        with open(os.path.join(self.folder, table.name, mesh + ".obj"), "w") as out:
            out.write(f"# {mesh}: convex body of {table.title} drawn by draw_{table.name}.py [m]\n")
            out.writelines(f"v {numbers(v)}\n" for v in vertices)
            out.writelines(f"f {t[0] + 1} {t[1] + 1} {t[2] + 1}\n" for t in triangles(faces))
        return vertices, faces

    def link(self, name, mass, com, body=None, mesh=None, side=1):
        inertia = ball_inertia(mass)
        shape = ""
        if body:
            inertia = solid_inertia(*self.body(body, mesh, side), mass)
            package = self.table.name + "_bodies"
            geometry = (f'<geometry><mesh filename="package://{package}/{mesh}.obj"/>'
                        "</geometry>")
            shape = (f"    <visual>{geometry}</visual>\n"
                     f"    <collision>{geometry}</collision>\n")
        names = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        moments = " ".join(f'{n}="{number(round(i, 8))}"'
                           for n, i in zip(names, inertia))
        self.links.append(
            f'  <link name="{name}">\n    <inertial>\n      <origin xyz="{numbers(com)}"/>\n'
            f'      <mass value="{number(mass)}"/>\n      <inertia {moments}/>\n'
            f"    </inertial>\n{shape}  </link>\n")

    def joint(self, name, axis, parent, child, xyz, limits):
        low, high, speed, effort = limits
        self.joints.append(
            f'  <joint name="{name}" type="revolute">\n'
            f'    <parent link="{parent}"/>\n    <child link="{child}"/>\n'
            f'    <origin xyz="{numbers(xyz)}"/>\n    <axis xyz="{numbers(axis)}"/>\n'
            f'    <limit lower="{math.radians(low):.15g}" upper="{math.radians(high):.15g}" '
            f'velocity="{speed:.6g}" effort="{number(effort)}"/>\n  </joint>\n')

    def limb(self, side, limb, parent, rows):
        mirror = -1 if side == "L" else 1
        suffix = {"R": "_right", "L": "_left", "": ""}[side]
        for n, (axis, xyz, (low, high, speed, *effort), mass, com, body) in enumerate(rows):
            same_way = 1 if mirror > 0 else self.table.left_axes[axis[-1]]
            sign = same_way * (-1 if axis[0] == "-" else 1)
            # A mirror in y turns rotations about x and z round.
            if same_way * (mirror if axis[-1] != "y" else 1) < 0:
                low, high = -high, -low
            link, joint = self.table.names(side, limb, n)
            self.link(link, mass, flip_y(com, mirror), body, body and body + suffix, mirror)
            self.joint(joint, [sign * a for a in AXES[axis[-1]]], parent, link, flip_y(xyz, mirror),
                       (low, high, speed, *(effort or [0])))
            parent = link


def draw(table, folder=HERE):
    """Writes NAME.urdf and NAME/*.obj into a folder."""
    os.makedirs(os.path.join(folder, table.name), exist_ok=True)
    drawing = Drawing(table, folder)
    link, mass, com, body = table.waist
    drawing.link(link, mass, com, body, body)
    for limb, parent, rows in table.middle:
        drawing.limb("", limb, parent, rows)
    for side in "RL":
        for limb, parent, rows in table.sides:
            drawing.limb(side, limb, parent, rows)
    with open(os.path.join(folder, table.name + ".urdf"), "w") as out:
        out.write('<?xml version="1.0"?>\n'
                  f"<!-- {table.title}. Written by draw_{table.name}.py: change it there.\n"
                  f"     {table.comment} -->\n"
                  f'<robot name="{table.name}">\n')
        out.writelines(drawing.links)
        out.writelines(drawing.joints)
        out.write("</robot>\n")
