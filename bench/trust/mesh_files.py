"""Reads triangle meshes of STL, OBJ, OFF and PLY files, tessellates CAD files, writes BOP's PLY.

A mesh is a pair of arrays: vertices [n, 3] and triangles [m, 3] of indices.
"""
import re
from pathlib import Path

import numpy as np

CAD_SUFFIXES = {".step", ".stp", ".iges", ".igs", ".brep"}
EDGES_PER_TURN = 40  # of a tessellated circle: the chord is 0.3 % of the radius off the arc
SHORTEST, LONGEST = 1 / 160, 1 / 10  # edge of a tessellation, in diagonals of the bounding box


def read_mesh(file):
    """Reads a mesh in the file's own unit. ValueError: an unknown or damaged file."""
    suffix = Path(file).suffix.lower()
    if suffix in CAD_SUFFIXES:
        return tessellated(file)
    readers = {".stl": read_stl, ".obj": read_obj, ".off": read_off, ".ply": read_ply}
    if suffix not in readers:
        raise ValueError(f"{file}: found {suffix}, expected one of {sorted(readers)}")
    return welded(*readers[suffix](file))


def tessellated(file):
    """Meshes the surfaces of a STEP, IGES or BREP file by Gmsh."""
    import gmsh

    gmsh.initialize()
    gmsh.option.setNumber("General.Verbosity", 1)
    try:
        gmsh.model.occ.importShapes(str(file))
        gmsh.model.occ.synchronize()
        return current_model()
    finally:
        gmsh.finalize()


def current_model():
    """Meshes the surfaces of Gmsh's current model."""
    import gmsh

    box = np.array(gmsh.model.getBoundingBox(-1, -1))
    diagonal = np.linalg.norm(box[3:] - box[:3])
    gmsh.option.setNumber("Mesh.MeshSizeFromCurvature", 1)
    gmsh.option.setNumber("Mesh.MinimumElementsPerTwoPi", EDGES_PER_TURN)
    gmsh.option.setNumber("Mesh.MeshSizeMin", SHORTEST * diagonal)
    gmsh.option.setNumber("Mesh.MeshSizeMax", LONGEST * diagonal)
    gmsh.model.mesh.generate(2)
    nodes, coordinates, _ = gmsh.model.mesh.getNodes()
    index = np.zeros(int(nodes.max()) + 1, int)
    index[nodes.astype(int)] = np.arange(len(nodes))
    _, corners = gmsh.model.mesh.getElementsByType(2)
    return welded(coordinates.reshape(-1, 3), index[corners.astype(int)].reshape(-1, 3))


def welded(vertices, triangles):
    """Joins vertices closer than 1e-6 of the size. Drops triangles that thereby lose their area,
    and vertices that none uses."""
    vertices = np.asarray(vertices, float)
    used = vertices[np.unique(triangles)]
    cell = 1e-6 * np.linalg.norm(used.max(0) - used.min(0))
    keys = np.round((vertices - used.min(0)) / cell).astype(np.int64)
    _, first, joined = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    triangles = joined.reshape(-1)[np.asarray(triangles)]
    a, b, c = triangles.T
    triangles = triangles[(a != b) & (b != c) & (c != a)]
    kept, triangles = np.unique(triangles, return_inverse=True)
    return vertices[first][kept], triangles.reshape(-1, 3)


def read_stl(file):
    data = Path(file).read_bytes()
    count = int.from_bytes(data[80:84], "little") if len(data) >= 84 else -1
    if len(data) == 84 + 50 * count:
        record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
        corners = np.frombuffer(data, record, count, 84)["corners"].astype(float)
    else:
        words = re.findall(rb"vertex\s+(\S+)\s+(\S+)\s+(\S+)", data, re.IGNORECASE)
        corners = np.array(words, float)
    corners = corners.reshape(-1, 3)
    if len(corners) == 0:
        raise ValueError(f"{file}: found no triangle")
    return corners, np.arange(len(corners)).reshape(-1, 3)


def read_obj(file):
    vertices, triangles = [], []
    for line in Path(file).read_text(errors="replace").splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(x) for x in words[1:4]])
        elif words[:1] == ["f"]:
            face = [int(word.split("/")[0]) for word in words[1:]]
            triangles += fan([i - 1 if i > 0 else len(vertices) + i for i in face])
    return np.array(vertices), np.array(triangles)


def read_off(file):
    words = iter(re.sub(r"#.*", "", Path(file).read_text()).split())
    if next(words) not in ("OFF", "COFF"):
        raise ValueError(f"{file}: found no OFF header")
    num_vertices, num_faces, _ = (int(next(words)) for _ in range(3))
    vertices = np.array([float(next(words)) for _ in range(3 * num_vertices)]).reshape(-1, 3)
    triangles = []
    for _ in range(num_faces):
        triangles += fan([int(next(words)) for _ in range(int(next(words)))])
    return vertices, np.array(triangles)


def read_ply(file):
    """Reads an ASCII PLY, or a binary one as write_ply_mm() makes it."""
    data = Path(file).read_bytes()
    head, body = data.split(b"end_header\n", 1)
    num_vertices = int(re.search(rb"element vertex (\d+)", head)[1])
    num_faces = int(re.search(rb"element face (\d+)", head)[1])
    if b"binary_little_endian" in head:
        vertices = np.frombuffer(body, "<f4", 3 * num_vertices).reshape(-1, 3)
        face = np.dtype([("count", "u1"), ("corners", "<i4", 3)])
        return vertices.astype(float), np.frombuffer(body, face, num_faces,
                                                     12 * num_vertices)["corners"]
    lines = body.decode().splitlines()
    vertices = np.array([line.split()[:3] for line in lines[:num_vertices]], float)
    triangles = []
    for line in lines[num_vertices:num_vertices + num_faces]:
        triangles += fan([int(word) for word in line.split()[1:]])
    return vertices, np.array(triangles)


def fan(corners):
    return [(corners[0], b, c) for b, c in zip(corners[1:], corners[2:])]


def write_ply_mm(file, vertices_mm, triangles):
    """Writes BOP's model format."""
    faces = np.zeros(len(triangles), [("count", "u1"), ("corners", "<i4", 3)])
    faces["count"] = 3
    faces["corners"] = triangles
    head = ("ply\nformat binary_little_endian 1.0\n"
            f"element vertex {len(vertices_mm)}\n"
            "property float x\nproperty float y\nproperty float z\n"
            f"element face {len(triangles)}\n"
            "property list uchar int vertex_indices\nend_header\n")
    Path(file).write_bytes(head.encode() + np.asarray(vertices_mm, "<f4").tobytes() +
                           faces.tobytes())
