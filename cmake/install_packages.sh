#!/usr/bin/env bash
# Installs what cmake/packages.txt lists and this machine lacks. With nothing missing it touches neither network nor root.
set -euo pipefail
list="$(dirname "${BASH_SOURCE[0]}")/packages.txt"

missing=()
while read -r package; do
  [[ -z $package || $package == \#* ]] && continue
  status=$(dpkg-query -W -f='${db:Status-Abbrev}' "$package" 2>/dev/null || true)
  [[ $status == ii* ]] || missing+=("$package")
done <"$list"
[[ ${#missing[@]} -eq 0 ]] && exit 0

if ! command -v apt-get >/dev/null; then
  echo "install_packages.sh: this is no Debian system; install what matches: ${missing[*]}; then build with cmake --preset release" >&2
  exit 2
fi
as_root=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "install_packages.sh: packages are missing and you are not root; have these installed: ${missing[*]}" >&2
    exit 2
  fi
  as_root=(sudo)
fi

apt() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q "$@" </dev/null; }
# Mirrors fail now and then: one more try.
twice() { "$@" || { sleep 5; "$@"; }; }

echo "== installing ${#missing[@]} packages: ${missing[*]}"
if ! twice apt update || ! twice apt install -y --no-install-recommends "${missing[@]}"; then
  echo "install_packages.sh: apt-get failed (above); is there a network? needed: ${missing[*]}" >&2
  exit 74
fi
