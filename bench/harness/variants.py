"""Shapes made from other shapes: turned, noisy, with holes, coarser. Needs numpy."""

import numpy as np

from . import machine
from .shapes import Subject

# Rotations of whole quaternions, far from the axes.
QUATERNIONS = ((5, 2, -3, 1), (1, 4, 2, -2), (-2, 1, 3, 5))


def read(subject):
    """Vertices and triangles."""
    with open(subject.off(), encoding="ascii") as file:
        words = file.read().split()
    points, triangles = int(words[1]), int(words[2])
    numbers = np.array(words[4:4 + 3 * points + 4 * triangles], dtype=float)
    return (numbers[:3 * points].reshape(-1, 3),
            numbers[3 * points:].reshape(-1, 4)[:, 1:].astype(np.int64))


def write(name, vertices, triangles, expected):
    """Leaves out vertices that no triangle uses."""
    used, triangles = np.unique(triangles, return_inverse=True)
    triangles = triangles.reshape(-1, 3)
    path = machine.work("variants", f"{name}.off")
    with open(path, "w", encoding="ascii") as file:
        file.write(f"OFF\n{len(used)} {len(triangles)} 0\n")
        np.savetxt(file, vertices[used], "%.17g")
        np.savetxt(file, np.hstack([np.full((len(triangles), 1), 3), triangles]), "%d")
    return Subject(name, str(path), expected, len(triangles))


def rotation(number):
    w, x, y, z = QUATERNIONS[number] / np.linalg.norm(QUATERNIONS[number])
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def turned(subject, number):
    vertices, triangles = read(subject)
    return write(f"{subject.name}_turned{number + 1}", vertices @ rotation(number).T, triangles,
                 subject.expected)


def noisy(subject, percent):
    """Vertices along their normals by up to `percent` of the diagonal."""
    vertices, triangles = read(subject)
    corners = vertices[triangles]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.zeros_like(vertices)
    for k in range(3):
        np.add.at(normals, triangles[:, k], across)
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    diagonal = np.linalg.norm(np.ptp(vertices, axis=0))
    by = np.random.Generator(np.random.PCG64(7)).uniform(-1, 1, (len(vertices), 1))
    return write(f"{subject.name}_noise{percent:g}", vertices + normals * by * diagonal * percent / 100,
                 triangles, subject.expected)


def holed(subject, share=0.07):
    """Without the triangles nearest to the vertex that lies furthest along x, a `share` of all."""
    vertices, triangles = read(subject)
    away = np.linalg.norm(vertices[triangles].mean(axis=1) - vertices[np.argmax(vertices[:, 0])],
                          axis=1)
    kept = np.sort(np.argsort(away, kind="stable")[int(share * len(triangles)):])
    return write(f"{subject.name}_hole", vertices, triangles[kept], subject.expected)


def coarser(subject, cells):
    """Vertices merged in a grid of `cells` along the longest side."""
    vertices, triangles = read(subject)
    low = vertices.min(axis=0)
    size = np.ptp(vertices, axis=0).max() / cells
    keys = np.floor((vertices - low) / size).astype(np.int64)
    _, group = np.unique(keys, axis=0, return_inverse=True)
    group = group.reshape(-1)
    count = np.bincount(group)
    merged = np.stack([np.bincount(group, vertices[:, k]) / count for k in range(3)], axis=1)
    faces = group[triangles]
    flat = (faces[:, 0] == faces[:, 1]) | (faces[:, 1] == faces[:, 2]) | (faces[:, 2] == faces[:, 0])
    return write(f"{subject.name}_cells{cells}", merged, faces[~flat], subject.expected)


def with_faces(subject, faces):
    """About so many triangles, by the grid of coarser() that comes nearest."""
    low, high = 4, 256
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if coarser(subject, middle).faces <= faces else (low, middle)
    return coarser(subject, low)


def turned_back(path, rotation):
    """The skeleton of an OBJ, turned by the inverse of `rotation`; the path of the result."""
    out = str(path).removesuffix(".obj") + ".back.obj"
    back = np.array(rotation).T
    with open(path, encoding="ascii") as file, open(out, "w", encoding="ascii") as result:
        for line in file:
            words = line.split()
            if words[:1] == ["v"]:
                place = back @ np.array(words[1:4], dtype=float)
                line = " ".join(["v", *map(repr, place.tolist()), *words[4:]]) + "\n"
            result.write(line)
    return out
