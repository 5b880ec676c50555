#!/usr/bin/env bash
# Models known to break geometry programs (open, non-manifold, self-intersecting, mis-oriented, of huge coordinates), as
# a user meets them: each is imported, scaled to the size of a house, baked all around and verified by rays. One that
# the import refuses has to be refused with one line and status 65.
# use: hard_data_test.sh BIN-DIRECTORY SOURCE-DIRECTORY DATA-DIRECTORY [all]
# Without `all`, a few of each collection. 77: skipped.
set -euo pipefail
bin=$(realpath "$1") data=$3
[[ -d $data ]] || { echo "skipped: no $data"; exit 77; }
"$bin/veduta-worker" --probe --gpu software >/dev/null 2>&1 || { echo "skipped: no software OpenGL here"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

collect() {
  find "$data"/hard_cgal "$data"/hard_manifold "$data"/hard_val3dity "$data"/hard_lyon_obj "$data"/berlin_citygml \
    \( -name '*.off' -o -name '*.stl' -o -name '*.obj' -o -name '*.ply' -o -name '*.json' -o -name '*.gml' \
    -o -name '*.citygml' -o -name '*.poly' \) 2>/dev/null | sort
}
few='/(cube-ouvert|fold|degtri_sliding|cross)\.off$|/(Havocglass8_left|Offset3)\.obj$|/(cube_collapsed|pfold1)\.poly$|/empty_primitive\.obj$|/tour_part_dieu\.obj$'
mapfile -t models < <(if [[ ${4:-} == all ]]; then collect; else collect | grep -E "$few"; fi)
[[ ${#models[@]} -gt 0 ]] || { echo "skipped: no model in $data"; exit 77; }

# A .poly (TetGen) as an OBJ: its points and the outer ring of each facet.
poly_to_obj() {
  awk 'NR == 1 { points = $1; next }
       $1 ~ /^#/ || NF == 0 { next }
       seen < points { if (!seen) base = $1; print "v", $2, $3, $4; ++seen; next }
       !facets { facets = $1; next }
       !rings { rings = $1; holes = $2; first = 1; next }
       { if (rings > 0) {
           if (first) { out = "f"; for (n = 2; n <= NF; ++n) out = out " " $n + 1 - base; print out; first = 0 }
           if (--rings == 0 && holes > 0) rings = -holes
         } else if (rings < 0) ++rings }' "$1"
}

baked=0 refused=0 failed=0
fail() { echo "FAILED: $1: $2"; failed=$((failed + 1)); }
for model in "${models[@]}"; do
  name=${model#"$data"/} input=$model
  if [[ $model == *.poly ]]; then
    input=$work/model.obj
    poly_to_obj "$model" >"$input"
  fi
  status=0
  timeout 120 "$bin/veduta" import "$input" --unit 1 --info --json >"$work/info" 2>"$work/error" || status=$?
  if [[ $status -eq 65 && $(wc -l <"$work/error") -eq 1 ]]; then
    refused=$((refused + 1)); echo "$name: refused: $(sed 's/^veduta: //; s/^[^:]*: //' "$work/error")"; continue
  elif [[ $status -ne 0 ]]; then
    fail "$name" "import: status $status: $(tail -1 "$work/error")"; continue
  fi
  # A house of 24 m, whatever the unit; ground is made around it where the model brings none.
  unit=$(awk '/"lower"/ { side = 1; n = 0; next }
              /"upper"/ { side = 2; n = 0; next }
              side && n < 3 && /^ *-?[0-9]/ { gsub(/[, ]/, ""); box[side, n++] = $0 }
              END { for (a = 0; a < 3; ++a) { d = box[2, a] - box[1, a]; if (d > most) most = d }
                    printf "%.9g", (most > 60 || most < 6) ? 24 / most : 1 }' "$work/info")
  cat >"$work/city.toml" <<TOML
[scene]
model = "$input"
unit = $unit
[navigation]
seed_size = 0.125
[cells]
size = 4.0
[occlusion]
resolution = 256
subdivide = 2
TOML
  status=0
  timeout 300 "$bin/veduta" bake "$work/city.toml" --out "$work/run" --fresh --workers 2 --gpu software >"$work/log" 2>&1 || status=$?
  if [[ $status -eq 65 ]]; then
    refused=$((refused + 1)); echo "$name: refused: $(grep '^veduta:' "$work/log" | tail -1)"; continue
  elif [[ $status -ne 0 ]]; then
    fail "$name" "bake: status $status: $(tail -1 "$work/log")"; continue
  fi
  if ! timeout 300 "$bin/veduta" verify "$work/run/city.pvs.h5" --cells 12 --rays 100000 >"$work/log" 2>&1; then
    fail "$name" "verify: $(grep -E 'false invisible|veduta:' "$work/log" | tail -1)"; continue
  fi
  baked=$((baked + 1))
  echo "$name: baked and verified ($(sed -n 's/^verified *//p' "$work/log" | cut -d, -f1))"
done
echo "$baked baked and verified, $refused refused with a reason, $failed failed"
[[ $failed -eq 0 && $baked -gt 0 ]]
