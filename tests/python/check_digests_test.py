"""examples/python/check_digests.py: the digests that the writer in C++ left, and every kind of damage."""

import shutil
import unittest

import h5py
import numpy as np

from toy import answers, run_example, toy, work
import check_digests


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
