"""Every test of the examples in Python: examples_test.py SOURCE PVS_ANSWERS VEDUTA [FILE]"""

import os
import sys
import unittest

if __name__ == "__main__":
    here = os.path.dirname(os.path.abspath(__file__))
    sys.path.insert(0, here)
    tests = [unittest.defaultTestLoader.loadTestsFromName(name) for name in
             ("read_pvs_test", "plot_cell_test", "check_digests_test", "documents_test")]
    result = unittest.TextTestRunner(verbosity=2).run(unittest.TestSuite(tests))
    # 77 is what ctest calls skipped, so that a part that is missing is seen.
    sys.exit(1 if not result.wasSuccessful() else 77 if result.skipped else 0)
