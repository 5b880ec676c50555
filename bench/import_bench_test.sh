#!/usr/bin/env bash
# import_bench_test.sh PROGRAM ROOT: what the benchmark answers, not how fast it was.
set -euo pipefail
program=$1 models=$2/tests/data
out=$(echo "{\"models\": [\"$models/denhaag/denhaag.city.json\", \"$models/none.json\"], \"repeat\": 2}" | "$program")
expect() { grep -q "$1" <<<"$out" || { echo "no '$1' in: $out"; exit 1; }; }
expect '"format": "CityJSON 1.1"'
expect '"bytes": 3158479'
expect '"objects": 932'
for key in seconds read_s rate_mb_s rate_of_reading peak_memory_mb; do expect "\"$key\": [0-9]"; done
expect '"error": ".*none.json: file: '
if echo 'no json' | "$program" 2>/dev/null; then echo "bad JSON was taken"; exit 1; fi
