#!/usr/bin/env bash
# coordinator_bench_test.sh PROGRAM: R15 but for the time it took: over TCP every lease is answered, every cell counts once.
set -euo pipefail
program=$1
if "$program" </dev/null 2>/dev/null; then echo "it ran without mpirun"; exit 1; fi
command -v mpirun >/dev/null || { echo "skipped: no mpirun"; exit 77; }
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
ranks() { timeout 120 mpirun --oversubscribe --bind-to none --mca btl self,tcp -n "$@" "$program" 2>/dev/null; }
job='{"workers_per_rank": 20, "bare_tasks": 2000, "runs": [
  {"cells": 3000, "cells_per_lease": 1}, {"cells": 20000, "cells_per_lease": 64}]}'
out=$(ranks 3 <<<"$job")
expect() { grep -q "$1" <<<"$out" || { echo "no '$1' in: $out"; exit 1; }; }
expect '"btl": "self,tcp"'
expect '"tasks": 2000,'
# Leases of one cell: as many leases and answers as cells.
for key in cells done_once answers leases; do expect "\"$key\": 3000,"; done
for key in cells done_once; do expect "\"$key\": 20000,"; done
for key in tasks_per_s leases_per_s messages_per_s processor_us_per_message leases_to_bare_tasks; do expect "\"$key\": [0-9]"; done
if ranks 2 <<<'no json' >/dev/null; then echo "bad JSON was taken"; exit 1; fi
