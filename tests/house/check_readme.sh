#!/usr/bin/env bash
# check_readme.sh ROOT: fails when the README has 150 lines or more, or names a file of ours that is not there.
set -euo pipefail
cd "$1"
bad=0
lines=$(wc -l <README.md)
[[ $lines -lt 150 ]] || { echo "README.md: $lines lines; under 150 serve the first minute"; bad=1; }
while read -r link; do
  [[ $link == *://* || $link == \#* || -e ${link%%#*} ]] || { echo "README.md: $link: no such file"; bad=1; }
done < <(grep -oE '\]\([^)]+\)' README.md | sed 's/^](//; s/)$//')
exit $bad
