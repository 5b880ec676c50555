#!/usr/bin/env bash
# full_disk_test.sh BIN FAKE_WORKER: the disk under shards/ fills up in the middle of a bake: status 74 and one line; with room
# made, the same command completes it. Status 77 (skipped) where a tmpfs cannot be mounted in a namespace of our own.
set -euo pipefail
bin=$1 worker=$2
if [[ ${3:-} != inside ]]; then
  unshare --mount --map-root-user true 2>/dev/null || { echo "skipped: no mount namespace is permitted here"; exit 77; }
  exec unshare --mount --map-root-user bash "$0" "$bin" "$worker" inside
fi
work=$(mktemp -d)
trap 'umount "$work/small" 2>/dev/null || true; rm -rf "$work"' EXIT
mkdir "$work/small"
mount -t tmpfs -o size=256k none "$work/small" 2>/dev/null || { echo "skipped: a tmpfs may not be mounted here"; exit 77; }
printf '%s\n' '[scene]' "model = 'city.json'" >"$work/demo.toml"
echo "a model that the fake worker does not read" >"$work/city.json"

# Only the shards are on the small disk, so that it is they that run out of it.
mkdir -p "$work/run"
ln -s "$work/small" "$work/run/shards"
export VEDUTA_WORKER=$worker FAKE_CELLS=4000 FAKE_CELL_MS=0
bake() { "$bin/veduta" bake "$work/demo.toml" --out "$work/run" --workers 2 "$@" 2>"$work/said"; }
fail() { echo "$*"; cat "$work/said"; exit 1; }

status=0; bake -q || status=$?
[[ $status == 74 ]] || fail "a full disk gave $status"
[[ $(wc -l <"$work/said") == 1 ]] || fail "more than one line"
grep -q '^veduta: .*/shards/.*: .*No space left on device' "$work/said" || fail "the line does not say where and what"
status=0; "$bin/veduta" status --exit-code "$work/run" >"$work/status" || status=$?
[[ $status == 75 ]] || fail "status of the stopped bake is $status"

status=0; bake -q || status=$?
[[ $status == 74 ]] || fail "the disk is still full, and again gave $status"

mount -o remount,size=64m "$work/small"
bake || fail "with room it does not complete"
grep -q '^continuing: [1-9][0-9]* of 4000 cells are done' "$work/said" || fail "it does not continue"
"$bin/veduta" status --exit-code "$work/run" >"$work/status" || fail "not complete"
digest=$(python3 -c 'import json,sys; print(json.load(open(sys.argv[1]))["merge"]["content_digest"])' "$work/run/report.json")
"$bin/veduta" bake "$work/demo.toml" --out "$work/undisturbed" --workers 2 >"$work/said" 2>&1 || fail "the reference failed"
grep -q "digest $digest" "$work/said" || fail "another digest than undisturbed: $digest"
echo "74 with a line while the disk was full, the same digest $digest after"
