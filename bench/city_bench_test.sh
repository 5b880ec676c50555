#!/usr/bin/env bash
# city_bench_test.sh PROGRAM ROOT: what the benchmark answers, not how fast it was.
set -euo pipefail
program=$1 rules=$2/configs/city/rules
out=$(echo "{\"rules\": [\"$rules/plain.xml\"], \"buildings\": 3, \"threads\": [1, 2], \"repeat\": 3}" | "$program")
expect() { grep -q "$1" <<<"$out" || { echo "no '$1' in: $out"; exit 1; }; }
expect '"rules": "plain"'
expect '"floors": 10'
expect '"buildings": 3'
expect '"threads": 2'
for key in windows median_ms least_ms seconds triangles_per_s extruded_s times_extruded; do expect "\"$key\": [0-9]"; done
if echo 'no json' | "$program" 2>/dev/null; then echo "bad JSON was taken"; exit 1; fi
if echo '{"rules": ["none.xml"]}' | "$program" 2>/dev/null; then echo "a missing file was taken"; exit 1; fi
