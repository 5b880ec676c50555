#!/usr/bin/env bash
# The examples in Python against the reader in C++: on a toy city, on one that is baked from tests/data where there is OpenGL, and on
# the files named.
# use: examples_test.sh SOURCE-DIRECTORY PVS_ANSWERS BIN-DIRECTORY [FILE.pvs.h5...]
# 77: skipped: no Python with h5py (VEDUTA_PYTHON names one), or in part: no matplotlib, no libxxhash.
set -euo pipefail
source=$(realpath "$1") answers=$(realpath "$2") bin=$(realpath "$3")
files=("${@:4}")

python=""
for candidate in ${VEDUTA_PYTHON:-/usr/bin/python3 python3}; do
  if "$candidate" -c 'import h5py, numpy' 2>/dev/null; then python=$candidate; break; fi
done
[[ -n $python ]] || { echo "skipped: no python3 with h5py and numpy here; apt-get install python3-h5py"; exit 77; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if "$bin/veduta-worker" --probe --gpu software >/dev/null 2>&1; then
  cat >"$work/city.toml" <<TOML
[scene]
model = "$source/tests/data/formats/toy.glb"
[navigation]
seed_size = 0.125
[cells]
size = 4.0
[occlusion]
resolution = 256
subdivide = 2
TOML
  "$bin/veduta" bake "$work/city.toml" --out "$work/run" --workers 2 --gpu software >"$work/log" 2>&1 || { tail -5 "$work/log"; exit 1; }
  files+=("$work/run/city.pvs.h5")
else
  echo "no software OpenGL here: nothing is baked, the toy city alone is compared"
fi
"$python" -B "$source/tests/python/examples_test.py" "$source" "$answers" "$bin/veduta" "${files[@]}"
