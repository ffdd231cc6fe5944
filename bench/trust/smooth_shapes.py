"""Free-form parts: bodies that bulge from a centre and tubes along a curve. Millimetres.

Each function returns (vertices, triangles). No two are alike.
"""
import math

import numpy as np
from scipy.spatial import ConvexHull

from symmetry import sphere_directions

PI = math.pi
AXES = np.eye(3)


def bulging(radius, count=3000):
    """A body seen from its centre: radius(directions [n, 3]) is the distance of its surface."""
    directions = sphere_directions(count)
    triangles = ConvexHull(directions).simplices.copy()
    a, b, c = (directions[triangles[:, k]] for k in range(3))
    inward = np.einsum("ij,ij->i", np.cross(b - a, c - a), a) < 0
    triangles[inward] = triangles[inward][:, ::-1]
    return radius(directions)[:, None] * directions, triangles


def bump(directions, towards, height, width_rad):
    """A Gaussian of the angle to a direction."""
    towards = np.asarray(towards, float) / np.linalg.norm(towards)
    angle = np.arccos(np.clip(directions @ towards, -1, 1))
    return height * np.exp(-0.5 * (angle / width_rad) ** 2)


def superellipsoid(directions, half_axes, power):
    """Radius of |x/a|^p + |y/b|^p + |z/c|^p = 1."""
    return (np.abs(directions / half_axes) ** power).sum(1) ** (-1 / power)


def pebble():
    return bulging(lambda d: superellipsoid(d, (34, 25, 17), 2.3) +
                   bump(d, (1, 0.6, 0.4), 7, 0.5) - bump(d, (-0.4, 1, 0.5), 6, 0.45) +
                   bump(d, (-1, -0.5, -0.2), 5, 0.35))


def mouse_shell():
    vertices, triangles = bulging(lambda d: superellipsoid(d, (52, 29, 25), 2.6) +
                                  bump(d, (-0.7, 0.2, 0.9), 9, 0.5), 4000)
    vertices[:, 2] = np.maximum(vertices[:, 2], -8)  # the flat foot
    return vertices, triangles


def bath_duck():
    return bulging(lambda d: superellipsoid(d, (32, 24, 20), 2.0) +
                   bump(d, (0.75, 0, 1), 26, 0.38) + bump(d, (1, 0, 0.55), 14, 0.13) +
                   bump(d, (-1, 0, 0.45), 11, 0.25), 6000)


def pistol_grip():
    return bulging(lambda d: superellipsoid(d, (19, 15, 50), 2.5) +
                   bump(d, (1, 0, 0.9), 13, 0.35) - bump(d, (1, 0, 0.25), 5, 0.22) -
                   bump(d, (1, 0, -0.35), 4, 0.22) + bump(d, (-1, 0.2, -1.6), 10, 0.4))


def grip_ball():
    lobes = [(math.cos(2 * PI * k / 3), math.sin(2 * PI * k / 3), 0.1) for k in range(3)]
    return bulging(lambda d: 24 + sum(bump(d, lobe, 11, 0.42) for lobe in lobes) +
                   bump(d, (0, 0, -1), 14, 0.3), 4000)


def tube(points, radii, around=20, closed=False):
    """Circles of the given radii about a curve [n, 3], with round ends if it is open."""
    points, radii = np.asarray(points, float), np.asarray(radii, float)
    if not closed:
        points, radii = with_round_ends(points, radii)
    tangents = np.gradient(points, axis=0)
    if closed:
        tangents = np.roll(points, -1, 0) - np.roll(points, 1, 0)
    tangents /= np.linalg.norm(tangents, axis=1)[:, None]
    normals = carried_normals(tangents)
    angles = 2 * PI * np.arange(around) / around
    circle = (np.cos(angles)[None, :, None] * normals[:, None] +
              np.sin(angles)[None, :, None] * np.cross(tangents, normals)[:, None])
    vertices = (points[:, None] + radii[:, None, None] * circle).reshape(-1, 3)
    return vertices, tube_triangles(len(points), around, closed)


def with_round_ends(points, radii, steps=6):
    """Adds half a ball at both ends, as circles that shrink to nearly nothing."""
    def end(at, outwards, radius):
        outwards = outwards / np.linalg.norm(outwards)
        rises = np.sin(np.linspace(PI / 2, 0, steps, endpoint=False))
        return ([at + radius * s * outwards for s in rises],
                [radius * max(1e-3, math.sqrt(1 - s * s)) for s in rises])

    first, first_radii = end(points[0], points[0] - points[1], radii[0])
    last, last_radii = end(points[-1], points[-1] - points[-2], radii[-1])
    return (np.array([*first, *points, *last[::-1]]),
            np.array([*first_radii, *radii, *last_radii[::-1]]))


def carried_normals(tangents):
    """Normals that turn about the curve as little as possible."""
    start = AXES[np.abs(tangents[0]).argmin()]
    normals = [start - (start @ tangents[0]) * tangents[0]]
    for tangent in tangents[1:]:
        normals.append(normals[-1] - (normals[-1] @ tangent) * tangent)
    normals = np.array(normals)
    return normals / np.linalg.norm(normals, axis=1)[:, None]


def tube_triangles(rings, around, closed):
    triangles = []
    for i in range(rings if closed else rings - 1):
        for k in range(around):
            a, b = i * around + k, i * around + (k + 1) % around
            c, d = (((i + 1) % rings) * around + j % around for j in (k, k + 1))
            triangles += [(a, b, d), (a, d, c)]
    if not closed:
        last = (rings - 1) * around
        triangles += [(0, k + 1, k) for k in range(1, around - 1)]
        triangles += [(last, last + k, last + k + 1) for k in range(1, around - 1)]
    return np.array(triangles)


def crane_hook():
    """A straight shank, then an arc of three quarters of a turn that thickens and ends thin."""
    shank = np.linspace(16, -30, 24)
    bend = np.linspace(0, 1, 12)[1:]
    turn = np.linspace(0.42 * PI, -0.98 * PI, 52)
    start = np.array([24 * math.cos(turn[0]), 24 * math.sin(turn[0]) - 62])
    points = np.concatenate([
        np.stack([0 * shank, 0 * shank, shank], 1),
        np.stack([start[0] * bend**2, 0 * bend, -30 + (start[1] + 30) * bend], 1),
        np.stack([24 * np.cos(turn), 0 * turn, 24 * np.sin(turn) - 62], 1)[1:]])
    along = np.linspace(0, 1, len(turn) - 1)
    radii = np.concatenate([np.full(35, 6.5), 6.5 + 4.5 * np.sin(PI * along) - 4 * along])
    return tube(points, radii, 24)


def coil_spring():
    t = np.linspace(0, 6.3, 260)
    pitch = np.where(t < 1, 0.25 * t, np.where(t > 5.3, 0.25 + 4.3 + 0.25 * (t - 5.3), t - 0.75))
    points = np.stack([17 * np.cos(2 * PI * t), 17 * np.sin(2 * PI * t), 11 * pitch], 1)
    return tube(points, np.full(len(t), 2.4), 14)


def u_bolt():
    arc = np.linspace(0, PI, 30)
    legs = np.linspace(48, 2, 14)
    points = np.concatenate([
        np.stack([0 * legs + 24, 0 * legs, -legs], 1),
        np.stack([24 * np.cos(arc), 0 * arc, 24 * np.sin(arc)], 1),
        np.stack([0 * legs - 24, 0 * legs, -1.25 * legs[::-1]], 1)])
    return tube(points, np.full(len(points), 4.0), 22)


def cup_handle():
    t = np.linspace(0, 1, 60)
    points = np.stack([52 * (t - 0.5), 6 * np.sin(2 * PI * t), 34 * np.sin(PI * t) ** 0.8], 1)
    return tube(points, 5 + 4 * (2 * t - 1) ** 4 + 1.5 * t, 24)


def bent_wire():
    corners = np.array([[-45, -20, 0], [-45, 15, 0], [-15, 15, 0], [-5, 15, 22], [25, 15, 22],
                        [40, 0, 22], [40, -22, 5]], float)
    points = []
    for a, b, c in zip(corners, corners[1:], corners[2:]):  # corners rounded by parabolas
        start, end = (a + b) / 2 if len(points) else a, (b + c) / 2
        s = np.linspace(0, 1, 14, endpoint=False)[:, None]
        points.append((1 - s) ** 2 * start + 2 * s * (1 - s) * b + s * s * end)
    points.append(np.linspace((corners[-2] + corners[-1]) / 2, corners[-1], 5))
    points = np.concatenate(points)
    return tube(points, np.full(len(points), 2.2), 16)


SHAPES = [pebble, mouse_shell, bath_duck, pistol_grip, grip_ball, crane_hook, coil_spring, u_bolt,
          cup_handle, bent_wire]
