#!/usr/bin/env bash
# Measures occlusion and prints the tables of veduta-bench-occlusion: docs/occlusion_table.sh BIN-DIRECTORY cities|growth
#   cities   Den Haag, the core of Linz (left out where ../shared/data is missing) and the small city after the thesis
#   growth   the same streets with 1, 6, 24 and 100 thousand plain houses, cells in a square of 60 m in the middle of each
#   CELLS=16 REPEATS=3   view-cells of each city; the least time of so many runs counts
#   SIZES="1k 6k 24k 100k"   growth: which cities. To prepare the largest takes ten minutes and more on two cores, once
#   METHOD=panorama VS=zoom VS_CELLS=4   another method beside it, on so many of the cells
#   MAX_OVERESTIMATE=1.2     in place of the default
# Answers and prepared cities stay in out/occlusion/; remove it to prepare them again. On software GL, one core: LP_NUM_THREADS=1.
set -euo pipefail
bin=$(realpath "$1") what=${2:-cities}
cd "$(dirname "${BASH_SOURCE[0]}")/.."
out=out/occlusion
mkdir -p "$out"
data=$(realpath -m ../shared/data)

bench() { # NAME KEY: prepares out/occlusion/KEY.toml where that is not done, measures, adds to the answers
  local job="\"name\": \"$1\", \"config\": \"$out/$2.toml\", \"run\": \"$out/$2\", \"cells\": ${CELLS:-16}, \"repeats\": ${REPEATS:-3}"
  [[ -z ${METHOD:-} ]] || job+=", \"method\": \"$METHOD\""
  [[ -z ${VS:-} ]] || job+=", \"vs\": \"$VS\", \"vs_cells\": ${VS_CELLS:-4}"
  [[ -z ${MAX_OVERESTIMATE:-} ]] || job+=", \"max_overestimate\": $MAX_OVERESTIMATE"
  echo "== $1" >&2
  echo "{$job}" | "$bin/veduta-bench-occlusion" >"$out/$2.json"
  sed -n 's/.*"prepare_s": \([0-9.]*\).*/prepared in \1 s/p' "$out/$2.json" >&2
  answers+=("$out/$2.json")
}

middle() { # MODEL: corners of a square of 60 m
  "$bin/veduta" import "$1" --info --json | tr -d '\n ' |
    sed -n 's/.*"lower": *\[\([^]]*\)\].*"upper": *\[\([^]]*\)\].*/\1,\2/p' |
    awk -F, '{x = ($1 + $4) / 2; y = ($2 + $5) / 2; printf "%.1f, %.1f, %.1f, %.1f", x - 30, y - 30, x + 30, y + 30}'
}

config() { # MODEL SEED CELL REGION
  printf '[scene]\nmodel = "%s"\n[navigation]\nseed_size = %s\n[cells]\nsize = %s\nregion = [%s]\n' "$(realpath "$1")" "$2" "$3" "$4"
}

cities() {
  "$bin/veduta" city configs/city/thesis_small.toml -o "$out/thesis_small.city.json" >/dev/null
  local names=("Den Haag" "Linz core" "thesis city, small") keys=(denhaag linz thesis_small)
  local models=(tests/data/denhaag/denhaag.city.json "$data/linz/linz_core_8tiles.tar.xz" "$out/thesis_small.city.json")
  local seeds=(0.0625 0.25 0.125) sizes=(10.0 10.0 5.0)
  for n in "${!names[@]}"; do
    [[ -e ${models[$n]} ]] || { echo "skipped: ${names[$n]}: ${models[$n]} is not here" >&2; continue; }
    config "${models[$n]}" "${seeds[$n]}" "${sizes[$n]}" '' >"$out/${keys[$n]}.toml"
    bench "${names[$n]}" "${keys[$n]}"
  done
}

growth() {
  local -A blocks=([1k]='6, 14' [6k]='16, 32' [24k]='32, 64' [100k]='65, 128') # of twelve houses each
  for size in ${SIZES:-1k 6k 24k 100k}; do
    sed "s|^blocks = .*|blocks = [${blocks[$size]}]|; s|\"box.xml|\"$PWD/configs/sweep/box.xml|" configs/sweep/plain_houses.toml >"$out/plan_$size.toml"
    "$bin/veduta" city "$out/plan_$size.toml" -o "$out/houses_$size.city.json" >/dev/null 2>&1
    config "$out/houses_$size.city.json" 0.25 5.0 "$(middle "$out/houses_$size.city.json")" >"$out/houses_$size.toml"
    bench "houses" "houses_$size"
  done
}

answers=()
case $what in
  cities | growth) "$what" ;;
  *) echo "cities or growth, not $what" >&2; exit 2 ;;
esac
"$bin/veduta-bench-occlusion" --table "${answers[@]}" | tee "$out/$what.md"
