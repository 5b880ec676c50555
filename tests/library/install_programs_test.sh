#!/usr/bin/env bash
# install_programs_test.sh BUILD_DIRECTORY TOY_FILE CMAKE: installs everything, and runs what was installed.
set -euo pipefail
build=$1 toy_file=$2 cmake=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "install_programs_test.sh: $*" >&2; exit 1; }

"$cmake" --install "$build" --prefix "$work/prefix" >"$work/install.log" || fail "the installation failed"
for file in bin/veduta bin/veduta-worker bin/veduta-view include/veduta/pvs.h; do
  [[ -f $work/prefix/$file ]] || fail "$file missing"
done
"$toy_file" "$work/toy.pvs.h5"
"$work/prefix/bin/veduta" info "$work/toy.pvs.h5" >"$work/said" || fail "the installed veduta reads no file"
grep -q EPSG:7415 "$work/said" || fail "veduta info said: $(cat "$work/said")"
"$work/prefix/bin/veduta-view" --help >/dev/null || fail "the installed veduta-view does not start"
"$work/prefix/bin/veduta-worker" --help >/dev/null || fail "the installed veduta-worker does not start"
for program in veduta veduta-worker veduta-view; do
  if readelf -d "$work/prefix/bin/$program" | grep -F "$build"; then fail "$program looks into the build directory"; fi
done
echo "installed, and runs"
