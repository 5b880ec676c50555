#!/usr/bin/env bash
# leases_bench_test.sh PROGRAM ROOT: what the benchmark answers, not how fast it was; farms whose outcome is known by hand.
set -euo pipefail
program=$1 root=$2
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT
printf '# one second\n1000000\n' >"$work/second.txt"
expect() { grep -q "$1" <<<"$out" || { echo "no '$1' in: $out"; exit 1; }; }
farm() { out=$("$program" <<<"{\"farms\": [{\"cell_times\": \"$work/second.txt\", $1}]}"); }

out=$("$program" <<<'{"book": [{"cells": 5000, "done": 0.4, "workers": 7}]}')
expect '"answers": 3000,'
expect '"processor_ns_per_cell": [0-9]'

out=$("$program" <<<'{"idle": [{"workers": 50}]}')
expect '"processor_ns_per_ask": [0-9]'

farm '"workers": [4], "cells": 12'
expect '"efficiency": 1.0,'
expect '"makespan_s": 3.0,'
expect '"duplicates": 0,'
# Waits 0.25 s + granted 0.25 s + on its way 1 s + baked 1 s + on its way 1 s + cell and lease done 0.5 s.
farm '"workers": [1], "cells": 1, "message_us": 250000, "latency_ms": 1000'
expect '"makespan_s": 4.0,'
expect '"efficiency": 0.25,'
expect '"messages": 4,'
expect '"coordinator_busy": 0.25,'
# One of two workers takes a second, the other four: together 1.25 cells a second.
farm '"workers": [2], "cells": 8, "slow_share": 0.5, "slow_factor": 4'
expect '"efficiency": 0.[89]'
# Leases of one cell: it waits, then three messages a cell, and a coordinator that needs 10 ms for one.
farm '"workers": [1000], "cells": 5000, "message_us": 10000'
expect '"coordinator_busy": 1.0,'
expect '"messages": 16000,'
expect '"makespan_s": 160.0'
farm '"workers": [10], "cells": 1000, "deaths_per_hour": 600, "hangs_per_hour": 20'
expect '"deaths": [1-9]'
expect '"makespan_s": [1-9]'
out=$("$program" <<<"{\"farms\": [{\"cell_times\": \"$root/bench/data/cell_times_linz.txt\", \"workers\": [3, 5]}]}")
expect '"cells": 750,'
expect '"cells": 1250,'

if echo 'no json' | "$program" 2>/dev/null; then echo "bad JSON was taken"; exit 1; fi
if farm '"cell_times": "none.txt", "workers": [1]' 2>/dev/null; then echo "a missing file was taken"; exit 1; fi
