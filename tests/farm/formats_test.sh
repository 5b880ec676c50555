#!/usr/bin/env bash
# Every importer's example (tests/data/formats) as a user bakes it: import, bake with the real worker, verify by rays.
# use: formats_test.sh BIN-DIRECTORY SOURCE-DIRECTORY
# 77: skipped.
set -euo pipefail
bin=$(realpath "$1") root=$(realpath "$2")
formats=$root/tests/data/formats
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$bin/veduta-worker" --probe --gpu software >/dev/null 2>&1 || { echo "skipped: no software OpenGL here"; exit 77; }

# An archive of a model and what it refers to is a model as well.
tar -C "$formats" -czf "$work/tiles.tar.gz" tiles
models=("$work/tiles.tar.gz")
for name in blocks.dxf plan.dxf plan.geojson plan.shp citygml.gml soup.ply soup.off instances.gltf toy.glb tiles/tileset.json \
  generated.city.json generated.obj generated.dxf; do
  models+=("$formats/$name")
done

failed=0
for model in "${models[@]}"; do
  name=${model##*/}
  run=$work/run_${name//[^A-Za-z0-9]/_}
  cat >"$work/city.toml" <<TOML
[scene]
model = "$model"
[navigation]
seed_size = 0.125
[cells]
size = 4.0
[occlusion]
resolution = 256
subdivide = 2
TOML
  if ! "$bin/veduta" bake "$work/city.toml" --out "$run" --workers 2 --gpu software >"$work/log" 2>&1; then
    echo "FAILED: $name: bake"; tail -5 "$work/log"; failed=1; continue
  fi
  if ! "$bin/veduta" verify "$run/city.pvs.h5" --cells 8 --rays 100000 >"$work/log" 2>&1; then
    echo "FAILED: $name: verify"; cat "$work/log"; failed=1; continue
  fi
  # A bake in which everything is seen from everywhere would show nothing.
  "$bin/veduta" info "$run/city.pvs.h5" --json >"$work/info"
  number() { sed -n "s/^  \"$1\": \([0-9.]*\).*/\1/p" "$work/info"; }
  objects=$(number objects) cells=$(number cells) visible=$(number visible_objects_mean)
  echo "$name: $objects objects, $(number triangles) triangles, $cells cells; $visible objects visible in the mean"
  [[ $objects -ge 5 && $cells -ge 8 && ${visible%.*} -lt $objects ]] ||
    { echo "FAILED: $name: too few objects or cells, or nothing is hidden"; failed=1; }
done
exit $failed
