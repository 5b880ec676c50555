#!/usr/bin/env bash
# journal_bench_test.sh PROGRAM ROOT: what the benchmark answers, not how fast it was.
set -euo pipefail
program=$1 times=$2/bench/data/cell_times_denhaag.txt
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT
out=$("$program" <<<"{\"directory\": \"$work\", \"records\": 500, \"rounds\": 3, \"workers\": 2, \"cell_times\": [\"$times\"]}")
expect() { grep -q "$1" <<<"$out" || { echo "no '$1' in: $out"; exit 1; }; }
expect '"records": 500,'
expect '"mean_cell_s": 0.62'
# Two workers for three seconds, 0.62 s a cell.
expect '"records": 10,'
for key in us_per_record us_per_record_not_written us_per_record_of_journal share_of_bake processor_share_of_bake; do
  expect "\"$key\": -\?[0-9]"
done
[[ -z $(ls "$work") ]] || { echo "it left $(ls "$work")"; exit 1; }
if echo 'no json' | "$program" 2>/dev/null; then echo "bad JSON was taken"; exit 1; fi
if echo '{"directory": "/proc/none"}' | "$program" 2>/dev/null; then echo "a place that cannot be written was taken"; exit 1; fi
