#!/usr/bin/python3
"""What the scripts of bench/ count, predict and write."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
BENCH = Path(__file__).resolve().parents[1] / "bench"
sys.path[:0] = [str(BENCH), str(BENCH / "peers")]

from harness import cells, child, machine, schedule, skeletons, tables  # noqa: E402

try:
    import lee_thinning
    import numpy as np
except ImportError:
    lee_thinning = None


class WithFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        machine.use(self.folder)

    def file(self, content):
        path = self.folder / "file"
        path.write_text(content, encoding="utf-8")
        return path


class Skeletons(WithFolder):
    def counts(self, lines):
        nodes = max(int(word) for line in lines for word in line.split()[1:])
        return skeletons.counts(self.file("v 0 0 0\n" * nodes + "\n".join(lines)))

    def test_counts(self):
        self.assertEqual(self.counts(["l 1 2", "l 2 3", "l 2 4"]),
                         {"components": 1, "cycles": 0, "tips": 3})
        self.assertEqual(self.counts(["l 1 2", "l 2 3", "l 3 1", "l 4 5"]),
                         {"components": 2, "cycles": 1, "tips": 2})

    def test_polylines_and_repeated_edges(self):
        self.assertEqual(self.counts(["l 1 2 3", "l 3 2", "l 3 3"]),
                         {"components": 1, "cycles": 0, "tips": 2})

    def test_expectations(self):
        found = {"components": 1, "cycles": 2, "tips": 9}
        for expected, right in (({}, True), ({"components": 1, "cycles": [1, 2]}, True),
                                ({"tips": "n/a"}, True), ({"components": 2}, False),
                                ({"cycles": [0, 1]}, False), ({"tips": [10, 12]}, False)):
            self.assertEqual(skeletons.is_expected(found, expected), right, expected)


class Schedule(unittest.TestCase):
    def test_makespan(self):
        self.assertEqual(schedule.makespan([3, 2, 2], 1), 7)
        self.assertEqual(schedule.makespan([3, 2, 2], 2), 4)
        self.assertEqual(schedule.makespan([3, 2, 2], 8), 3)

    def test_no_more_than_one_core_a_view(self):
        rows = schedule.prediction([1.0] * 21, 7, (1, 11, 16, 21, 32))
        self.assertEqual([whole for _, whole, _ in rows], [28, 9, 9, 8, 8])
        self.assertEqual(rows[-1][2], 3.5)


class Tables(WithFolder):
    def test_geometric_mean(self):
        self.assertAlmostEqual(tables.geometric_mean([1, 10, 100]), 10)
        self.assertIsNone(tables.geometric_mean([]))

    def test_text_aligns(self):
        self.assertEqual(tables.text([["", "a"], ["long", "10.0"], None, ["b", "1"]]),
                         "         a\n----------\nlong  10.0\n----------\nb        1\n")

    def test_put_replaces_one_place(self):
        page = self.file("x\n<!-- a -->\nold\n<!-- end of a -->\ny\n")
        for text in ("new\\1\n", "newer\n"):
            tables.put(f"{page}#a", text)
            self.assertEqual(page.read_text(encoding="utf-8"),
                             f"x\n<!-- a -->\n\n{text}\n<!-- end of a -->\ny\n")
        with self.assertRaises(SystemExit):
            tables.put(f"{page}#b", "new")


class Programs(WithFolder):
    def test_status_and_memory(self):
        done = child.run([sys.executable, "-c", "x = bytearray(10**8); print(len(x)); exit(3)"])
        self.assertEqual((done.status, done.output, done.timed_out), (3, "100000000\n", False))
        self.assertTrue(100 < done.peak_mb < 200, done.peak_mb)

    def test_time_limit(self):
        self.assertTrue(child.run(["sleep", "20"], seconds=0.1).timed_out)

    def test_cells_are_measured_again_when_something_changed(self):
        for resume, stamp, fresh, got in ((False, "s", 1, 1), (True, "s", 2, 1), (True, "t", 3, 3),
                                          (False, "t", 4, 4)):
            store = cells.Cells("cells", resume)
            self.assertEqual(store.get("a", stamp, lambda v=fresh: v), got)


@unittest.skipIf(lee_thinning is None, "no scikit-image")
class LeeThinning(unittest.TestCase):
    BOX = np.array([[x, y, z] for x in (0, 4) for y in (0, 2) for z in (0, 1)], float) \
        if lee_thinning else None
    FACES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1),
             (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]

    def test_a_box_is_filled(self):
        for faces in (self.FACES, [f[::-1] for f in self.FACES]):
            solid, _, side = lee_thinning.voxelise(self.BOX, np.array(faces), 64)
            self.assertEqual(solid.sum(), 64 * 32 * 16)
            self.assertEqual(side, 4 / 64)

    def test_overlapping_parts_are_one(self):
        points = np.concatenate([self.BOX, self.BOX + [2, 0, 0]])
        faces = np.concatenate([np.array(self.FACES), np.array(self.FACES) + 8])
        solid, _, _ = lee_thinning.voxelise(points, faces, 60)
        self.assertEqual(solid.sum(), 60 * 20 * 10)

    def test_the_graph_has_no_triangles(self):
        thin = np.zeros((6, 6, 6), bool)
        for voxel in ((1, 1, 1), (2, 1, 1), (2, 2, 1), (3, 3, 2)):
            thin[voxel] = True
        nodes, edges = lee_thinning.graph_of(thin)
        self.assertEqual(len(nodes), 4)
        self.assertEqual(sorted(map(tuple, edges.tolist())), [(0, 1), (1, 2), (2, 3)])


if __name__ == "__main__":
    unittest.main()
