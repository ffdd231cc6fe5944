#!/bin/bash
# Installs what is missing, builds, and runs the whole test suite in the release preset; then the tests of kernels, core
# and files once more under the address and undefined-behaviour sanitizers, and a build of the kernels alone without Vulkan.
#   scripts/test.sh             all of that
#   scripts/test.sh PRESET...   the whole suite in each of these presets, nothing else
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

summary=()
failed=0

# test_preset PRESET [CTEST OPTION...]: runs the tests; a failure is kept for the end.
test_preset() {
  local preset=$1 log=build/$1/ctest.log
  shift
  say "testing preset $preset"
  ctest --preset "$preset" -j "$jobs" "$@" | tee "$log" || failed=1
  summary+=("$preset: $(grep -E 'tests passed, .* failed out of|No tests were found' "$log" || echo 'ctest did not finish')")
  # Programs that are one test each say it in their own output.
  summary+=("$(sed -nE 's/^\[  SKIPPED \] (.*) \([0-9]+ ms\)$/  skipped: \1/p' "build/$preset/Testing/Temporary/LastTest.log")")
}

# Recorded data that lies beside the checkout; tests that need it are skipped elsewhere.
if [ -z "${EDGESCOUT_DATA:-}" ] && [ -d ../shared/data ]; then
  EDGESCOUT_DATA=$(realpath ../shared/data)
  export EDGESCOUT_DATA
fi

scripts/setup.sh
if [ "$#" -gt 0 ]; then
  for preset in "$@"; do
    build_preset "$preset"
    test_preset "$preset"
  done
else
  build_preset release
  test_preset release
  build_preset asan kernels_test core_test io_test
  test_preset asan -R '^(kernels|core|io)\.'
  say "building the kernels alone, without Vulkan"
  cmake --preset cpu-only -B build/kernels-only -DEDGESCOUT_HOST=OFF
  cmake --build build/kernels-only -j "$jobs"
fi

say "summary"
printf '%s\n' "${summary[@]}"
exit "$failed"
