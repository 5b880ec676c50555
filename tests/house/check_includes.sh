#!/usr/bin/env bash
# check_includes.sh ROOT: fails, naming file and line, when an #include goes against the arrows of docs/architecture.md.
set -euo pipefail
cd "$1"

# Folder, and what it may include: folders, or single headers. Every folder may include itself.
declare -A may=(
  [scene]=""
  [pvs]="scene"
  [gl]="scene/error.h"
  [worker]="gl pvs scene"
  [merge]="pvs scene"
  [verify]="pvs scene"
  [sweep]="verify pvs scene"
  [export]="pvs scene"
  [farm]="export merge sweep verify pvs scene worker/protocol.h worker/settings.h worker/settings_keys.h worker/import_options.h"
  [viewer]="gl pvs scene"
)
# System headers that only some folders may include: a pattern, then those folders.
only=(
  "^(mpi\.h|mpi/.*)$|farm"
  "^(hdf5.*|H5.*)$|pvs"
  "^(epoxy|EGL|GL|GLES.?|GLFW)/|gl worker viewer"
  "^embree|scene"
  "^CGAL/|scene worker verify"
)

bad=0 files=0
complain() { echo "$1: $2"; bad=1; }

allowed() { # FOLDER HEADER
  local target
  for target in "$1" ${may[$1]}; do
    [[ $2 == "$target" || $2 == "$target"/* ]] && return 0
  done
  return 1
}

check_line() { # PLACE FOLDER INCLUDED, with its quotes
  local header=${3:1:-1} rule folders
  if [[ $3 == \"* ]]; then
    allowed "$2" "$header" || complain "$1" "$2/ must not include \"$header\""
    return
  fi
  for rule in "${only[@]}"; do
    folders=${rule##*|}
    [[ $header =~ ${rule%|*} && " $folders " != *" $2 "* ]] && complain "$1" "$2/ must not include <$header>; only: $folders"
  done
  # Our own headers in angle brackets would pass by the rules above.
  [[ -e $header ]] && complain "$1" "<$header> is ours: include it in quotes"
  return 0
}

include='^[[:space:]]*#[[:space:]]*include[[:space:]]*([<"][^">]+[">])'
for folder in "${!may[@]}"; do
  [[ -d $folder ]] || continue
  while IFS= read -r file; do
    files=$((files + 1))
    number=0
    while IFS= read -r line || [[ -n $line ]]; do
      number=$((number + 1))
      [[ $line =~ $include ]] && check_line "$file:$number" "$folder" "${BASH_REMATCH[1]}"
    done <"$file"
  done < <(find "$folder" -name '*.h' -o -name '*.cpp' -o -name '*.c' | sort)
done
[[ $files -gt 0 ]] || { echo "check_includes.sh: $1: no source file found"; exit 1; }
[[ $bad -eq 0 ]] && echo "$files files, no include against the arrows"
exit $bad
