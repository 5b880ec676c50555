#!/usr/bin/env bash
# occlusion_bench_test.sh PROGRAM: what the benchmark answers on a city of three boxes, not how fast it was. 77: skipped.
set -euo pipefail
program=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }

# Ground, a long wall, and two blocks behind it: a low one that the wall hides, and a tower.
box() { # NAME X0 Y0 X1 Y1 Z; corners of what came before: $base
  printf 'o %s\n' "$1"
  for z in 0 "$6"; do printf 'v %s %s %s\nv %s %s %s\nv %s %s %s\nv %s %s %s\n' "$2" "$3" "$z" "$4" "$3" "$z" "$4" "$5" "$z" "$2" "$5" "$z"; done
  for face in "4 3 2 1" "5 6 7 8" "1 2 6 5" "2 3 7 6" "3 4 8 7" "4 1 5 8"; do
    printf 'f'
    for corner in $face; do printf ' %d' $((base + corner)); done
    printf '\n'
  done
  base=$((base + 8))
}
base=4
{
  printf 'o ground\nv -60 -60 0\nv 60 -60 0\nv 60 60 0\nv -60 60 0\nf 1 2 3 4\n'
  box wall 10 -50 24 50 12
  box low 30 -10 40 10 4
  box tower 44 -10 54 10 40
} >"$work/city.obj"
printf '[scene]\nmodel = "%s/city.obj"\n[navigation]\nseed_size = 0.25\n[cells]\nsize = 4.0\nregion = [-20, -20, 0, 20]\n[occlusion]\nresolution = 128\nsubdivide = 2\n' \
  "$work" >"$work/city.toml"
job="\"config\": \"$work/city.toml\", \"run\": \"$work/run\", \"cells\": 3, \"repeats\": 1, \"gpu\": \"software\""

status=0
out=$(echo "{$job}" | "$program" --vs panorama 2>"$work/errors") || status=$?
if grep -q 'gpu: ' "$work/errors"; then cat "$work/errors"; echo "skipped: no software OpenGL here"; exit 77; fi
[[ $status -eq 0 ]] || fail "$(cat "$work/errors")"
expect() { grep -q "$1" <<<"$out" || fail "no '$1' in: $out"; }
for key in cores objects set_up_s median mean p95 together_ms_a_cell staged_ms_a_cell occluders boxes slices read_back rays host \
  rows parts occluder_triangles pixels queries triangles_per_s streamed_triangles_per_s pixels_per_s rejected_pixels_per_s \
  box_tests_per_s queries_per_s read_back_ms rays_per_s; do expect "\"$key\": [0-9]"; done
for rate in triangles_per_s pixels_per_s box_tests_per_s queries_per_s rays_per_s; do expect "\"$rate\": [1-9]"; done
expect '"buildings": 3'
expect '"renderer": ".*llvmpipe'
# The method against itself: the same cells, the same rows, of which none lists the low block.
expect '"row_objects": 1.0'
[[ $(grep -c '"method": "panorama"' <<<"$out") -eq 3 ]] || fail "two runs and their ratio: $out"
[[ $(grep -A3 '"row_objects": {' <<<"$out" | grep -c '"median": 4.0') -eq 2 ]] || fail "rows of two tiles of ground, wall and tower: $out"

# The second call finds the city prepared; other numbers of cells, no bare loops.
out=$(echo "{$job, \"limits\": false, \"cells\": 2, \"seed\": 5}" | "$program") || fail "again"
expect '"prepare_s": 0.0'
if grep -q limits <<<"$out"; then fail "limits: $out"; fi
echo "$out" >"$work/answer.json"
table=$("$program" --table "$work/answer.json" "$work/answer.json")
[[ $(grep -c '| `panorama` | 2 |' <<<"$table") -eq 2 ]] || fail "table: $table"

refused() { # INPUT WORDS
  if echo "$1" | "$program" >/dev/null 2>"$work/errors"; then fail "taken: $1"; fi
  [[ $(wc -l <"$work/errors") -eq 1 ]] && grep -q "$2" "$work/errors" || fail "$1: $(cat "$work/errors")"
}
refused 'no json' 'parse error'
refused '{}' 'neither'
refused "{$job, \"cell\": 3}" 'no key "cell"'
refused "{$job, \"method\": \"oracle\"}" "no method 'oracle'"
sed -i 's/size = 4.0/size = 5.0/' "$work/city.toml"
refused "{$job}" 'another configuration'
refused "{\"run\": \"$work/none\"}" 'none'
