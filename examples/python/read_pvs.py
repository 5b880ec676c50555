#!/usr/bin/env python3
"""Reads city.pvs.h5 with h5py and numpy alone; docs/format.md describes the file.

    import read_pvs
    city = read_pvs.Pvs("run/city.pvs.h5")
    cell = city.find_cell([12.5, -3.0, 1.7])
    objects, index = city.row(cell)
    print([city.names[o] for o in objects])

As a program it prints what a cell sees: read_pvs.py FILE --cell 42, or --at X Y Z.
Lengths are metres, z is up, positions are relative to Pvs.origin. HDF5 compares the checksum of every chunk
that is read; check_digests.py compares the digests of the whole file.
"""

import argparse
import sys

import h5py
import numpy as np

VERSION = 4
KINDS = ["building", "terrain", "road", "water", "vegetation", "bridge", "other"]
STATUSES = ["baked", "coarse", "all visible"]


class PvsError(Exception):
    """One line: the file, and what is wrong with it."""


class Pvs:
    """An open file. In memory: objects, cells and forms; rows and triangles are read when they are asked for."""

    def __init__(self, path):
        try:
            self._read_index(path, h5py.File(path, "r"))
        except KeyError as error:
            raise PvsError(f"{path}: incomplete or another's: {error.args[0]}") from None
        except OSError as error:
            raise PvsError(f"{path}: cannot be read, or is damaged: {str(error).splitlines()[0]}") from None

    def _read_index(self, path, file):
        if file.attrs["format"] != b"veduta-pvs" or file.attrs["version"] != VERSION:
            raise PvsError(f"{path}: not a result of veduta bake of format version {VERSION}")
        self.crs = file.attrs["crs"].decode()
        self.origin = file.attrs["origin"]  # f64[3]
        self.names = [name.decode(errors="replace") for name in file["scene/objects/name"][:]]
        self.kind = file["scene/objects/kind"][:]  # [N] number in KINDS
        self.slices = file["scene/objects/slices"][:]  # [N,3]
        self.triangle_begin = file["scene/objects/triangle_begin"][:].astype(np.int64)  # [N+1]
        self.cells = file["cells/bounds"][:]  # [C,6]
        self.cell_row = file["cells/row"][:]  # [C]
        self.status = file["cells/status"][:]  # [C] number in STATUSES
        self.row_begin = file["pvs/begin"][:].astype(np.int64)  # [R+1]
        self.form_begin = file["pvs/form_begin"][:].astype(np.int64)  # [N+1]
        self.form_index = file["pvs/form_index"][:]  # [F,3]
        # Large, so they stay in the file:
        self.object_step = file["pvs/object_step"]  # [K]
        self.form = file["pvs/form"]  # [K]
        self.triangle_slice = file["scene/triangle_slice"]  # [T,6]
        self.triangles = file["scene/triangles"]  # [T,3]
        self.vertices = file["scene/vertices"]  # [V,3]

    def find_cell(self, point):
        """The lowest cell that holds the point, a closed box; -1: none. Looks at every cell."""
        point = np.asarray(point, np.float32)
        inside = ((self.cells[:, :3] <= point) & (point <= self.cells[:, 3:])).all(axis=1)
        return int(inside.argmax()) if inside.any() else -1

    def row(self, cell):
        """The visible objects of a cell, ascending [k], and the three bytes x, y, z of each [k,3]."""
        begin, end = self.row_begin[self.cell_row[cell]:][:2]
        objects = np.cumsum(self.object_step[begin:end], dtype=np.int64)
        index = self.form_index[self.form_begin[objects] + self.form[begin:end]]
        return objects, index

    def triangle_slices(self, obj):
        """[t,6] first and last slice of each triangle of an object along x, y and z."""
        return self.triangle_slice[self.triangle_begin[obj]:self.triangle_begin[obj + 1]]

    def drawn(self, obj, index):
        """Which triangles of an object are visible, by its three bytes: bool [t]."""
        return draws(index, self.triangle_slices(obj))


def draws(index, slices):
    """Which triangles with these slices [t,6] are visible: bool [t]."""
    x, y, z = (int(byte) for byte in index)
    x_first, x_last, y_first, y_last, _, z_last = slices.T
    drawn = np.zeros(len(slices), bool)
    if z >= 1:
        drawn |= z_last >= z
    if x > 0:
        drawn |= x_first <= x
    if x < 0:
        drawn |= x_last >= -x + 1
    if y > 0:
        drawn |= y_first <= y
    if y < 0:
        drawn |= y_last >= -y + 1
    return drawn


def add_cell_options(parser):
    """FILE, and --cell or --at."""
    parser.add_argument("file", metavar="FILE", help="city.pvs.h5")
    which = parser.add_mutually_exclusive_group(required=True)
    which.add_argument("--cell", type=int, metavar="N", help="number of a view-cell, from 0 on")
    which.add_argument("--at", type=float, nargs=3, metavar=("X", "Y", "Z"),
                       help="a point of the cell, m, relative to the file's origin")


def chosen_cell(city, options):
    """The cell that was asked for, or PvsError."""
    if options.at is not None:
        cell = city.find_cell(options.at)
        if cell < 0:
            raise PvsError(f"{options.file}: no view-cell holds the point {options.at}")
        return cell
    if not 0 <= options.cell < len(city.cells):
        raise PvsError(f"{options.file}: there is no cell {options.cell}; cells are 0 to {len(city.cells) - 1}")
    return options.cell


def main():
    parser = argparse.ArgumentParser(description="Prints what can be seen from a view-cell.")
    add_cell_options(parser)
    options = parser.parse_args()
    city = Pvs(options.file)
    cell = chosen_cell(city, options)
    objects, index = city.row(cell)
    print(f"cell {cell}, {STATUSES[city.status[cell]]}: {len(objects)} of {len(city.names)} objects are visible")
    for obj, (x, y, z) in zip(objects, index):
        drawn = city.drawn(obj, (x, y, z))
        print(f"{obj:8} {x:4} {y:4} {z:4}  {drawn.sum()} of {len(drawn)} triangles  "
              f"{KINDS[city.kind[obj]]} {city.names[obj]}")


if __name__ == "__main__":
    try:
        main()
    except (PvsError, OSError) as error:
        sys.exit(f"read_pvs.py: {str(error).splitlines()[0]}")
