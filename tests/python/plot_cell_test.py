"""examples/python/plot_cell.py against the reader in C++, and its pictures."""

import re
import unittest
import xml.etree.ElementTree

import h5py
import numpy as np

from toy import answers, run_example, toy, work
import read_pvs
try:
    import plot_cell
    no_plots = ""
except ImportError as error:
    plot_cell, no_plots = None, str(error)


@unittest.skipIf(plot_cell is None, f"skipped: no plots here: {no_plots}; apt-get install python3-matplotlib")
class PlotCell(unittest.TestCase):
    def test_shares_are_those_of_the_reader_in_cpp(self):
        for path, answer in answers.items():
            city = read_pvs.Pvs(path)
            expected = np.zeros(len(city.names))
            for obj, _, _, _, drawn, total in answer["rows"][7]:
                expected[obj] = drawn / total if total else 0
            np.testing.assert_array_equal(plot_cell.visible_share(city, 7), expected)

    def test_footprints_are_roofs(self):
        city = read_pvs.Pvs(toy)
        everything = plot_cell.TRIANGLES_AT_ONCE
        for at_once in (everything, 100, 1):  # however many objects are read at a time
            plot_cell.TRIANGLES_AT_ONCE = at_once
            corners, owners = (np.concatenate(parts) for parts in zip(*plot_cell.footprints(city)))
            plot_cell.TRIANGLES_AT_ONCE = everything
            # A roof has two triangles an x-slice; the last object is empty.
            self.assertEqual(np.bincount(owners).tolist(), (2 * city.slices[:-1, 0].astype(int)).tolist())
            with h5py.File(toy) as file:
                bounds = file["scene/objects/bounds"][:]
            for obj in range(59):
                mine = corners[owners == obj].reshape(-1, 2)
                np.testing.assert_array_equal(mine.min(axis=0), bounds[obj, 0:2])
                np.testing.assert_allclose(mine.max(axis=0), bounds[obj, 3:5], rtol=1e-6)
        # Round every roof there are two edges a slice, and the two ends; none inside.
        edges, owners = plot_cell.outlines(corners, owners)
        self.assertEqual(edges.shape, (len(owners), 2, 2))
        self.assertEqual(np.bincount(owners).tolist(), (2 * city.slices[:-1, 0].astype(int) + 2).tolist())

    def test_writes_pictures(self):
        for name, begin in (("a.png", b"\x89PNG"), ("a.svg", b"<?xml"), ("a.pdf", b"%PDF")):
            status, _, complaint = run_example("plot_cell.py", toy, "--cell", 3, "-o", name)
            self.assertEqual((status, complaint), (0, ""))
            self.assertTrue((work / name).read_bytes().startswith(begin), name)
        # Of the SVG, that each class has its objects, in the colours of the shares. The last object is empty.
        city = read_pvs.Pvs(toy)
        share = plot_cell.visible_share(city, 3)[:-1]
        land = np.isin(city.kind[:-1], plot_cell.LAND)
        groups = {group.get("id"): group for group in xml.etree.ElementTree.parse(work / "a.svg").iter()
                  if group.get("id")}
        for gid, chosen in (("seen", ~land & (share > 0)), ("hidden", ~land & (share == 0)),
                            ("seen-land", land & (share > 0)), ("hidden-land", land & (share == 0))):
            drawn = [style.get("style", "") for style in groups[gid].iter() if style.tag.endswith(("}use", "}path"))]
            drawn = [re.search("fill: (#[0-9a-f]+)", style)[1] for style in drawn if "fill:" in style]
            self.assertGreater(len(drawn), 0)
            self.assertEqual(len(drawn), np.count_nonzero(chosen), gid)
            if gid == "seen":
                colors = [plot_cell.matplotlib.colors.to_hex(plot_cell.SHARE(value)) for value in share[chosen]]
                self.assertEqual(sorted(drawn), sorted(colors))
        self.assertIn("cell", groups)

    def test_a_cell_that_sees_nothing_has_a_picture(self):
        city = read_pvs.Pvs(toy)
        city.row = lambda cell: (np.empty(0, np.int64), np.empty((0, 3), np.int8))
        plot_cell.plot(city, 3).savefig(work / "nothing.png")
        self.assertEqual((work / "nothing.png").read_bytes()[:4], b"\x89PNG")

    def test_a_picture_that_cannot_be_written_is_one_line(self):
        for name in ("a.nonsense", "none/a.png"):
            status, printed, complaint = run_example("plot_cell.py", toy, "--cell", 3, "-o", name)
            self.assertEqual((status, printed, complaint.count("\n")), (1, "", 1), complaint)
