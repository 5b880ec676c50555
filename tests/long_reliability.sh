#!/usr/bin/env bash
# long_reliability.sh [BUILD]: the long forms of the reliability tests, by hand; a table at the end. Status 1 when one failed.
set -euo pipefail
build=$(realpath "${1:-build}")
cd "$(dirname "$0")/.."
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
log=$(mktemp)
trap 'rm -f "$log"' EXIT
rows=() failed=0

# row ID PATTERN COMMAND...: runs the command; the last line of its output with the pattern is its figure.
row() {
  local id=$1 pattern=$2 began=$SECONDS result=passed
  shift 2
  "$@" >"$log" 2>&1 || { result=FAILED; failed=1; tail -40 "$log"; }
  rows+=("$id | $result | $((SECONDS - began)) s | $(grep -E "$pattern" "$log" | tail -1)")
  echo "${rows[-1]}"
}

# 200 kills of mpirun, a rank and a worker in turn over one bake of 2,000 cells.
row "R1 kill loop" '^kill loop: ' env VEDUTA_KILLS=200 "$build/tests/kill_loop_test" --gtest_filter='*Nothing*'
# Crashes, segfaults, hangs, cells that always fail, workers and ranks that stop; three times.
row "R2, R4, R5" '^\[  PASSED' "$build/tests/bake_faults_test" --gtest_repeat=3
row "R3, R9 mutants" '^\[  PASSED' env VEDUTA_MUTANTS=30000 "$build/tests/pvs_mutants_test"
row "R7 kills during the merge" '^\[  PASSED' env VEDUTA_MERGE_KILLS=50 "$build/tests/merge_kill_test"
row "R7 full disk" '^(74|skipped)' bash tests/farm/full_disk_test.sh "$build/bin" "$build/tests/fake_worker"

printf '\n| test | result | time | figure |\n|---|---|---|---|\n'
printf '| %s |\n' "${rows[@]}"
exit "$failed"
