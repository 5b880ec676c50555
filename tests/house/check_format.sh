#!/usr/bin/env bash
# check_format.sh ROOT: fails when clang-format would change a C++ file; status 77 (skipped) without clang-format.
set -euo pipefail
cd "$1"
if ! command -v clang-format >/dev/null; then
  echo "skipped: no clang-format here; apt-get install clang-format"
  exit 77
fi
# What git tracks; in an unpacked archive, everything.
if ! files=$(git ls-files '*.cpp' '*.h' 2>/dev/null); then
  files=$(find . \( -name build -o -name out \) -prune -o \( -name '*.cpp' -o -name '*.h' \) -print)
fi
mapfile -t files < <(printf '%s\n' "$files" | while read -r file; do [[ -f $file ]] && printf '%s\n' "$file"; done)
[[ ${#files[@]} -gt 0 ]] || { echo "check_format.sh: $1: no C++ file found"; exit 1; }
clang-format --dry-run -Werror "${files[@]}"
echo "${#files[@]} files are as clang-format would write them"
