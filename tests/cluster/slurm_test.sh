#!/usr/bin/env bash
# configs/slurm/bake.sbatch under a real Slurm controller with two pretended nodes (R10): warned, pre-empted or cancelled in its middle, a bake
# stops within 10 s; requeued or submitted again, it completes with the digest of an undisturbed one. It gives up where nothing comes on.
# use: slurm_test.sh BIN-DIRECTORY FAKE-WORKER. 77: skipped.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/hosts.sh"
for program in mpirun slurmctld slurmd sbatch srun; do
  PATH=$PATH:/usr/sbin command -v $program >/dev/null || { echo "skipped: no $program here (Debian: slurm-wlm, openmpi-bin)"; exit 77; }
done
PATH=$PATH:/usr/sbin
veduta=$(realpath "$1")/veduta
VEDUTA_WORKER=$(realpath "$2")
script=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../../configs/slurm/bake.sbatch")
enter_hosts "$@"
[[ $separate -eq 1 ]] || { echo "skipped: network namespaces are not permitted here"; exit 77; }
make_hosts 2
export VEDUTA_WORKER
say() { echo "$(date +%T) $*"; }
fail() {
  echo "FAILED: $*" >&2
  tail -n 15 "$work"/slurmctld.log "$work"/shared/veduta-*.log >&2
  exit 1
}

# --- the cluster. No munge: nobody else is on this network. cred_expire is what a requeued job waits for (two minutes by default).
plugins=$(dirname "$(find /usr/lib -name auth_none.so -print -quit)")
cat >"$work/slurm.conf" <<CONF
ClusterName=pretended
SlurmctldHost=h0
SlurmUser=root
SlurmdUser=root
AuthType=auth/none
CredType=cred/none
AuthInfo=cred_expire=5
PluginDir=$plugins
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool-%n
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd-%n.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
SchedulerType=sched/builtin
SchedulerParameters=batch_sched_delay=1,sched_interval=2
ReturnToService=2
KillWait=10
NodeName=h[0-1] CPUs=2 RealMemory=1000 State=UNKNOWN
PartitionName=low Nodes=ALL Default=YES PriorityTier=1 GraceTime=4
PartitionName=high Nodes=ALL PriorityTier=9 PreemptMode=OFF
CONF
mkdir "$work/state"
export SLURM_CONF=$work/slurm.conf
on_host h0 slurmctld -D >"$work/slurmctld.log" 2>&1 &
for name in "${hosts[@]}"; do on_host "$name" slurmd -D -N "$name" >"$work/slurmd-$name.log" 2>&1 & done
slurm() { on_host h0 "$@"; }
up() { [[ $(slurm sinfo -h -o %t -p low 2>/dev/null) == idle ]]; }
for _ in $(seq 200); do up && break; sleep 0.2; done
up || { tail -n 20 "$work"/*.log; echo "skipped: Slurm's daemons do not start here (above)"; exit 77; }
say "two nodes are up"

# --- the script, edited as its user would
mkdir "$work/shared"
cd "$work/shared"
echo "a model that the fake worker does not read" >city.json
printf "[scene]\nmodel = 'city.json'\n" >city.toml
edit() { # RUN CONFIG
  sed -e "s|^config=.*|config=$2|" -e "s|^run=.*|run=$1|" -e "s|^veduta=.*|veduta=$veduta|" -e "s|^options=.*|options=(--workers 1)|" \
    -e 's|^#SBATCH --nodes=.*|#SBATCH --nodes=2|' "$script" >"$1.sbatch"
}
submit() { slurm sbatch --parsable "$@"; } # OPTIONS... SCRIPT
digest() { sed -n 's/.*"content_digest": *"\([0-9a-f]*\)".*/\1/p' "$1/report.json"; }
done_of() { "$veduta" status "$1" --json 2>/dev/null | sed -n 's/^ *"done": *\([0-9]*\).*/\1/p'; }
field() { slurm scontrol show job "$1" | tr ' ' '\n' | sed -n "s/^$2=//p"; }
baking() { pgrep -r D,R,S,T -x veduta >/dev/null || pgrep -r D,R,S,T -x fake_worker >/dev/null; } # this test's processes: the namespace has no others
in_the_middle() { # RUN
  for _ in $(seq 600); do [[ -d $1/prepared && $(done_of "$1") -ge ${2:-10} ]] && return; sleep 0.1; done
  fail "$1: no cell was baked within a minute"
}
stops() { # WHY: within 10 s; the launcher's own shutdown is not ours
  local began
  began=$(date +%s%N)
  while baking; do
    [[ $((($(date +%s%N) - began) / 1000000)) -le 10000 ]] || fail "$1: the bake was still there after 10 s"
    sleep 0.05
  done
  took_ms=$((($(date +%s%N) - began) / 1000000))
}
ends() { # JOB STATE
  for _ in $(seq 900); do [[ $(field "$1" JobState) =~ ^(COMPLETED|FAILED|CANCELLED|TIMEOUT)$ ]] && break; sleep 0.1; done
  [[ $(field "$1" JobState) == "$2" ]] || { slurm scontrol show job "$1" >&2; fail "job $1 was to end as $2"; }
}
completes() { # WHAT JOB RUN
  ends "$2" COMPLETED
  [[ $(digest "$3") == "$reference" ]] || fail "$1: another digest: $(digest "$3")"
}
restarted() { # WHAT JOB
  [[ $(field "$2" Restarts) -ge 1 ]] || fail "$1: the job was not requeued"
  say "$1: stopped within $took_ms ms, $(field "$2" Restarts) restart, the same digest"
}

FAKE_CELL_MS=1 "$veduta" bake city.toml --out reference --workers 1 >reference.log 2>&1 || fail "baking alone"
reference=$(digest reference)
export FAKE_CELL_MS=40

edit warned city.toml
job=$(submit warned.sbatch)
in_the_middle warned
slurm scancel -b -s USR1 "$job" # as --signal=B:USR1@120 does
slurm scancel -s USR1 "$job"    # and once more, to the ranks themselves
stops "warned twice"
FAKE_CELL_MS=1
completes "warned twice" "$job" warned
restarted "warned twice" "$job"

FAKE_CELL_MS=40
edit preempted city.toml
job=$(submit preempted.sbatch)
in_the_middle preempted
slurm sbatch -p high --nodes=2 --output=high.log --wrap "sleep 1" >/dev/null
for _ in $(seq 300); do [[ $(field "$job" PreemptTime) == None ]] || break; sleep 0.1; done
stops "pre-empted"
completes "pre-empted" "$job" preempted
restarted "pre-empted" "$job"

edit cancelled city.toml
job=$(submit cancelled.sbatch)
in_the_middle cancelled
slurm scancel "$job"
stops "cancelled"
ends "$job" CANCELLED
sleep 1
[[ $(field "$job" Restarts) -eq 0 ]] || fail "a cancelled job came back"
before=$(done_of cancelled)
job=$(submit cancelled.sbatch)
completes "submitted again" "$job" cancelled
grep -q "continuing: $before of 200 cells are done" veduta-"$job".log || fail "submitted again, the bake did not go on from cell $before"
say "cancelled: stopped within $took_ms ms, submitted again from cell $before to the same digest"

# --- where nothing comes on
printf "[scene]\nmodell = 'city.json'\n" >mistaken.toml
edit mistaken mistaken.toml
job=$(submit mistaken.sbatch)
ends "$job" FAILED
[[ $(field "$job" Restarts) -eq 0 && $(field "$job" ExitCode) == 2:0 ]] || fail "a mistake was tried again, or its status lost: $(field "$job" ExitCode)"
edit stuck city.toml
job=$(FAKE_FAIL=74 submit stuck.sbatch)
ends "$job" FAILED
[[ $(field "$job" Restarts) -eq 1 && $(field "$job" ExitCode) == 75:0 ]] || fail "no end of attempts without progress"
say "a mistake is not tried again; a bake that does not come on is, once"
