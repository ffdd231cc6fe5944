#!/bin/bash
# Installs the Debian packages that are missing. Needs neither root nor network where all are there.
#   scripts/setup.sh             what the program needs (scripts/packages.txt)
#   scripts/setup.sh --bindings  also what other languages need (scripts/packages_bindings.txt)
#   scripts/setup.sh --dev       also what tests and checks need (scripts/packages_dev.txt)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

installed() { [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

lists=(scripts/packages.txt)
case "${1:-}" in
  '') ;;
  --bindings) lists+=(scripts/packages_bindings.txt) ;;
  --dev) lists+=(scripts/packages_bindings.txt scripts/packages_dev.txt) ;;
  *)
    echo "setup: found $1, expected --bindings, --dev or nothing" >&2
    exit 2
    ;;
esac

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  echo "setup: only Debian's packages are known here; install the like of ${lists[*]} yourself" >&2
  exit 1
fi

missing=()
while read -r package _; do
  case "$package" in '' | '#'*) continue ;; esac
  installed "$package" || missing+=("$package")
done < <(cat "${lists[@]}")

if [ "${#missing[@]}" = 0 ]; then
  echo "setup: every package is there"
  exit 0
fi
echo "setup: installing ${missing[*]}"
as_root apt-get update -qq
as_root env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -qq --no-install-recommends "${missing[@]}"
