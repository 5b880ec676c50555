#!/usr/bin/env python3
"""Draws what a view-cell sees on a plan of the city: plot_cell.py FILE --cell 42 -o cell.svg

Objects are drawn from above, by their triangles that face upwards. What the cell sees is coloured by the share
of the object's triangles that its three bytes draw. PNG, SVG or PDF, by the name after -o.
"""

import argparse
import sys

import matplotlib
matplotlib.use("Agg")  # no display is needed
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PathCollection
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.patches import Patch, Rectangle
from matplotlib.path import Path

from read_pvs import KINDS, STATUSES, PvsError, Pvs, add_cell_options, chosen_cell

LAND = [KINDS.index(kind) for kind in ("terrain", "road", "water", "vegetation")]
HIDDEN, HIDDEN_LAND, SEEN_LAND, CELL, INK = "#c9c6bf", "#f4f2ec", "#dfe8c8", "#0b4f8a", "#3a3a3a"
SHARE = LinearSegmentedColormap.from_list("share", ["#fbd38d", "#e8713c", "#9b1d20"])
TRIANGLES_AT_ONCE = 1_000_000  # read at a time; only those that face upwards are kept


def visible_share(city, cell):
    """Of each object, the share of its triangles that the cell's row draws: f64 [N]."""
    share = np.zeros(len(city.names))
    for obj, index in zip(*city.row(cell)):
        drawn = city.drawn(obj, index)
        share[obj] = drawn.mean() if len(drawn) else 0
    return share


def footprints(city):
    """Triangles that face upwards, seen from above, of some objects at a time: x, y of their corners f64 [t,3,2], and
    their objects [t], ascending."""
    begin = 0
    while begin < len(city.names):
        # As many whole objects as fit, one at least.
        fit = np.searchsorted(city.triangle_begin, city.triangle_begin[begin] + TRIANGLES_AT_ONCE, side="right") - 1
        end = max(begin + 1, fit)
        which = city.triangles[city.triangle_begin[begin]:city.triangle_begin[end]].astype(np.int64)
        if len(which) > 0:
            first = which.min()
            xy = city.vertices[first:which.max() + 1, :2].astype(np.float64)[which - first]
            a, b = xy[:, 1] - xy[:, 0], xy[:, 2] - xy[:, 0]
            up = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] > 0
            owners = np.repeat(np.arange(begin, end), np.diff(city.triangle_begin[begin:end + 1]))
            yield xy[up], owners[up]
        begin = end


def outlines(corners, owners):
    """Edges that belong to one of an object's triangles only: f64 [e,2,2], and their objects [e], ascending."""
    edges = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    # To the millimetre, and in one direction, so that the two sides of an edge are equal.
    ends = np.round(edges * 1000).astype(np.int64)
    swap = (ends[:, 0, 0] > ends[:, 1, 0]) | ((ends[:, 0, 0] == ends[:, 1, 0]) & (ends[:, 0, 1] > ends[:, 1, 1]))
    ends[swap] = ends[swap, ::-1]
    keys = np.column_stack([np.tile(owners, 3), ends.reshape(-1, 4)])
    keys, first, count = np.unique(keys, axis=0, return_index=True, return_counts=True)
    return edges[first[count == 1]], keys[count == 1, 0]


def paths(pieces, owners, codes):
    """A path for each object of its pieces [n,k,2], each drawn by the codes [k]; and the objects. One path an object
    and not one a triangle: cities have millions of them."""
    begins = np.flatnonzero(np.diff(owners, prepend=-1))
    ends = np.append(begins[1:], len(owners))
    return [Path(pieces[b:e].reshape(-1, 2), np.tile(codes, e - b)) for b, e in zip(begins, ends)], owners[begins]


def nice_length(width):
    """The longest of 1, 2, 5, 10, 20 ... m that is at most a fifth of the width."""
    power = 10.0 ** np.floor(np.log10(width / 5))
    return max(power * digit for digit in (1, 2, 5) if power * digit <= width / 5)


def add_scale_and_north(axes, left, bottom, width):
    """Below the plan."""
    length = nice_length(width)
    axes.plot([left, left + length], [bottom, bottom], color=INK, lw=3, solid_capstyle="butt", clip_on=False)
    axes.annotate(f"{length:g} m", (left + length / 2, bottom), (0, 5), textcoords="offset points", ha="center",
                  color=INK)
    axes.annotate("N", (left + 0.97 * width, bottom), (0, 30), textcoords="offset points", ha="center", color=INK,
                  arrowprops={"arrowstyle": "<|-", "color": INK})


def plot(city, cell):
    share = visible_share(city, cell)
    fills, fill_owners, lines, corner = [], [], [], []
    for corners, owners in footprints(city):
        found, which = paths(corners[:, [0, 1, 2, 0]], owners, [Path.MOVETO, Path.LINETO, Path.LINETO, Path.CLOSEPOLY])
        fills += found
        fill_owners += which.tolist()
        solid = ~np.isin(city.kind[owners], LAND)
        lines += paths(*outlines(corners[solid], owners[solid]), [Path.MOVETO, Path.LINETO])[0]
        corner += [corners.reshape(-1, 2).min(axis=0), corners.reshape(-1, 2).max(axis=0)] if len(corners) else []
    land, seen = np.isin(city.kind[fill_owners], LAND), share[fill_owners] > 0
    figure, axes = plt.subplots(figsize=(10, 8.6), layout="constrained")
    for gid, chosen, colors in (("hidden-land", land & ~seen, HIDDEN_LAND),
                                ("seen-land", land & seen, SEEN_LAND),
                                ("hidden", ~land & ~seen, HIDDEN),
                                ("seen", ~land & seen, SHARE(share[fill_owners][~land & seen]))):
        axes.add_collection(PathCollection([fills[i] for i in np.flatnonzero(chosen)], facecolors=colors,
                                           linewidths=0, gid=gid), autolim=False)
    axes.add_collection(PathCollection(lines, facecolors="none", edgecolors="white", linewidths=0.35), autolim=False)
    lower, upper = city.cells[cell].reshape(2, 3)
    axes.add_patch(Rectangle(lower[:2], *(upper - lower)[:2], fc=CELL, ec="white", lw=1.2, gid="cell", zorder=4))
    corner += [lower[:2], upper[:2]]
    (left, bottom), (right, top) = np.min(corner, axis=0), np.max(corner, axis=0)
    axes.annotate(f"cell {cell}", (lower[:2] + upper[:2]) / 2, (14, 14), textcoords="offset points", color=CELL,
                  weight="bold", zorder=5, bbox={"fc": "white", "ec": "none", "alpha": 0.8, "pad": 1.5})
    strip = 0.07 * (right - left)
    axes.set(xlim=(left, right), ylim=(bottom - strip, top), aspect="equal")
    axes.set_axis_off()
    add_scale_and_north(axes, left, bottom - 0.9 * strip, right - left)
    figure.suptitle(f"{np.count_nonzero(share)} of {len(share)} objects are visible from cell {cell} "
                    f"({STATUSES[city.status[cell]]})", x=0.01, ha="left", color=INK)
    axes.legend([Patch(fc=CELL), Patch(fc=HIDDEN), Patch(fc=SEEN_LAND), Patch(fc=HIDDEN_LAND, ec="#dddddd")],
                ["view-cell", "hidden", "ground, visible in part at least", "ground, hidden"],
                loc="lower right", bbox_to_anchor=(0.96, 0), ncol=4, columnspacing=1.2, frameon=False, labelcolor=INK)
    bar = figure.colorbar(plt.cm.ScalarMappable(cmap=SHARE, norm=plt.Normalize(0, 100)), ax=axes, shrink=0.5,
                          aspect=30, pad=0.01)
    bar.set_label("visible: share of the object's triangles, %", color=INK)
    bar.outline.set_visible(False)
    return figure


def main():
    parser = argparse.ArgumentParser(description="Draws what a view-cell sees on a plan of the city.")
    add_cell_options(parser)
    parser.add_argument("-o", "--out", metavar="OUT", default="cell.png", help="PNG, SVG or PDF; cell.png if left out")
    options = parser.parse_args()
    city = Pvs(options.file)
    plot(city, chosen_cell(city, options)).savefig(options.out, dpi=120)
    print(f"{options.out} is written")


if __name__ == "__main__":
    try:
        main()
    except (PvsError, OSError, ValueError) as error:
        sys.exit(f"plot_cell.py: {str(error).splitlines()[0]}")
