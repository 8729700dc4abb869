#!/usr/bin/python3
"""Voxelise, thin by Lee's method, make a graph: what a user of scikit-image does.

    lee_thinning.py SHAPE.off OUT.obj [VOXELS]

VOXELS (128) lie along the longest side. Prints {"seconds": {"voxelise", "thin", "graph"}} in user
CPU time; reading, writing and loading modules do not count.
"""

import itertools
import json
import resource
import sys

import numpy as np
import skimage
from skimage.morphology import skeletonize_3d

PAD = 2
# Off the lattice, so that no column runs through an edge of a model made on round numbers.
NUDGE = np.array([0.5 + 1.37e-5, 0.5 + 2.11e-5])
NEIGHBOURS = np.array([d for d in itertools.product((-1, 0, 1), repeat=3) if d != (0, 0, 0)])


def user_seconds():
    return resource.getrusage(resource.RUSAGE_SELF).ru_utime


def read_off(path):
    """Points and triangles of an OFF file that holds triangles only."""
    with open(path, "rb") as file:
        header = file.readline() + file.readline()
        points, triangles = (int(word) for word in header.split()[1:3])
        numbers = np.array(file.read().split(), dtype=float)
    corners = numbers[3 * points:].reshape(triangles, 4)
    return numbers[:3 * points].reshape(points, 3), corners[:, 1:].astype(np.int64)


def candidates(corners):
    """Pairs of a triangle and a column of voxels whose axis runs through the triangle's box."""
    low = np.ceil(corners[:, :, :2].min(axis=1) - NUDGE).astype(np.int64)
    high = np.floor(corners[:, :, :2].max(axis=1) - NUDGE).astype(np.int64)
    width, height = np.maximum(high - low + 1, 0).T
    count = width * height
    triangle = np.repeat(np.arange(len(corners)), count)
    within = np.arange(len(triangle)) - np.repeat(np.cumsum(count) - count, count)
    column = low[triangle]
    column[:, 0] += within % width[triangle]
    column[:, 1] += within // width[triangle]
    return triangle, column


def voxelise(points, triangles, voxels):
    """Voxels whose centre the surface winds around, by counting crossings along columns."""
    origin = points.min(axis=0)
    side = (points.max(axis=0) - origin).max() / voxels
    scaled = (points - origin) / side + PAD
    size = np.ceil(scaled.max(axis=0)).astype(np.int64) + PAD
    corners = scaled[triangles]
    triangle, column = candidates(corners)
    a, b, c = (corners[:, i][triangle] for i in range(3))
    centre = column + NUDGE

    def side_of(p, q):
        return ((q[:, 0] - p[:, 0]) * (centre[:, 1] - p[:, 1])
                - (q[:, 1] - p[:, 1]) * (centre[:, 0] - p[:, 0]))

    weights = np.stack([side_of(b, c), side_of(c, a), side_of(a, b)])
    hit = (weights > 0).all(axis=0) | (weights < 0).all(axis=0)
    weights, column = weights[:, hit], column[hit]
    area = weights.sum(axis=0)
    height = (weights[0] * a[hit, 2] + weights[1] * b[hit, 2] + weights[2] * c[hit, 2]) / area
    first = np.ceil(height - 0.5).astype(np.int64)
    index = np.ravel_multi_index((column[:, 0], column[:, 1], first), size)
    steps = np.bincount(index, weights=np.sign(area), minlength=size.prod()).reshape(size)
    return np.cumsum(steps, axis=2) != 0, origin, side


def graph_of(thin):
    """Voxels and the edges between 26-neighbours, without the longest of every triangle."""
    voxels = np.argwhere(thin)
    number = np.full(thin.shape, -1)
    number[tuple(voxels.T)] = np.arange(len(voxels))
    near = number[tuple(np.moveaxis(voxels[:, None, :] + NEIGHBOURS, 2, 0))]
    length = (NEIGHBOURS ** 2).sum(axis=1)
    place = {tuple(d): i for i, d in enumerate(NEIGHBOURS)}

    def order(i, j, squared):
        """A total order of edges: by length, then by their voxels."""
        return (squared * len(voxels) + np.minimum(i, j)) * len(voxels) + np.maximum(i, j)

    edges = []
    for k in range(13, 26):  # one of each opposite pair
        i = np.flatnonzero(near[:, k] >= 0)
        j = near[i, k]
        mine, longest = order(i, j, length[k]), np.zeros(len(i), dtype=bool)
        for m, d in enumerate(NEIGHBOURS):
            rest = place.get(tuple(NEIGHBOURS[k] - d))
            if rest is None:
                continue
            third = near[i, m]
            longest |= ((third >= 0) & (order(i, third, length[m]) < mine)
                        & (order(j, third, length[rest]) < mine))
        edges.append(np.stack([i, j], axis=1)[~longest])
    return voxels, np.concatenate(edges)


def write_obj(path, points, edges):
    with open(path, "w", encoding="ascii") as file:
        file.writelines("v {:.9g} {:.9g} {:.9g}\n".format(*p) for p in points)
        file.writelines("l {} {}\n".format(*e) for e in edges + 1)


def main(shape_path, out_path, voxels="128"):
    points, triangles = read_off(shape_path)
    marks = [user_seconds()]
    solid, origin, side = voxelise(points, triangles, int(voxels))
    marks.append(user_seconds())
    thin = skeletonize_3d(solid)
    marks.append(user_seconds())
    nodes, edges = graph_of(thin > 0)
    marks.append(user_seconds())
    parts = dict(zip(("voxelise", "thin", "graph"), np.diff(marks).round(6).tolist()))
    print(json.dumps({"seconds": parts, "version": "scikit-image " + skimage.__version__}))
    write_obj(out_path, (nodes + 0.5 - PAD) * side + origin, edges)


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit("usage: lee_thinning.py SHAPE.off OUT.obj [VOXELS]")
    main(*sys.argv[1:])
