#!/usr/bin/env bash
# The programs as a user runs them, on a small city, with the real worker: bake under mpirun and alone with any number of ranks and
# workers, kill -9 and go on, verify, look. Everything must end in the same content digest.
# use: end_to_end_test.sh BIN-DIRECTORY SOURCE-DIRECTORY [MODEL REGION]
# MODEL and REGION (four numbers, comma-separated) default to a corner of Den Haag. 77: skipped.
set -euo pipefail
bin=$(realpath "$1") root=$(realpath "$2")
model=${3:-$root/tests/data/denhaag/denhaag.city.json} region=${4:-78560, 457880, 78640, 457950}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
command -v mpirun >/dev/null || { echo "skipped: no mpirun here"; exit 77; }
"$bin/veduta-worker" --probe --gpu software >/dev/null 2>&1 || { echo "skipped: no software OpenGL here"; exit 77; }
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fail() { echo "FAILED: $*" >&2; exit 1; }

cat >"$work/city.toml" <<TOML
[scene]
model = "$model"
[navigation]
seed_size = 0.25
[cells]
size = 10.0
region = [$region]
[occlusion]
resolution = 256
subdivide = 2
TOML

digest() { "$bin/veduta" info "$1/city.pvs.h5" --json | sed -n 's/.*"content_digest": *"\([0-9a-f]*\)".*/\1/p'; }
bake() { # DIRECTORY RANKS WORKERS
  if [[ $2 -eq 0 ]]; then
    "$bin/veduta" bake "$work/city.toml" --out "$1" --workers "$3" --gpu software
  else
    mpirun -n "$2" --oversubscribe --bind-to none "$bin/veduta" bake "$work/city.toml" --out "$1" --workers "$3" --gpu software
  fi >"$1.log" 2>&1
}

bake "$work/reference" 0 1 || { cat "$work/reference.log" >&2; fail "baking alone"; }
reference=$(digest "$work/reference")
[[ ${#reference} -eq 32 ]] || fail "no digest of the reference"
echo "reference $reference, $("$bin/veduta" info "$work/reference/city.pvs.h5" | grep cells)"

for ranks in 1 2 3; do
  for workers in 1 2; do
    run=$work/run_${ranks}_$workers
    bake "$run" "$ranks" "$workers" || { cat "$run.log" >&2; fail "$ranks ranks, $workers workers"; }
    [[ $(digest "$run") == "$reference" ]] || fail "$ranks ranks with $workers workers: digest $(digest "$run")"
    echo "$ranks ranks x $workers workers: same digest"
  done
done

# Kills: a worker (the bake goes on by itself), a rank and mpirun (the same command goes on).
children_of() { pgrep -f "$1.*--out $2 " || true; }
for victim in worker rank mpirun; do
  run=$work/kill_$victim
  bake "$run" 2 1 &
  job=$!
  for _ in $(seq 400); do # until some cells are in the journal
    [[ $(stat -c %s "$run"/shards/*.shard 2>/dev/null | awk '{s += $1} END {print s + 0}') -gt 8000 ]] && break
    kill -0 $job 2>/dev/null || break
    sleep 0.02
  done
  ranks=$(children_of 'bin/veduta bake' "$run" | tr '\n' ' ')
  case $victim in
    worker) for rank in $ranks; do pkill -9 -P "$rank" veduta-worker && break || true; done ;;
    rank) pid=$(for rank in $ranks; do [[ $(cat /proc/"$rank"/comm 2>/dev/null) == veduta ]] && echo "$rank"; done | tail -1)
      kill -9 "$pid" ;;
    mpirun) pid=$(for rank in $ranks; do [[ $(cat /proc/"$rank"/comm 2>/dev/null) == mpirun ]] && echo "$rank"; done | head -1)
      kill -9 "$pid" ;;
  esac || echo "($victim was gone already)"
  status=0
  wait $job || status=$?
  if [[ $victim == worker ]]; then
    [[ $status -eq 0 ]] || { cat "$run.log" >&2; fail "the bake did not survive the death of a worker: status $status"; }
  else
    for _ in $(seq 60); do # what mpirun leaves behind dies within seconds
      [[ -z $(pgrep -f "veduta.* $run " || true) ]] && break
      sleep 0.1
    done
    bake "$run" 2 1 || { cat "$run.log" >&2; fail "going on after kill -9 of a $victim"; }
  fi
  [[ $(digest "$run") == "$reference" ]] || fail "kill -9 of a $victim: digest $(digest "$run")"
  echo "kill -9 of a $victim (status $status), then again: same digest; $(grep -ho '[0-9]* cells ([0-9]* in this run' "$run.log" | tail -1))"
done

(cd "$work" && "$bin/veduta" verify reference/city.pvs.h5 --cells 16 --rays 100000 --json verify.json 2>/dev/null) || fail "verification"
[[ -s $work/verify.json ]] || fail "no verify.json beside the run"
"$bin/veduta" verify "$work/reference/city.pvs.h5" --cells 4 --rays 10000 --store >/dev/null 2>&1 || fail "verification, stored"
"$bin/veduta" info "$work/reference/city.pvs.h5" | grep -q 'passed: 4 of ' || fail "info does not know of the verification"
[[ $(digest "$work/reference") == "$reference" ]] || fail "a verification changed the content digest"
"$bin/veduta" export "$work/reference/city.pvs.h5" -o "$work/rows.jsonl" >/dev/null || fail "export of all rows"
"$bin/veduta" info "$work/reference/city.pvs.h5" | grep -q "^ *cells  *$(wc -l <"$work/rows.jsonl"): " || fail "rows exported are not as many as cells"
written=$("$bin/veduta" export "$work/reference/city.pvs.h5" --cell 0 -o "$work/cell.glb" | grep -o '[0-9]* triangles') || fail "export of a cell"
"$bin/veduta" import "$work/cell.glb" --info | grep -q "^polygons *${written% triangles}, " || fail "of $written exported, others were imported"
echo "exported: a cell of $written, imported again; $(wc -l <"$work/rows.jsonl") rows"
"$bin/veduta-view" "$work/reference/city.pvs.h5" --headless --gpu software --stereo side-by-side --frames 3 --size 640x180 --out "$work/on" >/dev/null
"$bin/veduta-view" "$work/reference/city.pvs.h5" --headless --gpu software --stereo side-by-side --frames 3 --size 640x180 --out "$work/off" --pvs off >/dev/null
for frame in "$work"/on/*.png; do cmp "$frame" "$work/off/$(basename "$frame")" || fail "a picture differs without the PVS"; done
echo "pictures with and without the PVS are identical"
