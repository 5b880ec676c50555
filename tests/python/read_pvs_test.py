"""examples/python/read_pvs.py against the reader in C++."""

import re
import shutil
import unittest

import h5py
import numpy as np

from toy import answers, examples, run_example, toy, work
import read_pvs
try:
    import matplotlib
    have_plots = matplotlib is not None
except ImportError:
    have_plots = False


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
        for example in ("read_pvs.py", "plot_cell.py") if have_plots else ("read_pvs.py",):
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
