#!/usr/bin/env bash
# A bake over three pretended hosts: the same digest as on one; a host that dies ends the attempt and the other two complete it (R11); what
# a host lacks is told in one line that names it.
# use: hosts_test.sh BIN-DIRECTORY FAKE-WORKER. 77: skipped.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/hosts.sh"
command -v mpirun >/dev/null || { echo "skipped: no mpirun here"; exit 77; }
veduta=$(realpath "$1")/veduta
VEDUTA_WORKER=$(realpath "$2")
enter_hosts "$@"
make_hosts 3
export VEDUTA_WORKER
say() { echo "$(date +%T) $*"; }
fail() { echo "FAILED: $*" >&2; exit 1; }

mkdir "$work/shared" # what a cluster's file system is
cd "$work/shared"
echo "a model that the fake worker does not read" >city.json
printf "[scene]\nmodel = 'city.json'\n" >city.toml

digest() { sed -n 's/.*"content_digest": *"\([0-9a-f]*\)".*/\1/p' "$1/report.json"; }
done_of() { "$veduta" status "$1" --json | sed -n 's/^ *"done": *\([0-9]*\).*/\1/p'; }

# Relative paths, as people type them; orted takes them from mpirun's directory.
hostfile=$work/hostfile launch_host=${hosts[0]}
bake() { # RUN RANKS
  on_host "$launch_host" mpirun --mca plm_rsh_agent "$work/agent" --hostfile "$hostfile" --bind-to none -n "$2" \
    -x VEDUTA_WORKER -x FAKE_CELL_MS "$veduta" bake city.toml --out "$1" --workers 1
}
export FAKE_CELL_MS=1

"$veduta" bake city.toml --out reference --workers 1 >reference.log 2>&1 || { cat reference.log >&2; fail "baking alone"; }
reference=$(digest reference)
[[ ${#reference} -eq 32 ]] || fail "no digest of the reference"

# --- three hosts
bake three 3 >three.log 2>&1 || { cat three.log >&2; fail "three hosts"; }
[[ $(digest three) == "$reference" ]] || fail "three hosts: another digest: $(digest three)"
for rank in 0 1 2; do compgen -G "three/workers/0001-000$rank-00.log" >/dev/null || fail "rank $rank had no worker"; done
say "three hosts (separate: $separate): the digest of one"

# --- a host dies: one with a rank, then the one with mpirun and the coordinator
lose() { # NAME RUN
  local victim=$1 run=$2 launcher began took_ms status=0 name before
  FAKE_CELL_MS=60
  printf '%s slots=1\n' "${hosts[@]}" >"$hostfile"
  bake "$run" 3 >"$run.log" 2>&1 &
  launcher=$!
  until [[ -d $run/prepared && $(done_of "$run") -ge 10 ]]; do
    kill -0 $launcher 2>/dev/null || { cat "$run.log" >&2; fail "the bake ended before its host could be killed"; }
    sleep 0.1
  done
  [[ -n $(living_on "$victim" veduta) && -n $(living_on "$victim" fake_worker) ]] || fail "no rank on $victim"
  began=$(date +%s%N)
  kill_host "$victim"
  for name in "${hosts[@]}"; do
    until [[ -z $(living_on "$name" veduta)$(living_on "$name" fake_worker)$(living_on "$name" mpirun) ]]; do
      took_ms=$((($(date +%s%N) - began) / 1000000))
      [[ $took_ms -le 15000 ]] || fail "15 s after $victim had died, something of the bake was left on $name"
      sleep 0.1
    done
  done
  took_ms=$((($(date +%s%N) - began) / 1000000))
  wait $launcher || status=$?
  [[ $status -ne 0 ]] || fail "mpirun's status was 0 although $victim had died"
  before=$(done_of "$run")
  [[ $before -lt 200 ]] || fail "there was nothing left to go on with"
  printf '%s slots=1\n' "${hosts[@]/$victim/}" | grep -v '^ ' >"$hostfile"
  FAKE_CELL_MS=1
  launch_host=$(head -n 1 "$hostfile")
  launch_host=${launch_host% slots=1}
  bake "$run" 2 >"$run.log" 2>&1 || { cat "$run.log" >&2; fail "two hosts after $victim had died"; }
  grep -q "continuing: $before of 200 cells are done" "$run.log" || { cat "$run.log" >&2; fail "cells that were done were lost"; }
  [[ $(digest "$run") == "$reference" ]] || fail "after $victim had died: another digest: $(digest "$run")"
  say "$victim died: the attempt ended with $status after $took_ms ms, two hosts went on from cell $before to the same digest"
}
lose "${hosts[2]}" lost_rank
lose "${hosts[0]}" lost_coordinator
launch_host=${hosts[0]}
printf '%s slots=1\n' "${hosts[@]}" >"$hostfile"

# --- veduta doctor
doctor() { # DIRECTORY
  on_host "${hosts[0]}" mpirun --mca plm_rsh_agent "$work/agent" --hostfile "$hostfile" --bind-to none -n 3 -x VEDUTA_WORKER \
    "$veduta" doctor "$1" >doctor.log 2>&1
}
doctor . || { cat doctor.log >&2; fail "the doctor found fault"; }
[[ $separate -eq 0 || $(grep -cE '^host  +h[0-2]$' doctor.log) -eq 3 && $(grep -c '^shared  *yes, locks too$' doctor.log) -eq 2 ]] ||
  { cat doctor.log >&2; fail "the doctor did not see three hosts with one directory"; }

# --- what one host lacks
[[ $separate -eq 1 ]] || { say "hosts with file systems of their own: skipped, namespaces are not permitted here"; exit 0; }
one_line() { # LOG STATUS-GOT STATUS-WANTED TEXT: mpirun adds a banner of its own, between lines of dashes
  [[ $2 -eq $3 ]] || { cat "$1" >&2; fail "$1: status $2, not $3"; }
  [[ $(grep -c '^veduta: ' "$1") -eq 1 ]] || { cat "$1" >&2; fail "$1: not one line"; }
  grep '^veduta: ' "$1" | grep -q "$4" || { cat "$1" >&2; fail "$1: no \"$4\""; }
  say "$(grep '^veduta: ' "$1")"
}
on_host h2 mount --bind /dev/null "$VEDUTA_WORKER"
status=0
bake missing 3 >missing.log 2>&1 || status=$?
one_line missing.log "$status" 74 "rank 2 on h2: $VEDUTA_WORKER: the worker program is not there"
on_host h2 umount "$VEDUTA_WORKER"

mkdir private
on_host h1 mount -t tmpfs tmpfs "$work/shared/private"
status=0
bake private/run 3 >private.log 2>&1 || status=$?
one_line private.log "$status" 74 "rank 1 on h1: $work/shared/private/run: the run directory of rank 0 is not here"
status=0
doctor private || status=$?
[[ $status -eq 1 ]] && grep -q '^shared  *no: ' doctor.log || { cat doctor.log >&2; fail "the doctor did not see that a directory is not shared"; }
[[ -z $(on_host h1 ls private) ]] || fail "h1 wrote into a directory that nobody else sees"
