#!/bin/bash
# Installs what the project needs and the machine lacks, from Debian's own packages (scripts/packages.txt).
# Does nothing, and needs neither root nor network, where everything is there.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

installed() { [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  echo "setup: this script knows Debian's packages only; install the likes of scripts/packages.txt yourself" >&2
  exit 1
fi

missing=()
while read -r package _; do
  case "$package" in '' | '#'*) continue ;; esac
  installed "$package" || missing+=("$package")
done < scripts/packages.txt

if [ "${#missing[@]}" = 0 ]; then
  echo "setup: every package is there"
  exit 0
fi
echo "setup: installing ${missing[*]}"
as_root apt-get update -qq
as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
