#!/usr/bin/env python3
"""Compares every digest of city.pvs.h5 with what it is about, by the rules of docs/format.md: check_digests.py FILE

XXH3-128 comes from the module xxhash (python3-xxhash) or, without it, from libxxhash.so.0 (libxxhash0).
Exit status 0: all hold; 1: some do not, and each is named; 2: there is no XXH3-128 here.
"""

import argparse
import ctypes
import struct
import sys

import h5py
import numpy as np

# What differs from bake to bake of the same content.
NOT_CONTENT = ("/cells/bake_us", "/cells/worker", "/cells/worker_name")
BLOCK_BYTES = 1 << 24


class LibXxhash:
    """The part of the module xxhash that is used here, from the C library. It takes all bytes at once."""

    def __init__(self):
        class Hash128(ctypes.Structure):
            _fields_ = [("low", ctypes.c_uint64), ("high", ctypes.c_uint64)]
        self.hash = ctypes.CDLL("libxxhash.so.0").XXH3_128bits
        self.hash.restype, self.hash.argtypes = Hash128, [ctypes.c_char_p, ctypes.c_size_t]

    def xxh3_128(self):
        return LibXxhash.Bytes(self.hash)

    class Bytes(bytearray):
        def __init__(self, hash128):
            super().__init__()
            self.hash = hash128
        update = bytearray.extend

        def hexdigest(self):
            found = self.hash(bytes(self), len(self))
            return f"{found.high:016x}{found.low:016x}"


def find_xxhash():
    try:
        import xxhash
        return xxhash
    except ImportError:
        return LibXxhash()


def text(value):
    """A text as it goes into a digest: its length as u64, and its UTF-8 bytes."""
    value = value.encode() if isinstance(value, str) else bytes(value)
    return struct.pack("<Q", len(value)) + value


def dataset_digest(xxhash, dataset):
    """Over the values in order, little-endian, texts padded with NUL; then the extents as u64."""
    digest = xxhash.xxh3_128()
    rows = max(1, BLOCK_BYTES // max(1, dataset.dtype.itemsize * int(np.prod(dataset.shape[1:]))))
    for begin in range(0, len(dataset), rows):
        digest.update(dataset[begin:begin + rows].tobytes())
    digest.update(struct.pack(f"<{dataset.ndim}Q", *dataset.shape))
    return digest.hexdigest()


def content_digest(xxhash, file, digests):
    digest = xxhash.xxh3_128()
    for path in sorted(digests):
        if path not in NOT_CONTENT and not path.startswith("/verification/"):
            digest.update(text(path) + text(digests[path]))
    digest.update(text(file.attrs["crs"]) + file.attrs["origin"].tobytes())
    for name in ("free", "surfaces"):
        lattice = file["navigation"][name].attrs
        digest.update(lattice["lower"].tobytes() + lattice["leaf_size_m"].tobytes() + lattice["depth"].tobytes())
    ground = file["navigation/ground"].attrs
    digest.update(ground["lower"].tobytes() + ground["step_m"].tobytes())
    digest.update(file.attrs["conservative"].tobytes())
    return digest.hexdigest()


def header_digest(xxhash, file):
    digest = xxhash.xxh3_128()
    for name in ("format", "unit", "up", "crs", "fingerprint", "config", "renderer", "content_digest"):
        digest.update(text(file.attrs[name]))
    for name in ("version", "origin", "complete", "conservative"):
        digest.update(file.attrs[name].tobytes())
    return digest.hexdigest()


VERIFICATION = ("when", "program", "seed", "rays_per_cell", "eyes_per_cell", "overestimate_objects",
                "overestimate_buildings", "overestimate_triangles", "tightest_triangles",
                "false_invisible_solid_angle_mean", "false_invisible_solid_angle_worst", "narrow_gap_limit_m",
                "narrow_gap_triangles", "narrow_gap_solid_angle_mean", "narrow_gap_solid_angle_worst")


def verification_digest(xxhash, file, digests):
    digest = xxhash.xxh3_128()
    digest.update(text(file.attrs["content_digest"]))
    for name in VERIFICATION:
        value = file["verification"].attrs[name]
        digest.update(text(name) + (text(value) if isinstance(value, bytes) else value.tobytes()))
    for path in sorted(digests):
        if path.startswith("/verification/"):
            digest.update(text(path) + text(digests[path]))
    return digest.hexdigest()


def differences(xxhash, file):
    """The places whose digest does not hold."""
    digests, wrong = {}, []

    def compare(place, found, attributes, name):
        if found != attributes[name].decode():
            wrong.append(place)

    def visit(name, item):
        if isinstance(item, h5py.Dataset):
            path = "/" + name
            digests[path] = dataset_digest(xxhash, item)
            compare(path, digests[path], item.attrs, "digest")

    file.visititems(visit)
    compare("/@content_digest", content_digest(xxhash, file, digests), file.attrs, "content_digest")
    compare("/@header_digest", header_digest(xxhash, file), file.attrs, "header_digest")
    if "verification" in file:
        compare("/verification", verification_digest(xxhash, file, digests), file["verification"].attrs, "digest")
    return len(digests), wrong


def main():
    parser = argparse.ArgumentParser(description="Compares every digest of a result with what it is about.")
    parser.add_argument("file", metavar="FILE", help="city.pvs.h5")
    options = parser.parse_args()
    try:
        xxhash = find_xxhash()
    except OSError as error:
        print(f"check_digests.py: no XXH3-128 here: install python3-xxhash or libxxhash0 ({error})", file=sys.stderr)
        return 2
    try:
        with h5py.File(options.file, "r") as file:
            count, wrong = differences(xxhash, file)
    except (OSError, KeyError) as error:
        print(f"check_digests.py: {options.file}: damaged or another's: {str(error).splitlines()[0]}", file=sys.stderr)
        return 1
    for place in wrong:
        print(f"check_digests.py: {options.file}: {place}: its digest does not hold", file=sys.stderr)
    if not wrong:
        print(f"{options.file}: the digests of {count} datasets hold")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
