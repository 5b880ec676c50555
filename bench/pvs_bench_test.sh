#!/usr/bin/env bash
# pvs_bench_test.sh PROGRAM: what the benchmark answers, not how fast it was.
set -euo pipefail
program=$1
out=$(echo '{"results": [{"cells": 500, "objects": 300, "entries": 20}], "budgets_mb": [1, 8], "look_ups": 1000}' |
  "$program")
expect() { grep -q "$1" <<<"$out" || { echo "no '$1' in: $out"; exit 1; }; }
expect '"cells": 500,'
expect '"triangles": 1200,'
for key in entries_per_row file_mb bytes_per_cell of_three_bytes of_bits wall_ms processor_ms with_navigation_ms \
           of_whole_file find_cell_ns cell_and_row_ns stream_cell_and_row_ns of_linear of_dense grid_bytes_per_cell \
           grid_most_looked_at budget_mb row_us random_row_us geometry_s kept_mb after_opening_mb grown_mb; do
  expect "\"$key\": -\?[0-9]"
done
[[ $(grep -c '"budget_mb"' <<<"$out") == 2 ]] || { echo "not two budgets in: $out"; exit 1; }
if echo 'no json' | "$program" 2>/dev/null; then echo "bad JSON was taken"; exit 1; fi
if echo '{"results": [{"file": "/none"}]}' | "$program" 2>/dev/null; then echo "no file, and no word"; exit 1; fi
