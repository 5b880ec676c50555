#!/usr/bin/env bash
# grid_bench_test.sh PROGRAM ROOT: what the benchmark answers, not how fast it was. It fails when the two grids differ.
set -euo pipefail
program=$1 model=$2/tests/data/denhaag/denhaag.city.json
out=$(echo "{\"model\": \"$model\", \"seed_size_m\": 0.5, \"half_extent_m\": 2, \"repeat\": 1}" | "$program")
expect() { grep -q "$1" <<<"$out" || { echo "no '$1' in: $out"; exit 1; }; }
expect '"erosion_voxels": 1'
for key in occupied_voxels touched_seeds free_voxels free_seeds eroded_voxels bit_plane; do expect "\"$key\": [1-9]"; done
for key in seed_test flood_fill flood_seeds flood flood_by_hand erode; do expect "\"$key\": [0-9]"; done
if echo 'no json' | "$program" 2>/dev/null; then echo "bad JSON was taken"; exit 1; fi
