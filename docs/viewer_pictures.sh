#!/usr/bin/env bash
# Draws the pictures of docs/viewer.md again: docs/viewer_pictures.sh BIN-DIRECTORY [FILE]
# FILE: Den Haag, as bake.sh bakes it.
set -euo pipefail
bin=$(realpath "$1")
file=$(realpath "${2:-out/demo/city.pvs.h5}")
cd "$(dirname "${BASH_SOURCE[0]}")/viewer"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

street=-85,5,5.67,290,4  # x,y,z,yaw,pitch: m from the scene's origin, degrees

draw() { # PICTURE POSES OPTIONS...: what is drawn at the last of the poses
  printf 'x,y,z,yaw_deg,pitch_deg\n%s\n' "$2" >"$work/path.csv"
  rm -rf "$work/out"
  "$bin/veduta-view" "$file" --headless --path "$work/path.csv" --out "$work/out" "${@:3}"
  mv "$(printf '%s\n' "$work"/out/*.png | tail -1)" "$1.png"
}

for mode in mono left right side-by-side-half top-bottom-half anaglyph anaglyph-red-cyan anaglyph-green-magenta \
  anaglyph-amber-blue interlaced-rows interlaced-columns checkerboard; do
  draw "$mode" "$street" --stereo "$mode" --size 400x225
done
for mode in side-by-side cross-eyed top-bottom; do
  draw "$mode" "$street" --stereo "$mode" --size 320x180
done

above="$street"$'\n'-15,-150,75,125,-27
draw map "$street" --map full --size 640x360
draw frozen "$above" --freeze --size 640x360
draw cells -85,5,40,290,-25 --cells size --size 640x360
draw figures "$street" --hud --map inset --frames 3 --size 960x540
