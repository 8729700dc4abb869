"""The Python module: build/PRESET/python is on sys.path when ctest runs this."""

import gc
import pickle
import threading

import numpy as np
import pytest

import marrow


def box(low, high):
    """Vertices and quads of an axis-parallel box."""
    corners = [[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1])
               for z in (low[2], high[2])]
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return np.array(corners, float), np.array(quads)


def torus(rings=64, sides=24, thickness=0.3):
    """Vertices and triangles of a torus around z."""
    u, v = np.meshgrid(np.arange(rings) * 2 * np.pi / rings, np.arange(sides) * 2 * np.pi / sides,
                       indexing="ij")
    reach = 1 + thickness * np.cos(v)
    vertices = np.stack([reach * np.cos(u), reach * np.sin(u), thickness * np.sin(v)], -1)
    i, j = np.meshgrid(np.arange(rings), np.arange(sides), indexing="ij")
    at = lambda a, b: (a % rings) * sides + b % sides
    quads = np.stack([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)], -1).reshape(-1, 4)
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    return vertices.reshape(-1, 3), triangles


@pytest.fixture(scope="module")
def ring():
    return marrow.extract(*torus())


def test_a_torus_is_one_cycle(ring):
    assert (ring.components, ring.cycles, ring.leaves, ring.joints) == (1, 1, 0, 0)
    assert ring.nodes.shape == (len(ring), 3) and ring.edges.shape[1] == 2
    away = np.abs(np.hypot(ring.nodes[:, 0], ring.nodes[:, 1]) - 1)
    assert away.max() < 0.03 and np.abs(ring.nodes[:, 2]).max() < 0.03
    assert np.abs(ring.radii - 0.3).max() < 0.03
    assert abs(ring.length - 2 * np.pi) < 0.1
    assert [b[0] for b in ring.branches] == [b[-1] for b in ring.branches]
    assert (ring.degrees == 2).all()


def test_quads_and_any_numbers_will_do(ring):
    vertices, faces = box([0, 0, 0], [1, 1, 9])
    s = marrow.extract(vertices, faces)
    assert (s.components, s.cycles, s.leaves) == (1, 0, 2)
    again = marrow.extract(vertices.astype(np.float32).tolist(), faces.astype(np.uint8))
    assert again == s
    backwards = marrow.extract(np.asfortranarray(vertices), faces[:, ::-1])
    assert backwards.leaves == 2


def test_clouds_and_volumes_have_the_same_ring(ring):
    vertices, _ = torus(180, 60)
    cloud = marrow.extract(vertices)
    assert (cloud.components, cloud.cycles, cloud.leaves) == (1, 1, 0)
    x, y, z = np.meshgrid(*[np.linspace(-1.5, 1.5, 61)] * 3, indexing="ij")
    depth = 0.3 - np.hypot(np.hypot(x, y) - 1, z)
    for values in (depth, np.asfortranarray(depth), depth[::-1][::-1], depth.astype(np.float32)):
        s = marrow.extract_volume(values, spacing=(0.05,) * 3, origin=(-1.5,) * 3)
        assert (s.components, s.cycles, s.leaves) == (1, 1, 0)
        assert np.abs(np.hypot(s.nodes[:, 0], s.nodes[:, 1]) - 1).max() < 0.05
    flags = marrow.extract_volume(depth > 0, spacing=(0.05,) * 3, origin=(-1.5,) * 3)
    assert flags == s


def test_arrays_show_the_memory_of_their_skeleton():
    s = marrow.extract(*box([0, 0, 0], [1, 1, 9]))
    nodes, copy = s.nodes, s.nodes.copy()
    with pytest.raises(ValueError):
        nodes[0, 0] = 1
    del s
    gc.collect()
    assert (nodes == copy).all()


def test_every_vertex_has_its_branch():
    vertices, faces = box([0, 0, 0], [1, 1, 9])
    s = marrow.extract(vertices, faces)
    told = s.map(vertices, faces)
    assert set(told) == {"node", "branch", "part"}
    near = np.linalg.norm(s.nodes[told["node"]] - vertices, axis=1)
    assert (near < 2).all() and (told["branch"] == 0).all() and (told["part"] == 0).all()

    rods = np.zeros((9, 5, 30), bool)
    rods[1:3, 1:4, 1:29] = rods[6:8, 1:4, 1:29] = True
    two = marrow.extract_volume(rods)
    told = two.map_volume(rods)
    assert told["part"].shape == rods.shape and ((told["part"] >= 0) == rods).all()
    assert len(set(told["part"][:4][rods[:4]])) == len(set(told["part"][5:][rods[5:]])) == 1
    assert told["part"][1, 1, 1] != told["part"][6, 1, 1]


def test_viewpoints_and_rules(ring):
    directions = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1], [1, -1, 1], [1, 1, -1], [-1, 1, 1]]
    assert marrow.extract(*torus(), views=directions).cycles == 1
    assert marrow.extract(*torus(), views=21) == ring != marrow.extract(*torus(), views=81)
    assert marrow.extract(*torus(), rules="paper") != ring


@pytest.mark.parametrize("extension", ["obj", "skel", "ply", "json"])
def test_files_read_back(ring, tmp_path, extension):
    path = tmp_path / ("ring." + extension)
    ring.save(path)
    back = marrow.load(path)
    assert (back.nodes == ring.nodes).all() and (back.radii == ring.radii).all()
    assert (back.edges == ring.edges).all()


def test_a_file_is_extracted_as_its_arrays_are(ring, tmp_path):
    vertices, faces = torus()
    path = tmp_path / "torus.off"
    with open(path, "w") as f:
        f.write("OFF\n%d %d 0\n" % (len(vertices), len(faces)))
        f.writelines("%r %r %r\n" % tuple(map(float, p)) for p in vertices)
        f.writelines("3 %d %d %d\n" % tuple(t) for t in faces)
    assert marrow.extract_file(path) == ring
    read = marrow.read_shape(path)
    assert (read[0] == vertices).all() and (read[1] == faces).all()


def test_networkx_gets_the_graph(ring):
    networkx = pytest.importorskip("networkx")
    graph = ring.to_networkx()
    assert networkx.number_connected_components(graph) == 1
    assert graph.number_of_edges() - graph.number_of_nodes() + 1 == ring.cycles
    assert graph.nodes[0]["radius"] == ring.radii[0]
    assert tuple(ring.nodes[3]) == graph.nodes[3]["pos"]


def test_skeletons_are_made_of_arrays_and_pickled(ring):
    same = marrow.Skeleton(ring.nodes, ring.radii, ring.edges, ring.section_radii)
    assert same == ring and pickle.loads(pickle.dumps(ring)) == ring
    two = marrow.Skeleton([[0, 0, 0], [1, 0, 0], [5, 5, 5], [9, 5, 5]], [1, 1, 1, 1],
                          [[1, 0], [0, 1], [2, 3]])
    assert two.edges.tolist() == [[0, 1], [2, 3]] and two.components == 2
    assert two.largest_part().length == 4 and len(two.large_parts(0.9)) == 2
    assert "components 2" in repr(two)


@pytest.mark.parametrize("call, kind", [
    (lambda: marrow.extract([[0, 0]]), "usage"),
    (lambda: marrow.extract([[0, 0, 0]] * 3, [[0, 1, 3]]), "malformed"),
    (lambda: marrow.extract([[0, 0, 0]] * 3, [[0, -1, 2]]), "malformed"),
    (lambda: marrow.extract([[0, 0, np.nan]] * 3, [[0, 1, 2]]), "malformed"),
    (lambda: marrow.extract([[0, 0, 0]] * 3, [[0, 1]]), "usage"),
    (lambda: marrow.extract(np.zeros((0, 3))), "empty"),
    (lambda: marrow.extract(*torus(), image=7), "usage"),
    (lambda: marrow.extract(*torus(), silhouettes="gpu"), "usage"),
    (lambda: marrow.extract_volume(np.zeros((4, 4))), "usage"),
    (lambda: marrow.extract_volume(np.zeros((4, 4, 4))), "empty"),
    (lambda: marrow.extract_volume(np.zeros((4, 4, 4), complex)), "unsupported"),
    (lambda: marrow.extract_volume(np.ones((4, 4, 4)), spacing=(1, 0, 1)), "usage"),
    (lambda: marrow.load("nowhere.skel"), "cannot-read"),
    (lambda: marrow.read_shape("nowhere.xyzzy"), "unsupported"),
    (lambda: marrow.Skeleton([[0, 0, 0]], [1], [[0, 0]]), "malformed"),
    (lambda: marrow.Skeleton([[0, 0, 0]], [0], np.zeros((0, 2))), "malformed"),
    (lambda: marrow.Skeleton([[0, 0, 0]], [1, 2], np.zeros((0, 2))), "usage"),
])
def test_what_is_wrong_raises_one_error(call, kind):
    with pytest.raises(marrow.Error) as caught:
        call()
    assert caught.value.kind == kind and caught.value.status > 1
    assert "\n" not in str(caught.value)


def test_unknown_keywords_are_refused():
    with pytest.raises(TypeError, match="imgae"):
        marrow.extract(*torus(), imgae=256)


def test_progress_is_told_and_may_stop_the_work(ring):
    told = []
    assert marrow.extract(*torus(), progress=lambda stage, done: told.append((stage, done))) == ring
    shares = [done for _, done in told]
    assert shares == sorted(shares) and shares[0] == 0 and shares[-1] == 1

    def stop(stage, done):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        marrow.extract(*torus(), progress=stop)


def test_threads_run_side_by_side(ring):
    results = [None] * 4

    def work(i):
        results[i] = marrow.extract(*torus(), threads=1 + i % 2)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert all(s == ring for s in results)
