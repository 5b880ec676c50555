#!/usr/bin/env bash
# Builds and runs every test, here or on a bare Debian 12: ./test.sh
# Packages that are missing are installed (as root, or with sudo). Ends with what ctest says.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
cores=$(nproc)

# Parts that read untrusted bytes or do arithmetic on raw buffers run under the sanitizers too; GL and MPI libraries
# have leaks of their own.
sanitized=(scene pvs library fuzz merge verify sweep export)

step() { echo "== $(date +%T) $*"; }
fail() { echo "test.sh: $*" >&2; exit 1; }

cmake/install_packages.sh
unset DISPLAY WAYLAND_DISPLAY # every test is headless
if [[ $(id -u) -eq 0 ]]; then # containers run as root, which mpirun refuses unless told twice
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi

step "sanitizers: build of ${sanitized[*]}"
cmake --preset asan >/dev/null || fail "configuring preset asan failed (above)"
cmake --build --preset asan --target "${sanitized[@]/#/tests_}" || fail "the build under preset asan failed (above)"
step "sanitizers: tests of ${sanitized[*]}"
ctest --preset asan -j "$cores" -L "^($(IFS='|'; echo "${sanitized[*]}"))\$" || fail "tests failed under the sanitizers (above)"

step "build"
cmake --preset dev >/dev/null || fail "configuring preset dev failed (above)"
cmake --build --preset dev || fail "the build under preset dev failed (above)"
step "tests"
ctest --preset dev -j "$cores"
