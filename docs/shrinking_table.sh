#!/usr/bin/env bash
# Measures the shrinking methods again and writes the table in docs/shrinking.md: docs/shrinking_table.sh BIN-DIRECTORY [METHOD...]
#   BLOCKS=24 ALONE=100 EXACT=60 POINTS=20000   how much of each city is looked at (BLOCKS=0: all of it)
#   BAKES=1   also bakes and verifies a small region of each city with each method: over-estimate and false invisible
# Rotterdam and Linz are left out where ../shared/data is missing.
set -euo pipefail
bin=$(realpath "$1")
shift
methods=("$@")
[[ ${#methods[@]} -gt 0 ]] || methods=(planes sections sealed vertex)
cd "$(dirname "${BASH_SOURCE[0]}")/.."
out=out/shrinking
mkdir -p "$out"
data=$(realpath -m ../shared/data)

"$bin/veduta" city configs/city/thesis_small.toml -o "$out/thesis_small.city.json" >/dev/null
names=("Den Haag" "Rotterdam" "Linz core" "thesis city")
models=(tests/data/denhaag/denhaag.city.json "$data/rotterdam/3-20-DELFSHAVEN.city.json" "$data/linz/linz_core_8tiles.tar.xz"
  "$out/thesis_small.city.json")
seeds=(0.125 0.125 0.25 0.125) # m; Linz is wide and hilly
list=$(printf '"%s",' "${methods[@]}")

config() { # NUMBER METHOD EXTRA-LINES-OF-CELLS
  printf '[scene]\nmodel = "%s"\n[navigation]\nseed_size = %s\n[cells]\nsize = 5.0\n%s\n[shrink]\nmethod = "%s"\n[occlusion]\nsubdivide = 2\n' \
    "$(realpath "${models[$1]}")" "${seeds[$1]}" "$3" "$2"
}

answers=()
for n in "${!names[@]}"; do
  [[ -e ${models[$n]} ]] || { echo "skipped: ${names[$n]}: ${models[$n]} is not here" >&2; continue; }
  config "$n" "${methods[0]}" '' >"$out/$n.toml"
  echo "== ${names[$n]}" >&2
  "$bin/veduta-bench-shrink" >"$out/$n.json" <<JSON
{"name": "${names[$n]}", "config": "$out/$n.toml", "methods": [${list%,}],
 "half_extents": [[1.2825, 1.2825, 0.5325], [2.5325, 2.5325, 0.5325], [5.0325, 5.0325, 0.5325]],
 "blocks": ${BLOCKS:-24}, "points": ${POINTS:-20000}, "alone": ${ALONE:-100}, "exact": ${EXACT:-60}}
JSON
  answers+=("$out/$n.json")
done

table=$out/table.md
"$bin/veduta-bench-shrink" --table "${answers[@]}" >"$table"

# A square of 60 m in the middle of each city, parts of 2.5 m.
bake_row() { # NUMBER METHOD
  local box config run report
  box=$("$bin/veduta" import "${models[$1]}" --info --json | tr -d '\n ' |
    sed -n 's/.*"lower": *\[\([^]]*\)\].*"upper": *\[\([^]]*\)\].*/\1,\2/p' |
    awk -F, '{x=($1+$4)/2; y=($2+$5)/2; printf "%.1f, %.1f, %.1f, %.1f", x-30, y-30, x+30, y+30}')
  config=$out/$1_$2.toml run=$out/$1_$2 report=$out/$1_$2.verify.json
  config "$1" "$2" "region = [$box]" >"$config"
  "$bin/veduta" bake "$config" --out "$run" --fresh >/dev/null
  "$bin/veduta" verify "$run/city.pvs.h5" --cells 24 --rays 400000 --json "$report" >/dev/null || true
  value() { sed -n "s/^ *\"$1\": *\([-0-9.e+]*\),*$/\1/p" "$report" | head -1; }
  printf '| %s | `%s` | %.2f | %.2f | %s |\n' "${names[$1]}" "$2" "$(value overestimate_objects)" "$(value overestimate_buildings)" \
    "$(value false_invisible_objects)"
}
if [[ ${BAKES:-0} -ne 0 ]]; then
  {
    printf '\nA square of 60 m in the middle of each city, cells of 5 m in 2 x 2 parts, 24 cells verified with 400,000 rays each:\n\n'
    printf '| city | method | over-estimate: objects | buildings | false invisible objects |\n|---|---|---|---|---|\n'
    for n in "${!names[@]}"; do
      [[ -e ${models[$n]} ]] || continue
      for method in "${methods[@]}"; do bake_row "$n" "$method"; done
    done
  } >>"$table"
fi

# Between the two marks of the page.
awk -v table="$table" '/<!-- table: begin/ {print; while ((getline line < table) > 0) print line; skip = 1}
  /<!-- table: end/ {skip = 0} !skip' docs/shrinking.md >"$out/shrinking.md"
mv "$out/shrinking.md" docs/shrinking.md
