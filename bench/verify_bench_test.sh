#!/usr/bin/env bash
# verify_bench_test.sh PROGRAM: what the benchmark answers on a small generated city, not how fast it was.
set -euo pipefail
program=$1
fail() { echo "FAILED: $*" >&2; exit 1; }

out=$(echo '{"blocks": 6, "cells": 3, "rays": 20000, "eyes": 20, "threads": 2, "repeats": 1}' | "$program") || fail "$out"
expect() { grep -q "$1" <<<"$out" || fail "no '$1' in: $out"; }
expect '"triangles": 444'
expect '"cells": 3'
expect '"rays": 60000'
expect '"threads": 2'
for rate in "one by one" "packets of 8, coherent" "packets of 8" "packets of 16, coherent" "packets of 16" \
  "packets of 16, coherent, sorted" checking_rays_per_s verify_rays_per_s; do expect "\"$rate\": [1-9]"; done
for share in checking_over_bare verify_over_bare checking_over_bare_as_shot verify_over_bare_as_shot set_up eyes directions tracing \
  settling rest; do expect "\"$share\": [0-9]"; done

refused() { # INPUT WORDS
  local errors
  if errors=$(echo "$1" | "$program" 2>&1 >/dev/null); then fail "taken: $1"; fi
  [[ $(wc -l <<<"$errors") -eq 1 ]] && grep -q "$2" <<<"$errors" || fail "$1: $errors"
}
refused 'no json' 'parse error'
refused '{}' 'blocks'
refused '{"blocks": 6, "cell": 3}' 'no key "cell"'
refused '{"file": "/none.pvs.h5"}' 'none.pvs.h5'
