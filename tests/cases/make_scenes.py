#!/usr/bin/env python3
"""Writes the scenes (OBJ) of the hard cases beside this file: boxes and prisms, a few lines each.

The scenes are kept; this is how they were made, and how to make another. What a case is about is in its case.toml.
"""
import math
import os


class Scene:
    """Objects of polygons, with indices that count back from the last vertex: every polygon stands for itself."""

    def __init__(self, name, place=lambda p: p, digits=6):
        self.name, self.place, self.digits, self.lines = name, place, digits, []

    def begin(self, name):
        self.lines.append(f"o {name}")

    def vertices(self, points):
        for p in points:
            self.lines.append("v " + " ".join(f"{c:.{self.digits}f}".rstrip("0").rstrip(".") for c in self.place(p)))

    def face(self, *points):
        self.vertices(points)
        self.lines.append("f " + " ".join(str(n - len(points)) for n in range(len(points))))

    def prism(self, outline, z0, z1, faces=None, inward=False):
        """Over a convex outline, counter-clockwise; faces: which sides by number, -1 the floor, -2 the lid."""
        n = len(outline)
        self.vertices([(x, y, z0) for x, y in outline] + [(x, y, z1) for x, y in outline])
        polygons = {i: [i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)}
        polygons[-1] = list(range(n))[::-1]
        polygons[-2] = list(range(n, 2 * n))
        for number, corners in polygons.items():
            if faces is None or number in faces:
                self.lines.append("f " + " ".join(str(c - 2 * n) for c in (corners[::-1] if inward else corners)))

    def box(self, lower, upper, **how):
        """Sides are numbered south, east, north, west."""
        (x0, y0, z0), (x1, y1, z1) = lower, upper
        self.prism([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], z0, z1, **how)

    def add(self, name, lower, upper, **how):
        self.begin(name)
        self.box(lower, upper, **how)

    def ground(self, half=60):
        self.add("ground", (-half, -half, -1), (half, half, 0))

    def write(self):
        folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), self.name)
        os.makedirs(folder, exist_ok=True)
        with open(os.path.join(folder, "city.obj"), "w") as file:
            file.write("\n".join(self.lines) + "\n")


def storeys(s):
    """A tower that is seen from its 45th metre on: the three bytes can tell."""
    s.begin("tower")
    for n in range(20):
        s.box((40, -5, 3 * n), (50, 5, 3 * n + 3), faces=(0, 1, 2, 3) + ((-1,) if n == 0 else (-2,) if n == 19 else ()))


def row(s):
    """A wall with something low and something high behind it, and something before it."""
    s.add("wall", (10, -40, 0), (20, 40, 12))
    s.add("behind", (30, -3, 0), (36, 3, 3))
    storeys(s)
    s.add("before", (7, -6, 0), (8, -5, 2))


def turned(degrees):
    c, d = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return lambda p: (c * p[0] - d * p[1], d * p[0] + c * p[1], p[2])


def numbers():
    s = Scene("far_coordinates", lambda p: (p[0] + 1e7 + 0.3, p[1] - 1e7 - 0.7, p[2] + 4000.1))
    s.ground(), row(s), s.add("slit_wall", (30, 10, 0), (30.3, 30, 2)), s.write()

    s = Scene("one_millimetre", lambda p: tuple(1e-3 * c for c in p), digits=9)
    s.add("plate", (-0.5, -0.5, 0), (0.5, 0.5, 0.1)), s.add("die", (-0.2, -0.2, 0.1), (0.2, 0.2, 0.4))
    s.add("speck", (0.3, 0.3, 0.1), (0.301, 0.301, 0.101)), s.write()

    s = Scene("city_of_one_millimetre", lambda p: tuple(1e-5 * c for c in p), digits=10)
    s.ground(50), row(s), s.write()

    s = Scene("hundred_kilometres")  # a strip of 100 x 2 km
    s.add("ground", (-50000, -600, -500), (50000, 600, 0)), s.add("range", (10000, -500, 0), (14000, 500, 1200))
    s.add("behind", (20000, -200, 0), (22000, 200, 200)), s.add("peak", (48000, -400, 0), (49000, 400, 6000))
    s.add("hut", (1000, 100, 0), (1060, 160, 50)), s.add("mast", (-48000, -400, 0), (-47999, -399, 900)), s.write()


def triangles():
    s = Scene("slivers")
    s.ground(), s.begin("wall")
    # Sides towards the cell and away from it: fans of 120 triangles from a corner, and strips a centimetre wide.
    for x, side in ((10, 1), (20, -1)):
        ys = [-40 + 80 * n / 120 for n in range(121)]
        for a, b in zip(ys, ys[1:]):
            s.face(*[(x, -40, 0), (x, a, 12), (x, b, 12)][::-side])
        s.face(*[(x, -40, 0), (x, 40, 12), (x, 40, 0)][::-side])
    for n in range(40):
        y = -40 + n * 0.01
        s.face((10, y, 12), (20, y, 12), (20, y + 0.01, 12)), s.face((10, y, 12), (20, y + 0.01, 12), (10, y + 0.01, 12))
    s.face((10, -39.6, 12), (20, -39.6, 12), (20, 40, 12), (10, 40, 12))
    s.box((10, -40, 0), (20, 40, 12), faces=(0, 2, -1))
    s.add("behind", (30, -3, 0), (36, 3, 3)), storeys(s)
    s.begin("needle"), s.face((6, -3, 0), (6.0005, -3, 0), (6, -3, 30))
    s.write()

    s = Scene("zero_area_triangles")
    s.ground(), row(s)
    for p in ((7, 0, 1), (10, 0, 3), (2, 2, 1.7)):
        s.begin("nothing"), s.face(p, p, p), s.face(p, (p[0], p[1] + 4, p[2]), p)
        s.face(p, (p[0] + 1, p[1] + 1, p[2]), (p[0] + 2, p[1] + 2, p[2]))
    s.begin("partly"), s.face((6, 4, 0), (6, 5, 0), (6, 6, 0)), s.box((6, 4, 0), (7, 5, 1.5))
    s.write()

    s = Scene("duplicate_triangles")
    s.ground(), row(s)
    s.begin("twice"), s.box((4, 6, 0), (6, 8, 3)), s.box((4, 6, 0), (6, 8, 3)), s.box((4, 6, 0), (6, 8, 3), inward=True)
    s.add("copy", (4, 6, 0), (6, 8, 3)), s.add("wall_again", (10, -40, 0), (20, 40, 12)), s.write()

    s = Scene("coplanar_walls")
    s.ground(), row(s)
    s.add("over", (10, -8, 0), (16, 2, 15)), s.add("poster", (9, 3, 0), (10, 7, 4), faces=(1,))
    s.begin("sheet"), s.face((10, -4, 2), (10, -9, 2), (10, -6.5, 9)), s.add("floor", (4, -9, -0.5), (9, -8, 0)), s.write()

    s = Scene("t_junctions", turned(30))
    s.ground(), s.begin("wall")
    # One side of one panel, whose neighbours end within its edges.
    s.face((10, 0, 0), (10, -40, 0), (10, -40, 12), (10, 0, 12))
    heights = [0, 1.1, 2.7, 3.1, 7.3, 12]
    for a, b in zip(heights, heights[1:]):
        s.face((10, 13.7, a), (10, 0, a), (10, 0, b), (10, 13.7, b))
    s.face((10, 40, 0), (10, 13.7, 0), (10, 13.7, 12), (10, 40, 12))
    s.box((10, -40, 0), (20, 40, 12), faces=(0, 1, 2, -1, -2))
    s.add("behind", (30, -3, 0), (36, 3, 3)), storeys(s), s.write()

    s = Scene("non_manifold_edges")
    s.ground(), row(s), s.begin("touching"), s.box((4, 5, 0), (6, 7, 4)), s.box((6, 7, 0), (8, 9, 4))
    s.begin("fins")
    for x, y in ((3, -8), (5, -8), (4, -6), (4, -10)):
        s.face((4, -8, 0), (x, y, 0), (x, y, 3), (4, -8, 3))
    s.begin("house"), s.box((-4, 8, 0), (2, 14, 4)), s.face((-4, 8, 4), (2, 14, 4), (-1, 11, 9)), s.write()

    s = Scene("inverted_normals")
    s.ground(), s.add("wall", (10, -40, 0), (20, 40, 12), inward=True), s.add("behind", (30, -3, 0), (36, 3, 3), inward=True)
    s.begin("tower"), s.box((40, -5, 0), (50, 5, 60), faces=(0, 3)), s.box((40, -5, 0), (50, 5, 60), faces=(1, 2, -1, -2), inward=True)
    s.add("before", (7, -6, 0), (8, -5, 2), inward=True), s.write()

    s = Scene("open_box")
    s.ground(), s.add("stage", (8, -8, 0), (20, 8, 10), faces=(0, 1, 2, -1, -2)), s.add("actor", (14, -1, 0), (15, 1, 2))
    s.add("backdrop", (26, -4, 0), (30, 4, 4)), s.add("well", (-9, -9, 0), (-5, -5, 4), faces=(0, 1, 2, 3))
    s.add("high_in_well", (-7.2, -7.2, 0), (-6.8, -6.8, 9)), s.add("wall", (32, -40, 0), (42, 40, 12))
    s.add("behind", (48, -3, 0), (52, 3, 2)), s.write()

    s = Scene("one_triangle")
    s.begin("one"), s.face((0, 0, 0), (20, 0, 0), (0, 20, 6)), s.write()

    s = Scene("empty_objects")
    s.begin("before_all"), s.ground(), s.begin("nothing"), s.begin("points"), s.vertices([(3, 3, 1), (4, 4, 1)])
    s.lines += ["p -1 -2", "o line", "l -1 -2", "g no_faces"], row(s), s.begin("after_all"), s.write()


def walls():
    s = Scene("building_inside_another")
    s.ground(), s.add("outer", (12, -10, 0), (26, 10, 10)), s.add("inner", (15, -3, 1), (20, 3, 8))
    s.add("touching_inside", (22, 4, 0), (26, 7, 5)), s.add("chimney", (21, 2, 2), (22, 3, 30)), s.write()

    s = Scene("cell_touches_wall")
    s.ground(), s.add("wall", (4, -40, 0), (14, 40, 12)), s.add("behind", (20, 20, 0), (26, 23, 3))
    s.add("tower", (20, -5, 0), (30, 5, 100)), s.add("step", (3.5, 1, 0), (4, 3, 1)), s.write()

    s = Scene("cell_cut_by_wall")
    s.ground(), s.add("wall", (2, -30, 0), (2.4, 30, 10)), s.add("slanting", (-0.2, 6, 0), (2, 6.2, 10))
    s.add("near_east", (12, 1, 0), (13, 2, 2)), s.add("near_west", (-6, 1, 0), (-5, 2, 2))
    s.add("east", (20, -30, 0), (30, 30, 12)), s.add("west", (-30, -30, 0), (-20, 30, 12))
    s.add("behind_east", (36, -4, 0), (40, 4, 4)), s.add("behind_west", (-40, -4, 0), (-36, 4, 4)), s.write()

    s = Scene("cell_in_courtyard")
    s.ground(), s.add("west", (-26, -26, 0), (-12, 26, 9)), s.add("east", (12, -26, 0), (26, 26, 9))
    s.add("south", (-12, -26, 0), (12, -12, 9)), s.add("north", (-12, 12, 0), (12, 26, 9))
    s.add("outside", (40, -2, 0), (46, 4, 4)), s.add("spire", (34, 34, 0), (40, 40, 50)), s.write()

    s = Scene("cell_in_arcade")
    s.ground(), s.begin("arcade"), s.box((-16, -2.5, 4), (16, 6, 10)), s.box((-16, 6, 0), (16, 16, 10))
    for n in range(11):
        s.box((-16 + 3.1 * n, -2.5, 0), (-15.4 + 3.1 * n, -2, 4))
    s.add("opposite", (-6, -20, 0), (6, -14, 6)), s.add("at_the_end", (24, 0, 0), (28, 4, 3))
    s.add("behind", (-4, 22, 0), (4, 26, 4)), s.add("on_roof", (-2, -1, 10), (2, 3, 12)), s.write()

    s = Scene("wall_thinner_than_cell")
    s.ground(), s.add("wall", (16, -40, 0), (18, 40, 10)), s.add("behind_wall", (24, -4, 1), (28, 4, 3))
    s.add("thin", (-16, -40, 0), (-15.7, 40, 10)), s.add("behind_thin", (-28, -4, 0), (-24, 4, 3))
    s.add("high", (24, 8, 0), (28, 12, 30)), s.write()

    s = Scene("overhanging_roof")
    s.ground(), s.begin("canopy"), s.box((-16, -16, 4), (12, 16, 9)), s.box((-16, -16, 0), (-14, -14, 4))
    s.box((-16, 14, 0), (-14, 16, 4)), s.add("on_top", (-3, -3, 9), (1, 1, 11)), s.add("under", (8, 8, 0), (8.5, 8.5, 3))
    s.add("beyond", (30, -3, 0), (34, 3, 6)), s.add("wall", (-40, -40, 0), (-28, 40, 10))
    s.add("behind_wall", (-50, -4, 0), (-46, 4, 3)), s.write()


    s = Scene("cell_on_an_alley")
    s.ground(), s.add("west", (-20, -20, 0), (0.72, 20, 10)), s.add("between", (1.32, -20, 0), (5.5, 20, 10))
    s.begin("court"), s.box((10, -20, 0), (20, 20, 10)), s.box((5.5, -20, 0), (10, -6, 10)), s.box((5.5, 10, 0), (10, 20, 10))
    s.add("alley_end", (-1, 30, 0), (3, 32, 4)), s.add("beside", (30, -3, 0), (32, 3, 3)), s.write()


def gaps():
    s = Scene("slit_of_half_a_pixel")  # at 80 m a pixel is 2.5 m wide
    s.add("ground", (-4, -24, -8), (116, 24, 0)), s.add("south", (80, -24, 0), (92, 0.85, 12))
    s.add("north", (80, 2.1, 0), (92, 24, 12)), s.add("behind_slit", (98, -1, 0), (102, 4, 8))
    s.add("behind_wall", (98, -16, 0), (102, -12, 2)), s.write()

    for name, width, offset in (("slit_of_a_seed", 0.25, 0.1), ("slit_of_two_seeds", 0.25, 0.031)):
        s = Scene(name)
        s.ground(), s.add("south", (10, -40, 0), (20, offset, 12)), s.add("north", (10, offset + width, 0), (20, 40, 12))
        s.add("behind_slit", (30, -3, 0), (36, 3, 3)), s.add("behind_wall", (24, -30, 0), (28, -26, 3)), s.write()

    s = Scene("fence_of_thin_pillars")
    s.ground(), s.begin("fence")
    for n in range(60):
        s.box((10, -15 + 0.5 * n, 0), (10.15, -14.8 + 0.5 * n, 6))
    s.add("behind_fence", (14, 0, 0), (14.5, 0.5, 2)), s.add("wall", (20, -40, 0), (30, 40, 10))
    s.add("behind_wall", (36, -4, 0), (40, 4, 3)), s.write()


def occludees():
    s = Scene("spikes")
    s.ground(), s.begin("wall"), s.box((10, -40, 0), (20, 40, 8))
    for n in range(-20, 20):  # teeth: pyramids of 40 times the height of their base
        x, y = 15, 2 * n
        base = [(x - 0.25, y - 0.1, 8), (x + 0.25, y - 0.1, 8), (x + 0.25, y + 0.1, 8), (x - 0.25, y + 0.1, 8)]
        for a, b in zip(base, base[1:] + base[:1]):
            s.face(a, b, (x, y, 16))
    s.begin("blade"), s.prism([(5, -9), (12, -9.05), (12, -8.95)], 0, 6), s.prism([(5, 7), (5, 6.9), (10, 6.95)], 0, 6)
    s.begin("star")
    for n in range(8):
        a, w = math.radians(45 * n + 10), 0.1
        s.prism([(-8 - w * math.sin(a), w * math.cos(a)), (-8 + w * math.sin(a), -w * math.cos(a)),
                 (-8 + 5 * math.cos(a), 5 * math.sin(a))], 0, 5)
    s.add("behind", (30, -3, 0), (36, 3, 3)), storeys(s), s.write()

    s = Scene("occludee_behind_its_own_wall")
    s.ground(), s.begin("house"), s.box((12, -20, 0), (22, 20, 12)), s.box((22, -10, 0), (34, 10, 3))
    s.add("outer", (-30, -10, 0), (-12, 10, 12)), s.add("inner", (-24, -3, 1), (-18, 3, 4)), s.write()

    s = Scene("occludee_thinner_than_cell")
    s.ground(), s.add("wall", (12, -20, 0), (22, 20, 10)), s.add("pole_hidden", (30, 0, 0), (30.1, 0.1, 4))
    s.add("wire_hidden", (30, -8, 2), (30.05, 8, 2.05)), s.add("pole_before", (8, 0, 0), (8.1, 0.1, 4))
    s.add("pole_high", (30, 4, 0), (30.1, 4.1, 40)), s.add("wire_past_the_end", (24, 2, 2), (24.05, 56, 2.05))
    for n in range(10):
        s.add(f"pole_penumbra_{n}", (30, 28 + 3 * n, 0), (30.1, 28.1 + 3 * n, 4))
    s.write()

    s = Scene("across_cube_face_edges")
    s.ground(), s.add("east", (12, -40, 0), (22, 22, 12)), s.add("north", (-40, 12, 0), (12, 22, 12))
    s.add("low_at_edge", (26, 26, 0), (32, 32, 4)), s.add("tower_at_corner", (24, 24, 0), (30, 30, 50))
    s.add("arm", (-30, 26, 0), (20, 30, 5)), s.add("slab", (-30, -30, 9), (8, 6, 15))
    s.add("on_slab", (-14, -14, 15), (-10, -10, 16)), s.add("west", (-40, -40, 0), (-30, 12, 12)), s.write()

    s = Scene("at_near_plane")
    s.ground(40), s.add("wall", (4, -30, 0), (12, 30, 10)), s.add("pillar", (1.9, 1.9, 0), (2.1, 2.1, 3))
    s.add("plate", (3.97, 1, 0.5), (3.99, 3, 2.5)), s.add("plaque", (0, 1, 1.69), (0.01, 1.01, 1.71))
    s.add("behind", (16, -2, 0), (20, 2, 3)), s.write()

    s = Scene("on_far_ring")
    s.add("ground", (-4, -24, -6), (420, 24, 0)), s.add("across", (250, -20, 0), (274, 8, 20))
    s.add("along", (4, 12, 0), (400, 20, 9)), s.add("behind", (300, -10, 0), (301, -8, 1))
    s.add("beside", (300, 8.5, 0), (301, 9, 3)), s.add("mast", (300, -4, 0), (300.2, -3.8, 60))
    s.add("behind_along", (200, 21, 0), (201, 22, 1)), s.add("last", (410, -4, 0), (416, 4, 50)), s.write()


if __name__ == "__main__":
    numbers(), triangles(), walls(), gaps(), occludees()
