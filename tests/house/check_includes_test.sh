#!/usr/bin/env bash
# Plants includes in a small tree: each bad one must be found, each good one let through.
set -euo pipefail
check="$(dirname "${BASH_SOURCE[0]}")/check_includes.sh"
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failed=0

plant() { # FOLDER INCLUDE: a tree of this one line
  rm -rf "${tree:?}"/*
  mkdir -p "$tree/scene" "$tree/$1/inner"
  echo 'struct Scene {};' >"$tree/scene/scene.h"
  printf '// a comment\n%s\n' "$2" >"$tree/$1/inner/planted.h"
}
expect_bad() {
  plant "$1" "$2"
  local said
  if said=$(bash "$check" "$tree"); then
    echo "not found: $2 in $1/"; failed=1
  elif [[ $said != *"$1/inner/planted.h:2"* ]]; then
    echo "found, but not its place: $2 in $1/: $said"; failed=1
  fi
}
expect_good() {
  plant "$1" "$2"
  bash "$check" "$tree" >/dev/null || { echo "wrongly refused: $2 in $1/"; failed=1; }
}

expect_bad scene '#include "pvs/city.h"'
expect_bad pvs '#include "worker/settings.h"'
expect_bad pvs '  #  include "merge/merge.h"'
expect_bad gl '#include "scene/scene.h"'
expect_bad worker '#include "farm/log.h"'
expect_bad worker '#include "viewer/frame.h"'
expect_bad merge '#include "worker/protocol.h"'
expect_bad verify '#include "farm/log.h"'
expect_bad export '#include "farm/log.h"'
expect_bad farm '#include "worker/panorama.h"'
expect_bad farm '#include "gl/egl_context.h"'
expect_bad farm '#include "viewer/frame.h"'
expect_bad viewer '#include "worker/settings.h"'
expect_bad viewer '#include "verify/verify.h"'
expect_bad scene '#include "scene.h"'
expect_bad viewer '#include "../scene/scene.h"'
expect_bad viewer '#include <scene/scene.h>'
for folder in scene pvs gl worker merge verify export viewer; do expect_bad $folder '#include <mpi.h>'; done
for folder in scene gl worker merge verify export farm viewer; do expect_bad $folder '#include <hdf5.h>'; done
for folder in scene pvs merge verify export farm; do
  expect_bad $folder '#include <epoxy/gl.h>'
  expect_bad $folder '#include <EGL/egl.h>'
done
for folder in worker verify; do expect_bad $folder '#include <embree3/rtcore.h>'; done
expect_bad pvs '#include <CGAL/Simple_cartesian.h>'

expect_good scene '#include <vector>'
expect_good pvs '#include <hdf5.h>'
expect_good gl '#include "scene/error.h"'
expect_good worker '#include "worker/reference/grid_reference.h"'
expect_good worker '#include <epoxy/egl.h>'
expect_good farm '#include <mpi.h>'
expect_good farm '#include "worker/protocol.h"'
expect_good viewer '#include "gl/egl_context.h"'
expect_good scene '#include <embree3/rtcore.h>'

rm -rf "${tree:?}"/*
if bash "$check" "$tree" >/dev/null; then echo "an empty tree passed"; failed=1; fi
[[ $failed -eq 0 ]] && echo "every planted include was judged rightly"
exit $failed
