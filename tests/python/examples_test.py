"""The examples in Python against the reader in C++: examples_test.py SOURCE PVS_ANSWERS VEDUTA [FILE]

On a toy city that pvs_answers writes; of a FILE besides, only what can be asked of any file.
"""

import contextlib
import importlib
import io
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

import h5py
import numpy as np

source, pvs_answers, veduta = (Path(argument).resolve() for argument in sys.argv[1:4])
files = [Path(argument).resolve() for argument in sys.argv[4:]]
examples = source / "examples" / "python"
sys.path.insert(0, str(examples))
sys.dont_write_bytecode = True
try:
    plot_cell = importlib.import_module("plot_cell")
except ImportError as error:  # matplotlib: the rest is tested without it
    plot_cell, no_plots = None, str(error)
else:
    no_plots = ""
read_pvs = importlib.import_module("read_pvs")
check_digests = importlib.import_module("check_digests")


def output_of(*command):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout


def run_example(name, *arguments):
    """An example as a user runs it: exit status, what it printed, what it complained of."""
    done = subprocess.run([sys.executable, "-B", str(examples / name), *map(str, arguments)], capture_output=True,
                          text=True, cwd=work)
    return done.returncode, done.stdout, done.stderr


work = Path(tempfile.mkdtemp(prefix="veduta-test-"))
unittest.addModuleCleanup(shutil.rmtree, work)
(work / "run").mkdir()
toy = work / "run" / "city.pvs.h5"
output_of(pvs_answers, "toy", toy)
answers = {path: json.loads(output_of(pvs_answers, "ask", path)) for path in [toy, *files]}


class ReadPvs(unittest.TestCase):
    def test_rows_cells_and_names_are_those_of_the_reader_in_cpp(self):
        for path, answer in answers.items():
            city = read_pvs.Pvs(path)
            self.assertEqual(city.names, answer["names"])
            self.assertEqual(city.crs, answer["crs"])
            self.assertEqual(list(city.origin), answer["origin"])
            self.assertEqual(list(city.status), answer["statuses"])
            self.assertEqual(len(city.cells), len(answer["rows"]))
            for cell, row in enumerate(answer["rows"]):
                objects, index = city.row(cell)
                self.assertEqual([[o, *i] for o, i in zip(objects.tolist(), index.tolist())],
                                 [entry[:4] for entry in row])
            for *point, cell in answer["points"]:
                self.assertEqual(city.find_cell(point), cell, point)

    def test_draws_the_triangles_that_the_reader_in_cpp_draws(self):
        for path, answer in answers.items():
            city = read_pvs.Pvs(path)
            some = range(0, len(answer["rows"]), max(1, len(answer["rows"]) // 20))
            for row in (answer["rows"][cell] for cell in some):
                for obj, x, y, z, drawn, total in row:
                    found = city.drawn(obj, (x, y, z))
                    self.assertEqual((found.sum(), len(found)), (drawn, total), (obj, x, y, z))

    def test_prints_what_a_cell_sees(self):
        row = answers[toy]["rows"][9]
        status, printed, _ = run_example("read_pvs.py", toy, "--at", 95, -45, 2)
        self.assertEqual(status, 0)
        lines = printed.splitlines()
        self.assertEqual(lines[0], f"cell 9, baked: {len(row)} of 60 objects are visible")
        numbers = [[int(number) for number in re.findall(r"-?\d+", line)[:6]] for line in lines[1:]]
        self.assertEqual(numbers, row)
        self.assertIn("road häuser", printed)

    def test_bad_input_is_one_line(self):
        damaged = work / "damaged.h5"
        shutil.copy(toy, damaged)
        with h5py.File(damaged, "r+") as file:
            del file["pvs/form"]
        other = work / "other.h5"
        shutil.copy(toy, other)
        with h5py.File(other, "r+") as file:
            file.attrs.modify("version", np.uint32(3))
        for example in ["read_pvs.py"] + ["plot_cell.py"] * (plot_cell is not None):
            for path, cell, what in ((toy, 50, "cells are 0 to 49"), (toy, -1, "cells are 0 to 49"),
                                     (damaged, 1, "form"), (other, 1, "version 4"), (work, 1, "cannot be read"),
                                     (work / "none.h5", 1, "cannot be read"), (examples / example, 1, "cannot be")):
                status, printed, complaint = run_example(example, path, "--cell", cell)
                self.assertEqual(status, 1, complaint)
                self.assertEqual(complaint.count("\n"), 1, complaint)
                self.assertTrue(complaint.startswith(example + ": ") and what in complaint, complaint)
                self.assertEqual(printed, "")
        status, _, complaint = run_example("read_pvs.py", toy, "--at", 0, 0, 1e9)
        self.assertEqual((status, complaint.count("\n")), (1, 1))
        self.assertIn("no view-cell holds the point", complaint)


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
        for at_once in (everything, 7):  # however it is cut
            plot_cell.TRIANGLES_AT_ONCE = at_once
            corners, owners = plot_cell.footprints(city)
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
        self.assertEqual(len(plot_cell.outlines(corners, owners)), int((2 * city.slices[:-1, 0] + 2).sum()))

    def test_writes_pictures(self):
        for name, begin in (("a.png", b"\x89PNG"), ("a.svg", b"<?xml"), ("a.pdf", b"%PDF")):
            status, _, complaint = run_example("plot_cell.py", toy, "--cell", 3, "-o", name)
            self.assertEqual((status, complaint), (0, ""))
            self.assertTrue((work / name).read_bytes().startswith(begin), name)
        # Of the SVG, that each class has its triangles, in the colours of the shares.
        city = read_pvs.Pvs(toy)
        _, owners = plot_cell.footprints(city)
        share = plot_cell.visible_share(city, 3)[owners]
        land = np.isin(city.kind[owners], plot_cell.LAND)
        groups = {group.get("id"): group for group in xml.etree.ElementTree.parse(work / "a.svg").iter()
                  if group.get("id")}
        for gid, chosen in (("seen", ~land & (share > 0)), ("hidden", ~land & (share == 0)),
                            ("seen-land", land & (share > 0)), ("hidden-land", land & (share == 0))):
            drawn = [style.get("style", "") for style in groups[gid].iter() if style.tag.endswith(("}use", "}path"))]
            drawn = [style for style in drawn if "fill:" in style]
            self.assertEqual(len(drawn), np.count_nonzero(chosen), gid)
            if gid == "seen":
                colors = {plot_cell.matplotlib.colors.to_hex(plot_cell.SHARE(value)) for value in share[chosen]}
                self.assertEqual({re.search("fill: (#[0-9a-f]+)", style)[1] for style in drawn}, colors)
        self.assertIn("cell", groups)

    def test_a_picture_that_cannot_be_written_is_one_line(self):
        for name in ("a.nonsense", "none/a.png"):
            status, printed, complaint = run_example("plot_cell.py", toy, "--cell", 3, "-o", name)
            self.assertEqual((status, printed, complaint.count("\n")), (1, "", 1), complaint)


class CheckDigests(unittest.TestCase):
    def setUp(self):
        try:
            self.xxhash = check_digests.find_xxhash()
        except OSError as error:
            self.skipTest(f"skipped: no XXH3-128 here: {error}; apt-get install libxxhash0")

    def differences(self, path):
        with h5py.File(path) as file:
            return check_digests.differences(self.xxhash, file)[1]

    def test_all_hold(self):
        for path in answers:
            status, printed, complaint = run_example("check_digests.py", path)
            self.assertEqual((status, complaint), (0, ""))
            self.assertIn("datasets hold", printed)

    def test_a_changed_value_is_found(self):
        for path in self.datasets():
            copy = work / "changed.h5"
            shutil.copy(toy, copy)
            with h5py.File(copy, "r+") as file:
                values = file[path][:]
                values.reshape(-1).view(np.uint8)[0] ^= 1
                file[path][...] = values
            found = self.differences(copy)
            self.assertEqual(found[0], "/" + path)
            # Whoever mends the digest of the dataset as well is found by what is taken over the digests.
            with h5py.File(copy, "r+") as file:
                file[path].attrs.modify("digest", np.bytes_(check_digests.dataset_digest(self.xxhash, file[path])))
            over = ["/@content_digest"]
            if path in ("cells/bake_us", "cells/worker", "cells/worker_name"):
                over = []
            elif path.startswith("verification/"):
                over = ["/verification"]
            self.assertEqual(self.differences(copy), over, path)

    def datasets(self):
        paths = []
        with h5py.File(toy) as file:
            file.visititems(lambda name, item: paths.append(name) if isinstance(item, h5py.Dataset) else None)
        self.assertGreater(len(paths), 30)
        return paths

    def test_a_changed_attribute_is_found(self):
        for path, name, value, place in (("/", "crs", np.bytes_(b"EPSG:7416"), "/@header_digest"),
                                         ("/", "complete", np.uint8(1), "/@header_digest"),
                                         ("/navigation/free", "depth", np.uint32(4), "/@content_digest"),
                                         ("/navigation/ground", "step_m", np.float32(3), "/@content_digest"),
                                         ("/verification", "rays_per_cell", np.uint64(1), "/verification")):
            copy = work / "changed.h5"
            shutil.copy(toy, copy)
            with h5py.File(copy, "r+") as file:
                file[path].attrs.modify(name, value)
            self.assertIn(place, self.differences(copy))
        status, _, complaint = run_example("check_digests.py", copy)
        self.assertEqual((status, complaint.count("\n")), (1, 1))
        self.assertIn("/verification: its digest does not hold", complaint)


class Documents(unittest.TestCase):
    def snippet(self, document):
        """The Python of a document, as it stands there."""
        text = (source / document).read_text()
        blocks = re.findall(r"^```python\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)
        self.assertTrue(blocks, document)
        return "\n".join(blocks)

    def run_in_work(self, code):
        names, before = {}, os.getcwd()
        try:
            os.chdir(work)
            with contextlib.redirect_stdout(io.StringIO()):
                exec(code, names)  # pylint: disable=exec-used
        finally:
            os.chdir(before)
        return names

    def test_examples_of_the_documents_read_a_row(self):
        answer = answers[toy]
        for document in ("README.md", "docs/format.md"):
            names = self.run_in_work(self.snippet(document))
            row = answer["rows"][42]
            self.assertEqual([name.decode() for name in names["visible"]], [answer["names"][e[0]] for e in row])
            self.assertEqual(names["index"].tolist(), [e[1:4] for e in row], document)

    def test_info_has_the_figures_of_the_datasets(self):
        for path, answer in answers.items():
            info = json.loads(output_of(veduta, "info", path, "--json"))
            rows = answer["rows"]
            self.assertEqual((info["cells"], info["objects"]), (len(rows), len(answer["names"])))
            self.assertAlmostEqual(info["visible_objects_mean"], sum(map(len, rows)) / len(rows))
            with h5py.File(path) as file:
                stored = {"/" + name: file[name].id.get_storage_size()
                          for name in ["cells/row"] + ["pvs/" + name for name in file["pvs"]]}
            self.assertEqual(info["pvs_bytes_of"], stored)
            self.assertAlmostEqual(info["pvs_bytes_per_cell"], sum(stored.values()) / len(rows))
            self.assertEqual(info["other_codings_bytes_per_cell"]["three_bytes"], 3 * len(answer["names"]))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
