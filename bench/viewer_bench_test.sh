#!/usr/bin/env bash
# viewer_bench_test.sh PROGRAM: what the benchmark answers on a small generated city, not how fast it was.
set -euo pipefail
program=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export TMPDIR=$work
fail() { echo "FAILED: $*" >&2; exit 1; }

# Both ends are in the first cell, at eye height.
printf 'x,y,z,yaw_deg,pitch_deg\n15,15,1.7,90,0\n17,17,1.7,0,0\n' >"$work/path.csv"
job="{\"blocks\": 6, \"path\": \"$work/path.csv\", \"frames\": 6, \"stretch\": 3, \"repeats\": 1, \"width\": 96, \"height\": 64"
if ! out=$(echo "$job}" | "$program" 2>"$work/errors"); then
  grep -qiE 'EGL|OpenGL' "$work/errors" && { echo "skipped: $(<"$work/errors")"; exit 77; }
  fail "$(<"$work/errors")"
fi
expect() { grep -q "$1" <<<"$out" || fail "no '$1' in: $out"; }
expect '"objects": 37'
expect '"triangles": 444'
expect '"frames": 6'
for name in all buildings slices stereo_single stereo_multiple stereo_none; do expect "\"$name\": {"; done
for key in fps median_ms p99_ms cull_ms triangles draws culled_percent fps_slices_over_buildings fps_single_over_multiple \
  triangles_in_ranges bytes_per_slice; do expect "\"$key\": [0-9]"; done
# Rows list whole objects, nine of ten: no range meets another, and slices draw what building level draws.
expect '"triangles_in_two_ranges": 0.0'
expect '"triangles_slices_over_buildings": 1.0'
[[ -z $(find "$work" -name '*.h5') ]] || fail "a file is left behind"

refused() { # INPUT WORDS
  local errors
  if errors=$(echo "$1" | "$program" 2>&1 >/dev/null); then fail "taken: $1"; fi
  [[ $(wc -l <<<"$errors") -eq 1 ]] && grep -q "$2" <<<"$errors" || fail "$1: $errors"
}
refused 'no json' 'parse error'
refused '{}' 'blocks'
refused "$job, \"eyes\": 3}" 'no key "eyes"'
refused '{"file": "/none.pvs.h5"}' 'none.pvs.h5'
