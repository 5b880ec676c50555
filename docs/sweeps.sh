#!/usr/bin/env bash
# Measures docs/speed-against-error.md again: docs/sweeps.sh BIN-DIRECTORY [denhaag|houses|linz...]
#   CELLS=16 RAYS=1000000   view-cells of each city, rays a cell
# Figures, pages and charts go to out/sweep/CITY/; the charts are copied to docs/. On two cores this takes one to two hours. What was
# measured is kept: the same command goes on. Linz is left out where ../shared/data is missing.
set -euo pipefail
bin=$(realpath "$1")
shift
cd "$(dirname "${BASH_SOURCE[0]}")/.."
cities=("$@")
[[ ${#cities[@]} -gt 0 ]] || cities=(denhaag houses linz)
linz=$(realpath -m ../shared/data/linz/linz_core_8tiles.tar.xz)
mkdir -p out/linz

for city in "${cities[@]}"; do
  grid=grid
  case $city in
    houses) "$bin/veduta" city configs/sweep/plain_houses.toml -o out/plain_houses.city.json >/dev/null ;;
    linz)
      [[ -e $linz ]] || { echo "skipped: Linz: $linz is not here" >&2; continue; }
      ln -sf "$linz" out/linz/
      grid=grid_short
      ;;
  esac
  "$bin/veduta" sweep "configs/sweep/$city.toml" --grid configs/sweep/$grid.toml --cells "${CELLS:-16}" --rays "${RAYS:-1000000}" --gpu software
  for chart in buildings triangles; do
    cp "out/sweep/$city/$chart.svg" "docs/sweep_${city}_$chart.svg"
  done
done
