# What the scripts share; sourced by them. Leaves the caller in the repository's root.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

say() { printf '\n== %s\n' "$*"; }

# One job a processor, but no more than one a GiB of free memory: compilers need much of it.
jobs=$(nproc)
free_gib=$(awk '/MemAvailable/ { print int($2 / 1048576) }' /proc/meminfo)
if [ "$free_gib" -lt "$jobs" ]; then jobs=$((free_gib > 1 ? free_gib : 1)); fi

# build_preset PRESET [TARGET...]: configures and builds; without targets, everything.
build_preset() {
  local preset=$1
  shift
  say "building preset $preset ($jobs jobs)"
  cmake --preset "$preset" && cmake --build --preset "$preset" -j "$jobs" ${1:+--target "$@"}
}

# need COMMAND...: installs the packages of development where one of the commands is missing.
need() {
  local command
  for command in "$@"; do
    if ! command -v "$command" >/dev/null; then
      scripts/setup.sh --dev >&2
      return
    fi
  done
}

# major_version COMMAND: of an LLVM tool. Other versions have other checks and another layout.
major_version() { "$1" --version | sed -nE 's/.*version ([0-9]+)\..*/\1/p' | head -1; }

# need_version COMMAND MAJOR: names the command of this version, COMMAND-MAJOR where there is one.
need_version() {
  local command=$1
  need "$command"
  if command -v "$1-$2" >/dev/null; then command=$1-$2; fi
  if [ "$(major_version "$command")" != "$2" ]; then
    echo "$command: found version $(major_version "$command"), expected $2 (Debian 12's)" >&2
    return 1
  fi
  echo "$command"
}
