#!/usr/bin/env bash
# Draws the pictures of docs/city.md again: docs/city_pictures.sh BIN-DIRECTORY
# Lyon's are left as they are where ../shared/data/lyon_plan is missing.
set -euo pipefail
bin=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
mkdir -p out

draw() { # NAME: bakes configs/NAME.toml from configs/city/NAME.toml
  "$bin/veduta" city "configs/city/$1.toml" -o "out/$1.city.json"
  "$bin/veduta" bake "configs/$1.toml" --out "out/$1" --fresh
}
look() { # NAME PICTURE X,Y,Z,YAW,PITCH: m from the scene's origin, degrees; everything is drawn, not one cell's row
  printf 'x,y,z,yaw_deg,pitch_deg\n%s\n' "$3" >"out/$2.csv"
  "$bin/veduta-view" "out/$1/city.pvs.h5" --headless --pvs off --path "out/$2.csv" --size 1200x600 --out "out/$2"
  mv "out/$2/frame_0000.png" "docs/$2.png"
}

draw thesis_small
look thesis_small city_streets -230,-95,22,35,-8
look thesis_small city_facades 60,-92,12,100,-2

if [[ ! -e ../shared/data/lyon_plan/buildings_lyon1.geojson ]]; then
  echo "skipped: Lyon's plan is not here (../shared/data/lyon_plan)"
  exit 0
fi
draw lyon
look lyon city_lyon -300,-500,160,60,-25
look lyon city_lyon_near 260,-330,75,75,-18
# From the street, with what the view-cell sees.
"$bin/veduta-view" out/lyon/city.pvs.h5 --headless --frames 6 --size 1200x600 --out out/city_lyon_street
mv out/city_lyon_street/frame_0002.png docs/city_lyon_street.png
