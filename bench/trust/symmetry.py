"""Finds the rotations that map a mesh onto itself.

A rotation about the surface's centroid counts as a symmetry if 99 % of the turned surface is no
further from the surface than TOLERANCE times the diameter, less than a pixel on a part of 150 px,
and none of it further than LARGEST.
The axis of a symmetry is an eigenvector of the surface's second moments. Where eigenvalues are
equal, every axis of their eigenspace is tried.
"""
import math
from dataclasses import dataclass, field

import numpy as np
from scipy.optimize import minimize
from scipy.spatial import ConvexHull, cKDTree
from scipy.spatial.distance import pdist
from scipy.spatial.transform import Rotation

TOLERANCE = 0.006
LARGEST = 0.03
HIGHEST_ORDER = 48
SPACING = 0.003  # of the points that stand for the surface, in diameters
GAP = 4 * SPACING  # no point of the surface is further from all of them
MOST_POINTS = 1_000_000
COARSE_POINTS = 20_000
EQUAL_MOMENTS = 0.01  # relative difference
AXIS_STEP_RAD = math.radians(3)  # of the axes that are tried in an eigenspace
# Turns that no finite symmetry of a low order explains.
IRREGULAR_TURNS_RAD = (0.11, 0.37, 0.83, 1.39, 2.03, 2.71)


@dataclass
class Symmetries:
    center: np.ndarray  # every axis passes through it
    rotations: list = field(default_factory=list)  # discrete ones without the identity, 3x3
    axis: np.ndarray | None = None  # of a surface of revolution


def diameter(vertices):
    """The largest distance between two vertices."""
    corners = vertices[ConvexHull(vertices).vertices]
    if len(corners) > 4000:  # those that are extreme in one of many directions
        directions = sphere_directions(4000)
        corners = corners[np.unique((directions @ corners.T).argmax(1))]
    return float(pdist(corners).max())


def sphere_directions(count):
    """Evenly spread unit vectors (Fibonacci lattice)."""
    i = np.arange(count)
    z = 1 - (2 * i + 1) / count
    turn = i * math.pi * (3 - math.sqrt(5))
    radius = np.sqrt(1 - z * z)
    return np.stack([radius * np.cos(turn), radius * np.sin(turn), z], 1)


class Surface:
    """Points on a mesh, relative to the centroid and in diameters, that answer how far a turned
    copy is from it."""

    def __init__(self, vertices, triangles, seed=1):
        a, b, c = (vertices[triangles[:, k]] for k in range(3))
        weight = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
        self.diameter = diameter(vertices)
        self.center = (weight[:, None] * (a + b + c)).sum(0) / (3 * weight.sum())
        count = int(min(MOST_POINTS, weight.sum() / (SPACING * self.diameter) ** 2))
        random = np.random.default_rng(seed)
        # One random point in each of `count` equal shares of the area.
        share = (np.arange(count) + random.random(count)) / count
        pick = np.minimum(np.searchsorted(np.cumsum(weight) / weight.sum(), share), len(weight) - 1)
        u, v = random.random((2, count, 1))
        u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
        points = a[pick] + u * (b - a)[pick] + v * (c - a)[pick]
        order = random.permutation(count)
        self.points = ((points - self.center) / self.diameter)[order]
        self.normals = unit_normals(a, b, c)[pick][order]
        self.tree = cKDTree(self.points)
        self.coarse_tree = cKDTree(self.points[:COARSE_POINTS])
        self.moments = second_moments(a - self.center, b - self.center, c - self.center, weight)

    def distances(self, tree, rotation, probes):
        """Of the last probes, turned, from the surface; both ways, since a turned copy may cover
        only a part of the surface. Up to GAP along the surface does not count."""
        points = self.points[-probes:]
        turned = np.concatenate([points @ rotation.T, points @ rotation])
        distances, nearest = tree.query(turned)
        above = np.abs(np.einsum("ij,ij->i", turned - self.points[nearest], self.normals[nearest]))
        return np.maximum(above, distances - GAP)

    def coarse_misfits(self, rotations, probes=60):
        """For each rotation, a distance that most turned points are below."""
        turned = np.einsum("rij,pj->rpi", rotations, self.points[-probes:])
        distances = self.coarse_tree.query(turned.reshape(-1, 3))[0].reshape(-1, probes)
        return np.quantile(distances, 0.9, axis=1)

    def misfit(self, rotation):
        """Mean squared distance, measured coarsely: where it is least, a refinement ends."""
        return float(np.mean(self.distances(self.coarse_tree, rotation, 200) ** 2))

    def keeps(self, rotation):
        """Probed coarsely first, since most rotations are far off."""
        for probes in (200, 1000, 10000):
            distances = self.distances(self.tree, rotation, probes)
            if distances.max() > LARGEST or np.quantile(distances, 0.99) > TOLERANCE:
                return False
        return True


def unit_normals(a, b, c):
    normals = np.cross(b - a, c - a)
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)


def second_moments(a, b, c, weight):
    """Integral of x x^T over the triangles with these corners and areas, divided by the area."""
    middles = [(a + b) / 2, (b + c) / 2, (c + a) / 2]  # exact for polynomials of degree 2
    return sum((weight[:, None] * m).T @ m for m in middles) / (3 * weight.sum())


def turn(axis, angle_rad):
    return Rotation.from_rotvec(angle_rad * axis / np.linalg.norm(axis)).as_matrix()


def lattice(moments):
    """(axes, highest order) in the eigenspaces that have more than one dimension. The solids with
    three equal moments have no order above 5, but by accident."""
    values, vectors = np.linalg.eigh(moments)
    same = [values[k + 1] - values[k] < EQUAL_MOMENTS * values[2] for k in range(2)]
    if all(same):
        axes = sphere_directions(int(4 * math.pi / AXIS_STEP_RAD**2))
        return axes[axes[:, 2] >= 0], 5
    if any(same):
        u, v = (vectors[:, :2] if same[0] else vectors[:, 1:]).T
        angles = np.arange(0, math.pi, AXIS_STEP_RAD)[:, None]
        return np.cos(angles) * u + np.sin(angles) * v, 2
    return np.zeros((0, 3)), 1


def candidates(surface):
    """(misfit, axis, order, is on the lattice) of what a refinement may make a symmetry, best
    first."""
    _, vectors = np.linalg.eigh(surface.moments)
    axes, highest_order = lattice(surface.moments)
    tried = [(axis, order, False) for axis in vectors.T for order in range(2, HIGHEST_ORDER + 1)]
    tried += [(axis, order, True) for axis in axes for order in range(2, highest_order + 1)]
    misfits = surface.coarse_misfits(np.array([turn(axis, 2 * math.pi / order)
                                               for axis, order, _ in tried]))
    good = [(misfit, *candidate) for misfit, candidate in zip(misfits, tried)
            if misfit < 4 * TOLERANCE + (AXIS_STEP_RAD / 2 if candidate[2] else 0)]
    return sorted(good, key=lambda c: c[0])


def refined(surface, axis, order):
    """The axis near the given one about which a turn of this order fits best."""
    u, v = np.linalg.svd(axis[None])[2][1:]

    def misfit(shift):
        return surface.misfit(turn(axis + shift[0] * u + shift[1] * v, 2 * math.pi / order))

    found = minimize(misfit, [0, 0], method="Nelder-Mead",
                     options={"initial_simplex": [[0, 0], [0.02, 0], [0, 0.02]], "xatol": 1e-4,
                              "fatol": 1e-12, "maxiter": 80})
    best = axis + found.x[0] * u + found.x[1] * v
    return best / np.linalg.norm(best)


def is_revolution(surface, axis):
    return all(surface.keeps(turn(axis, angle)) for angle in IRREGULAR_TURNS_RAD)


def symmetry_about(surface, axis, order):
    """The axis near the given one about which a turn of this order is a symmetry, or None."""
    better = refined(surface, axis, order)
    return better if surface.keeps(turn(better, 2 * math.pi / order)) else None


def is_among(rotation, rotations, within_rad):
    cosine = 1 + 2 * math.cos(within_rad)
    return any(np.trace(rotation.T @ known) > cosine for known in rotations)


def closed(generators, most=2 * HIGHEST_ORDER):
    """The group that the rotations generate. ValueError: more members than `most`."""
    group = [np.eye(3)]
    for known in group:  # grows
        for generator in generators:
            if not is_among(known @ generator, group, 0.06):
                group.append(known @ generator)
        if len(group) > most:
            raise ValueError("symmetries that generate no finite group")
    return group


def find_symmetries(vertices, triangles):
    """All rotations that map the mesh onto itself."""
    surface = Surface(vertices, triangles)
    for axis in np.linalg.eigh(surface.moments)[1].T:
        if is_revolution(surface, axis):
            return of_revolution(surface, axis)
    generators, group, tried = [], [np.eye(3)], []
    for _, axis, order, on_lattice in candidates(surface):
        rotation = turn(axis, 2 * math.pi / order)
        if is_among(rotation, group, 3 * AXIS_STEP_RAD) or (
                on_lattice and is_among(rotation, tried, 3 * AXIS_STEP_RAD)):
            continue
        if on_lattice:
            tried.append(rotation)
        better = symmetry_about(surface, axis, order)
        if better is None:
            continue
        generators.append(turn(better, 2 * math.pi / order))
        group = closed(generators)
    return Symmetries(surface.center, group[1:])


def of_revolution(surface, axis):
    across = np.linalg.svd(axis[None])[2][1]
    flip = turn(across, math.pi)
    return Symmetries(surface.center, [flip] if surface.keeps(flip) else [], axis)


def as_models_info(symmetries):
    """The symmetries in the words of BOP's models_info.json, in the mesh's unit."""
    info = {}
    if symmetries.axis is not None:
        info["symmetries_continuous"] = [
            {"axis": symmetries.axis.tolist(), "offset": symmetries.center.tolist()}]
    if symmetries.rotations:
        info["symmetries_discrete"] = [matrix_about(r, symmetries.center)
                                       for r in symmetries.rotations]
    return info


def matrix_about(rotation, center):
    matrix = np.eye(4)
    matrix[:3, :3] = rotation
    matrix[:3, 3] = center - rotation @ center
    return matrix.reshape(-1).tolist()

