#!/usr/bin/env bash
# shrink_bench_test.sh PROGRAM ROOT: what the benchmark answers, not how fast it was.
set -euo pipefail
program=$1 root=$2
config=$(mktemp --suffix=.toml)
trap 'rm -f "$config"' EXIT
printf '[scene]\nmodel = "%s/tests/data/denhaag/denhaag.city.json"\n[navigation]\nseed_size = 0.25\n' "$root" >"$config"
out=$(echo "{\"config\": \"$config\", \"methods\": [\"sealed\", \"vertex\"], \"half_extents\": [[1, 1, 0.5]],
  \"blocks\": 1, \"points\": 3000, \"alone\": 1}" | "$program")
expect() { grep -q "$1" <<<"$out" || { echo "no '$1' in: $out"; exit 1; }; }
for key in blocks buildings eroded_m3 eroded_together_m3 eroded_alone_m3 kept_share kept_error triangles_median \
  seconds_a_building intersecting unsafe; do expect "\"$key\": [0-9]"; done
expect '"points_outside": 0,'
expect '"sealed": {'
expect '"vertex": {'
if grep -q '"points_outside": [1-9]' <<<"$out"; then echo "occluders where nothing is sealed: $out"; exit 1; fi
if echo 'no json' | "$program" 2>/dev/null; then echo "bad JSON was taken"; exit 1; fi
