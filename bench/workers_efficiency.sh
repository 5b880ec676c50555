#!/usr/bin/env bash
# workers_efficiency.sh PROGRAMS CONFIG [REPEAT [WORKERS]]: how much more WORKERS [2] workers bake than one, on this
# machine, in one run: JSON on standard output.
#
# CONFIG is prepared once, then baked REPEAT [3] times by one worker and by so many, in turn, from the same prepared/. Each
# worker has one thread of the software renderer (LP_NUM_THREADS=1). Of each, the least time counts. `efficiency` =
# one's time / (WORKERS x theirs). `cell_efficiency` is the same of the mean time of a cell: what it lacks of 1, workers
# take from each other (caches, memory, cores that others use); what `efficiency` lacks beyond that is the farm's.
set -euo pipefail
programs=$1 config=$2 repeat=${3:-3} workers=${4:-2}
export LP_NUM_THREADS=1
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT
bake() { "$programs/veduta" bake "$config" --no-merge "$@" >"$work/log.txt" 2>&1 || { cat "$work/log.txt" >&2; exit 1; }; }
value() { sed -n "s/^  \"$2\": \([0-9.e+-]*\),\{0,1\}$/\1/p" "$1/report.json"; }
# What is prepared here is baked again and again; this first bake warms the caches.
bake --workers "$workers" --out "$work/prepared"
rm -rf "$work/prepared/shards" "$work/prepared/log.jsonl" "$work/prepared/report.json"

least() { sort -g | head -1; }
for ((turn = 0; turn < repeat; turn++)); do
  for count in 1 "$workers"; do
    cp -r "$work/prepared" "$work/run"
    bake --workers "$count" --out "$work/run"
    value "$work/run" bake_s >>"$work/bake_s.$count"
    value "$work/run" mean_cell_ms >>"$work/mean_cell_ms.$count"
    cells=$(value "$work/run" cells_of_this_attempt)
    rm -rf "$work/run"
  done
done
one=$(least <"$work/bake_s.1") all=$(least <"$work/bake_s.$workers")
one_cell=$(least <"$work/mean_cell_ms.1") all_cell=$(least <"$work/mean_cell_ms.$workers")
awk -v cells="$cells" -v n="$workers" -v one="$one" -v all="$all" -v one_cell="$one_cell" -v all_cell="$all_cell" -v repeat="$repeat" \
  'BEGIN { printf "{\n  \"cells\": %d,\n  \"repeat\": %d,\n  \"workers\": %d,\n  \"bake_s_of_one\": %.3f,\n  \"bake_s_of_all\": %.3f,\n", cells, repeat, n, one, all
           printf "  \"mean_cell_ms_of_one\": %.3f,\n  \"mean_cell_ms_of_all\": %.3f,\n", one_cell, all_cell
           printf "  \"efficiency\": %.3f,\n  \"cell_efficiency\": %.3f\n}\n", one / (n * all), one_cell / all_cell }'
