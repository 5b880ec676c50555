#!/usr/bin/env bash
# From a fresh clone on a bare Debian 12 to a baked city, verified, with a stereo picture: ./bake.sh [CONFIG]
# CONFIG: a bake configuration (TOML), by default configs/demo.toml: Den Haag. Everything goes to out/NAME-OF-CONFIG/.
# Run again, it takes up where it stopped.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
[[ $# -le 1 ]] || { echo "bake.sh: one argument at most: ./bake.sh [CONFIG]" >&2; exit 2; }
case ${1:-} in
  -h | --help) echo "use: ./bake.sh [CONFIG]   CONFIG: a bake configuration (TOML), by default configs/demo.toml"; exit 0 ;;
  -*) echo "bake.sh: $1: no such option; use: ./bake.sh [CONFIG]" >&2; exit 2 ;;
esac
config=$(realpath -m -- "${1:-$root/configs/demo.toml}")
[[ -f $config ]] || { echo "bake.sh: $config: no such file; give a bake configuration, or none for the demo" >&2; exit 2; }
cd "$root"
name=$(basename "$config" .toml)
out=out/$name
bin=build/release/bin
cores=$(nproc)

# One line per step with its time; a step that fails ends the script with its status.
summary=()
run_step() {
  local what=$1 begin=$SECONDS status=0
  shift
  echo "== $what"
  "$@" || status=$?
  summary+=("$(printf '%-28s %4d s' "$what" $((SECONDS - begin)))")
  if [[ $status -ne 0 && ! " ${tolerated[*]} " == *" $status "* ]]; then
    echo "bake.sh: $what failed with status $status (above); after the remedy, the same command goes on from there" >&2
    exit "$status"
  fi
  last_status=$status
}
tolerated=()

build() {
  cmake --preset release >/dev/null && cmake --build --preset release
}

bake() {
  # A shepherd and its worker per core. mpirun refuses root unless told twice; containers often are.
  if [[ $(id -u) -eq 0 ]]; then export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1; fi
  # Not bound to cores: preparing the city is one process with a thread per core. 15 s to finish cells when stopped.
  mpirun -n "$cores" --oversubscribe --bind-to none --mca odls_base_sigkill_timeout 15 \
    "$bin/veduta" bake "$config" --out "$out" --workers 1
}

unset DISPLAY WAYLAND_DISPLAY
run_step "packages" cmake/install_packages.sh
run_step "build" build
tolerated=(3) # complete, with cells recorded all visible: safe, and said by the bake
run_step "bake and merge" bake
baked=$last_status
tolerated=()
run_step "verify" "$bin/veduta" verify "$out/city.pvs.h5" --json "$out/verify.json"
run_step "stereo pictures" "$bin/veduta-view" "$out/city.pvs.h5" --headless --stereo side-by-side --out "$out/pictures"

echo
printf '%s\n' "${summary[@]}"
echo
echo "city with its visibility     $out/city.pvs.h5"
echo "verification                 $out/verify.json"
echo "stereo pictures              $out/pictures/"
exit "$baked"
