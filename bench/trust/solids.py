"""Short words for Gmsh's OpenCASCADE kernel: solids, unions, cuts. Millimetres and radians.

Every function takes and returns solids as Gmsh's (3, tag). Gmsh must be initialised.
"""
import math

import gmsh

occ = gmsh.model.occ


def box(x, y, z, size_x, size_y, size_z):
    """From the corner x, y, z."""
    return 3, occ.addBox(x, y, z, size_x, size_y, size_z)


def block(size_x, size_y, size_z, x=0, y=0, z=0):
    """Centred on x, y; its lower face is at z."""
    return box(x - size_x / 2, y - size_y / 2, z, size_x, size_y, size_z)


def cylinder(radius, height, x=0, y=0, z=0, axis=(0, 0, 1)):
    """From the point x, y, z along the axis, a unit vector."""
    return 3, occ.addCylinder(x, y, z, *(height * c for c in axis), radius)


def ring(outer, inner, height, **place):
    return cut(cylinder(outer, height, **place), cylinder(inner, height, **place))


def cone(radius, top_radius, height, x=0, y=0, z=0):
    return 3, occ.addCone(x, y, z, 0, 0, height, radius, top_radius)


def ball(radius, x=0, y=0, z=0):
    return 3, occ.addSphere(x, y, z, radius)


def prism(points, height, z=0):
    """A polygon of (x, y), extruded along z."""
    return extruded(plane(polyline([(x, y, z) for x, y in points])), height)


def rounded_block(size_x, size_y, height, corner, x=0, y=0, z=0):
    """A block with round vertical edges."""
    face = occ.addRectangle(x - size_x / 2, y - size_y / 2, z, size_x, size_y, -1, corner)
    return extruded(face, height)


def slot(length, width, height, x=0, y=0, z=0):
    """A block whose ends are half cylinders; the length is between their axes, along x."""
    return rounded_block(length + width, width, height, 0.4999 * width, x, y, z)


def revolved(points):
    """A polygon of (radius, z) off the axis, turned about z.

    In two halves, since a whole turn leaves the two ends of its surface apart."""
    halves = []
    for first_rad in (0, math.pi):
        face = plane(polyline([(r, 0, z) for r, z in points]))
        half = last_solid(occ.revolve([(2, face)], 0, 0, 0, 0, 0, 1, math.pi))
        halves.append(turned(half, first_rad))
    return fuse(*halves)


def polyline(points):
    corners = [occ.addPoint(*p) for p in points]
    return occ.addCurveLoop([occ.addLine(a, b) for a, b in zip(corners, corners[1:] + corners[:1])])


def plane(loop):
    return occ.addPlaneSurface([loop])


def extruded(face, height):
    return last_solid(occ.extrude([(2, face)], 0, 0, height))


def last_solid(entities):
    return [e for e in entities if e[0] == 3][-1]


def fuse(first, *others):
    """The union; one solid where they touch."""
    return occ.fuse([first], list(others))[0][0]


def cut(first, *tools):
    return occ.cut([first], list(tools))[0][0]


def moved(solid, x=0, y=0, z=0):
    occ.translate([solid], x, y, z)
    return solid


def turned(solid, angle_rad, axis=(0, 0, 1)):
    """About an axis through the origin."""
    occ.rotate([solid], 0, 0, 0, *axis, angle_rad)
    return solid


def around(make, count, first_rad=0.0):
    """`count` solids, evenly turned about z; make() returns the first."""
    return [turned(make(), first_rad + 2 * math.pi * k / count) for k in range(count)]


def rounded(solid, radius, chosen=lambda low, high: True):
    """Rounds the edges whose bounding box (low, high) is chosen."""
    occ.synchronize()
    edges = gmsh.model.getBoundary([solid], combined=False, oriented=False)
    edges = gmsh.model.getBoundary(edges, combined=False, oriented=False)
    tags = sorted({tag for _, tag in edges})
    boxes = {tag: gmsh.model.getBoundingBox(1, tag) for tag in tags}
    picked = [tag for tag in tags if chosen(boxes[tag][:3], boxes[tag][3:])]
    return occ.fillet([solid[1]], picked, [radius])[0]


def vertical(low, high):
    """Chooses edges along z."""
    return high[2] - low[2] > 1e-3 and high[0] - low[0] < 1e-3 and high[1] - low[1] < 1e-3
