# What demo.sh and test.sh share; sourced by them. Leaves the caller in the repository's root.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

say() { printf '\n== %s\n' "$*"; }

# One job a processor, but no more than one a GiB of free memory: compilers of templates and sanitizers are hungry.
jobs=$(nproc)
free_gib=$(awk '/MemAvailable/ { print int($2 / 1048576) }' /proc/meminfo)
if [ "$free_gib" -lt "$jobs" ]; then jobs=$((free_gib > 1 ? free_gib : 1)); fi

# build_preset PRESET [TARGET...]: configures and builds; without targets, everything.
build_preset() {
  local preset=$1
  shift
  say "building preset $preset ($jobs jobs)"
  cmake --preset "$preset"
  cmake --build --preset "$preset" -j "$jobs" ${1:+--target "$@"}
}
