# shellcheck shell=bash
# Several pretended hosts on one machine, for the tests of this folder. Sourced, after `set -euo pipefail`:
#   enter_hosts "$@"; make_hosts 3; on_host h0 COMMAND...; kill_host h2; living_on h1
# Each host is a network namespace with a name, an address and a /dev/shm of its own, joined by a bridge; a mount made on one is seen
# there alone. Where namespaces are not permitted, the hosts are loopback addresses with this machine's name: $separate is then 0.
# Every process of a host carries HOST_MARK in its environment, by which it is found. Nothing of it outlives the script: in namespaces the
# first process's end is the end of all.

enter_hosts() { # ARGUMENTS-OF-THE-SCRIPT...
  if [[ -z ${IN_HOSTS:-} ]]; then
    local -a spaces=(unshare --net --uts --mount --pid --fork --kill-child --mount-proc)
    if [[ $(id -u) -ne 0 ]]; then spaces+=(--map-root-user); fi
    if "${spaces[@]}" true 2>/dev/null; then exec env IN_HOSTS=namespaces "${spaces[@]}" bash "$0" "$@"; fi
    IN_HOSTS=loopback
  fi
  separate=0
  if [[ $IN_HOSTS == namespaces ]]; then separate=1; fi
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  work=$(mktemp -d)
  hosts=()
  trap leave_hosts EXIT
}

leave_hosts() {
  local name
  for name in "${hosts[@]}"; do kill_host "$name"; done
  rm -rf "$work"
}

# Sets hosts=(h0 h1 ...) and writes $work/hostfile, with `slots=1` each.
make_hosts() { # COUNT
  local number
  hosts=()
  if [[ $separate -eq 1 ]]; then
    ip link set lo up
    ip link add bridge0 type bridge
    ip link set bridge0 up
    { echo "127.0.0.1 localhost"; for ((number = 0; number < $1; ++number)); do echo "10.83.0.$((number + 1)) h$number"; done; } >"$work/etc-hosts"
    mount --bind "$work/etc-hosts" /etc/hosts
  fi
  for ((number = 0; number < $1; ++number)); do
    if [[ $separate -eq 1 ]]; then make_host "h$number" "10.83.0.$((number + 1))"; else hosts+=("127.0.0.$((number + 1))"); fi
  done
  printf '%s slots=1\n' "${hosts[@]}" >"$work/hostfile"
  # What mpirun starts instead of ssh: the host, then a command for its shell.
  # shellcheck disable=SC2016
  printf '#!/usr/bin/env bash\nseparate=%s work=%q\nsource %q\nhost=$1\nshift\non_host "$host" sh -c "$*"\n' \
    "$separate" "$work" "$(realpath "${BASH_SOURCE[0]}")" >"$work/agent"
  chmod +x "$work/agent"
}

make_host() { # NAME ADDRESS
  unshare --net --uts --mount sh -c "hostname $1; mount -t tmpfs tmpfs /dev/shm; exec sleep infinity" &
  local keeper=$!
  until [[ $(readlink /proc/$keeper/ns/net) != $(readlink /proc/self/ns/net) && $(cat /proc/$keeper/comm) == sleep ]]; do sleep 0.02; done
  ip link add "$1" type veth peer name eth0 netns "$keeper"
  ip link set "$1" master bridge0 up
  nsenter -t "$keeper" -n sh -c "ip link set lo up; ip address add $2/24 dev eth0; ip link set eth0 up"
  echo "$keeper" >"$work/keeper-$1"
  hosts+=("$1")
}

on_host() { # NAME COMMAND...
  local -a enter=()
  if [[ $separate -eq 1 ]]; then enter=(nsenter -t "$(cat "$work/keeper-$1")" --net --uts --mount --wdns="$PWD"); fi
  local name=$1
  shift
  "${enter[@]}" env HOST_MARK="$work/$name" "$@"
}

# Processes of a host; by name when one is given.
living_on() { # NAME [PROGRAM]
  local process
  for process in /proc/[0-9]*; do
    # A zombie has no environment any more.
    if tr '\0' '\n' 2>/dev/null <"$process/environ" | grep -qx "HOST_MARK=$work/$1" && [[ -z ${2:-} || $(cat "$process/comm" 2>/dev/null) == "$2" ]]; then
      echo "${process#/proc/}"
    fi
  done 2>/dev/null
}

# As a power cut would: everything at once, without a word.
kill_host() { # NAME
  local -a all
  mapfile -t all < <(living_on "$1")
  if [[ ${#all[@]} -gt 0 ]]; then kill -9 "${all[@]}" 2>/dev/null || true; fi
}
