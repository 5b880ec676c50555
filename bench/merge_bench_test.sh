#!/usr/bin/env bash
# merge_bench_test.sh PROGRAM: what the benchmark answers, not how fast it was.
set -euo pipefail
program=$1
out=$(echo '{"runs": [{"cells": 50, "objects": 300, "entries": 20, "shards": 3, "lease": 4},
                      {"cells": 500, "objects": 300, "entries": 20, "shards": 30, "lease": 4}]}' | "$program")
expect() { grep -q "$1" <<<"$out" || { echo "no '$1' in: $out"; exit 1; }; }
expect '"cells": 500,'
for key in shard_mb file_mb merge_s merge_processor_s rate_mb_s rate_of_copying journal_mb_s peak_memory_mb \
           memory_bytes_per_cell; do
  expect "\"$key\": -\?[0-9]"
done
if echo 'no json' | "$program" 2>/dev/null; then echo "bad JSON was taken"; exit 1; fi
if echo '{"runs": [{"directory": "/none"}]}' | "$program" 2>/dev/null; then echo "no run, and no word"; exit 1; fi
