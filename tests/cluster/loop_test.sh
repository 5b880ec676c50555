#!/usr/bin/env bash
# configs/slurm/bake.sbatch without Slurm: it tries again after a death, stops when told to, and gives up where nothing comes on.
# use: loop_test.sh BIN-DIRECTORY FAKE-WORKER. 77: skipped.
set -euo pipefail
command -v mpirun >/dev/null || { echo "skipped: no mpirun here"; exit 77; }
veduta=$(realpath "$1")/veduta
VEDUTA_WORKER=$(realpath "$2")
script=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../../configs/slurm/bake.sbatch")
export VEDUTA_WORKER
unset SLURM_JOB_ID SLURM_RESTART_COUNT
work=$(mktemp -d)
loop=
trap '[[ -z $loop ]] || kill -9 "$loop" 2>/dev/null; pkill -9 -f "$work/mark" 2>/dev/null || true; rm -rf "$work"' EXIT
cd "$work"
say() { echo "$(date +%T) $*"; }
fail() { echo "FAILED: $*" >&2; tail -n 30 ./*.log >&2; exit 1; }
echo "a model that the fake worker does not read" >city.json
printf "[scene]\nmodel = 'city.json'\n" >city.toml
edit() { # RUN: in the paths of its processes, by which they are found
  sed -e "s|^config=.*|config=city.toml|" -e "s|^run=.*|run=$work/mark/$1|" -e "s|^veduta=.*|veduta=$veduta|" \
    -e "s|^options=.*|options=(--workers 1)|" -e 's|^mpirun=(mpirun|& --oversubscribe -n 2|' "$script" >"$1.sh"
}
done_of() { "$veduta" status "mark/$1" --json 2>/dev/null | sed -n 's/^ *"done": *\([0-9]*\).*/\1/p'; }
start() { # RUN: in the background, until some cells are done
  edit "$1"
  bash "$1.sh" >"$1.log" 2>&1 &
  loop=$!
  for _ in $(seq 600); do [[ -d mark/$1/prepared && $(done_of "$1") -ge 10 ]] && return; sleep 0.1; done
  fail "$1: no cell was baked within a minute"
}
ends() { # STATUS
  local status=0
  wait "$loop" || status=$?
  loop=
  [[ $status -eq $1 ]] || fail "the script ended with $status, not $1"
}

export FAKE_CELL_MS=40
start killed
kill -9 "$(pgrep -f -n "^$veduta bake .*$work/mark/killed")"
ends 0
grep -q "attempt 2: \"done\":" killed.log || fail "there was no second attempt that went on"
[[ -f mark/killed/city.pvs.h5 ]] || fail "no file"
say "after the death of a rank: a second attempt completes"

start told
kill -TERM $loop
ends 75
[[ -z $(pgrep -f "^$veduta bake .*$work/mark/told") ]] || fail "told to stop, the script left a bake behind"
grep -q "attempt 2" told.log && fail "told to stop, the script tried again"
say "told to stop: it does, with 75"

edit stuck
FAKE_FAIL=74 bash stuck.sh >stuck.log 2>&1 &
loop=$!
ends 75
[[ $(grep -c 'bake.sbatch: attempt [0-9]*: ' stuck.log) -eq 2 ]] || fail "not two attempts without progress"
say "where nothing comes on: two attempts"
