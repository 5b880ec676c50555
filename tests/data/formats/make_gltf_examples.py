#!/usr/bin/env python3
"""Writes instances.gltf, toy.glb and tiles/ beside itself: the same kind of toy city in three ways.

Python's standard library only, and none of Veduta's code. Positions are glTF's: metres, y up.
"""
import base64
import json
import pathlib
import struct

HERE = pathlib.Path(__file__).parent
FLOAT, USHORT, UBYTE = 5126, 5123, 5121


class Document:
    """A glTF document with one buffer."""

    def __init__(self):
        self.data = b""
        self.json = {"asset": {"version": "2.0", "generator": "make_gltf_examples.py"}, "scene": 0,
                     "bufferViews": [], "accessors": [], "meshes": [], "nodes": [], "materials": []}

    def accessor(self, code, component_type, kind, values, **more):
        """values: flat; returns the accessor's index."""
        width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[kind]
        packed = struct.pack("<%d%s" % (len(values), code), *values)
        self.data += b"\0" * (-len(self.data) % 4)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(packed)})
        self.data += packed
        self.json["accessors"].append({"bufferView": len(self.json["bufferViews"]) - 1, "type": kind,
                                       "componentType": component_type, "count": len(values) // width, **more})
        return len(self.json["accessors"]) - 1

    def mesh(self, name, triangles, ids=None, material=None):
        """triangles: list of three points each; ids: one for each triangle."""
        points = sorted({(p, i) for t, i in zip(triangles, ids or [0] * len(triangles)) for p in t})
        number = {key: n for n, key in enumerate(points)}
        indices = [number[p, i] for t, i in zip(triangles, ids or [0] * len(triangles)) for p in t]
        xyz = [c for p, _ in points for c in p]
        attributes = {"POSITION": self.accessor("f", FLOAT, "VEC3", xyz, min=[min(xyz[a::3]) for a in range(3)],
                                                max=[max(xyz[a::3]) for a in range(3)])}
        if ids:
            attributes["_BATCHID"] = self.accessor("f", FLOAT, "SCALAR", [i for _, i in points])
        primitive = {"attributes": attributes, "indices": self.accessor("H", USHORT, "SCALAR", indices)}
        if material:
            self.json["materials"].append({"name": material})
            primitive["material"] = len(self.json["materials"]) - 1
        self.json["meshes"].append({"name": name, "primitives": [primitive]})
        return len(self.json["meshes"]) - 1

    def node(self, **properties):
        self.json["nodes"].append(properties)
        return len(self.json["nodes"]) - 1

    def finish(self, roots):
        self.json["scenes"] = [{"nodes": roots}]
        self.json["buffers"] = [{"byteLength": len(self.data)}]
        if not self.json["materials"]:
            del self.json["materials"]

    def gltf(self):
        self.json["buffers"][0]["uri"] = ("data:application/octet-stream;base64," +
                                          base64.b64encode(self.data).decode())
        return json.dumps(self.json, indent=1)

    def glb(self):
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        data = self.data + b"\0" * (-len(self.data) % 4)
        return (struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(data), len(text), 0x4E4F534A) + text +
                struct.pack("<II", len(data), 0x004E4942) + data)


def quad(a, b, c, d):
    return [(a, b, c), (a, c, d)]


def house(x, z, width, depth, height, gable=0):
    """Footprint [x, x+width] x [z, z+depth] on y = 0; a ridge along x when gable > 0. Faces point outwards."""
    x1, z1, h, m = x + width, z + depth, height, z + depth / 2
    top = h + gable
    faces = quad((x, 0, z1), (x1, 0, z1), (x1, h, z1), (x, h, z1))       # south
    faces += quad((x1, 0, z), (x, 0, z), (x, h, z), (x1, h, z))          # north
    faces += quad((x1, 0, z1), (x1, 0, z), (x1, h, z), (x1, h, z1))      # east
    faces += quad((x, 0, z), (x, 0, z1), (x, h, z1), (x, h, z))          # west
    if gable:
        faces += quad((x, h, z1), (x1, h, z1), (x1, top, m), (x, top, m))
        faces += quad((x1, h, z), (x, h, z), (x, top, m), (x1, top, m))
        faces += [((x1, h, z1), (x1, h, z), (x1, top, m)), ((x, h, z), (x, h, z1), (x, top, m))]
    else:
        faces += quad((x, h, z1), (x1, h, z1), (x1, h, z), (x, h, z))
    return faces


GROUND = quad((-30, 0, 30), (30, 0, 30), (30, 0, -30), (-30, 0, -30))
# x, z, width, depth, height, gable of six houses with streets of 8 m and more
HOUSES = [(-24, -20, 8, 10, 9, 0), (-6, -20, 10, 8, 6, 2), (14, -20, 8, 8, 12, 0),
          (-24, 6, 10, 8, 5, 2), (-4, 6, 6, 10, 10, 0), (14, 8, 8, 8, 4, 3)]


def instances():
    """Six nodes of one house: turned, scaled, mirrored; two of them by EXT_mesh_gpu_instancing."""
    doc = Document()
    cottage = doc.mesh("cottage", house(-4, -3, 8, 6, 5, 2))
    ground = doc.node(name="ground", mesh=doc.mesh("plane", GROUND, material="terrain"))
    half = 0.5 ** 0.5
    homes = [doc.node(name="west", mesh=cottage, translation=[-20, 0, -16]),
             doc.node(name="tower", mesh=cottage, translation=[0, 0, -16], scale=[1, 1.5, 1.25]),
             doc.node(name="turned", mesh=cottage, translation=[20, 0, -16], rotation=[0, half, 0, half]),
             doc.node(name="mirrored", mesh=cottage, matrix=[-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -20, 0, 14, 1])]
    row = doc.node(name="row", mesh=cottage, extensions={"EXT_mesh_gpu_instancing": {"attributes": {
        "TRANSLATION": doc.accessor("f", FLOAT, "VEC3", [0, 0, 14, 20, 0, 14])}}})
    doc.json["extensionsUsed"] = doc.json["extensionsRequired"] = ["EXT_mesh_gpu_instancing"]
    doc.finish([ground, doc.node(name="village", children=homes + [row])])
    (HERE / "instances.gltf").write_text(doc.gltf() + "\n")


def city(ids, houses):
    triangles = [house(*h) for h in houses]
    return [t for h in triangles for t in h], [i for i, h in zip(ids, triangles) for _ in h]


def toy():
    """One node whose mesh holds six houses, told apart by batch ids, beside the ground."""
    doc = Document()
    ground = doc.node(name="ground", mesh=doc.mesh("plane", GROUND, material="terrain"))
    doc.finish([ground, doc.node(name="house", mesh=doc.mesh("houses", *city(range(6), HOUSES)))])
    (HERE / "toy.glb").write_bytes(doc.glb())


def b3dm(names, triangles, ids):
    doc = Document()
    doc.finish([doc.node(mesh=doc.mesh("", triangles, ids))])
    features = json.dumps({"BATCH_LENGTH": len(names), "RTC_CENTER": [0, 0, 200]}).encode()
    features += b" " * (-(28 + len(features)) % 8)
    batches = json.dumps({"id": names}).encode()
    batches += b" " * (-len(batches) % 8)
    glb = doc.glb()
    glb += b"\0" * (-len(glb) % 8)
    size = 28 + len(features) + len(batches) + len(glb)
    return struct.pack("<4s6I", b"b3dm", 1, size, len(features), 0, len(batches), 0) + features + batches + glb


def tiles():
    """A ground tile that others are added to; a block (level 1) that gives way to six houses (level 2)."""
    folder = HERE / "tiles"
    folder.mkdir(exist_ok=True)
    (folder / "ground.b3dm").write_bytes(b3dm(["terrain_0"], GROUND, [0] * len(GROUND)))
    blocks = [(h[0], h[1], h[2], h[3], h[4] + h[5], 0) for h in HOUSES]
    (folder / "coarse.b3dm").write_bytes(b3dm(["block_%d" % i for i in range(6)], *city(range(6), blocks)))
    (folder / "fine.b3dm").write_bytes(b3dm(["house_%d" % i for i in range(6)], *city(range(6), HOUSES)))
    box = {"box": [0, 0, 206, 30, 0, 0, 0, 30, 0, 0, 0, 6]}
    tileset = {"asset": {"version": "1.0"}, "geometricError": 100, "root": {
        "boundingVolume": box, "geometricError": 50, "refine": "ADD", "content": {"uri": "ground.b3dm"},
        "transform": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1842000, 5174000, 0, 1],
        "children": [{"boundingVolume": box, "geometricError": 5, "refine": "REPLACE",
                      "content": {"uri": "coarse.b3dm"},
                      "children": [{"boundingVolume": box, "geometricError": 0,
                                    "content": {"uri": "fine.b3dm"}}]}]}}
    (folder / "tileset.json").write_text(json.dumps(tileset, indent=1) + "\n")


instances()
toy()
tiles()
