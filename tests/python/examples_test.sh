#!/usr/bin/env bash
# The examples in Python against the reader in C++.
# use: examples_test.sh SOURCE-DIRECTORY PVS_ANSWERS VEDUTA [FILE.pvs.h5...]
# 77: skipped, no Python with h5py; VEDUTA_PYTHON names one.
set -euo pipefail
for python in ${VEDUTA_PYTHON:-/usr/bin/python3 python3}; do
  "$python" -c 'import h5py, numpy' 2>/dev/null || continue
  exec "$python" -B "$1/tests/python/examples_test.py" "$@"
done
echo "skipped: no python3 with h5py and numpy here; apt-get install python3-h5py"
exit 77
