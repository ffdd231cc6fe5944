#!/bin/bash
# Installs what is missing, builds, and runs what every change must pass.
#   scripts/test.sh             formatting; links; the suite in the release preset without its
#                               longest tests; the guard on recall and false poses; pages of the
#                               C++ API; clang-tidy on recently changed files; the tests of core
#                               and io, and the readers of files on the saved corpus of the
#                               fuzzer, under the address and undefined-behaviour sanitizers; the
#                               kernels alone without Vulkan
#   scripts/test.sh --long      clang-tidy on all files; the whole suite built by clang 16, under
#                               the address and undefined-behaviour sanitizers, and under the thread
#                               sanitizer; the C interface under valgrind; the fuzzer for 30 s per
#                               reader; the packages in a fresh Debian. Prints a line for
#                               docs/reliability.md
#   scripts/test.sh PRESET...   the whole suite in each of these presets, nothing else
# A step that fails does not keep the others from running.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

summary=()
failed=0
cells=()  # of the line for docs/reliability.md

# step NAME COMMAND...: runs it; a failure is kept for the end.
step() {
  local name=$1 start=$SECONDS verdict=passed
  shift
  say "$name"
  "$@" || verdict=FAILED
  if [ "$verdict" = FAILED ]; then failed=1; fi
  summary+=("$name: $verdict, $((SECONDS - start)) s")
  cells+=("$verdict, $(((SECONDS - start + 59) / 60)) min")
}

# report NAME COMMAND...: the same, but a failure is only reported. For clang-tidy, until all files
# are without findings: which files fit into its time differs from machine to machine.
report() {
  local before=$failed
  step "$@"
  failed=$before
}

# test_preset PRESET [CTEST OPTION...]: runs the tests.
test_preset() {
  local preset=$1 log=build/$1/ctest.log result=0
  shift
  ctest --preset "$preset" -j "$jobs" "$@" | tee "$log" || result=1
  summary+=("$preset: $(grep -E 'tests passed, .* failed out of|No tests were found' "$log" ||
    echo 'ctest did not finish')")
  # Programs that are one test each name what they skip in their own output.
  summary+=("$(sed -nE 's/^\[  SKIPPED \] (.*) \([0-9]+ ms\)$/  skipped: \1/p' \
    "build/$preset/Testing/Temporary/LastTest.log")")
  return "$result"
}

build_and_test() { build_preset "$1" && test_preset "$1"; }

# The long tests (label long, tests/CMakeLists.txt) run in the whole suites alone.
release_without_long_tests() { build_preset release && test_preset release -LE long; }

# Whether they compile; nothing of it runs.
kernels_alone() {
  cmake --preset cpu-only -B build/kernels-only -DEDGESCOUT_HOST=OFF \
    -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0 &&
    cmake --build build/kernels-only -j "$jobs"
}

checked_parts() {
  build_preset asan-parts core_test io_test fuzz_test && test_preset asan-parts -R '^(core|io|fuzz)\.'
}

api_pages() { cmake --build --preset release --target docs; }

every_change() {
  step "formatting" scripts/format.sh --check
  step "links of the documents" python3 scripts/check_links.py
  step "release: build and tests" release_without_long_tests
  step "recall and false poses" scripts/guard.sh
  step "pages of the C++ API" api_pages
  report "clang-tidy, changed files" env TIDY_SECONDS="${TIDY_SECONDS:-60}" scripts/tidy.sh
  step "address sanitizer: core, io, corpus" checked_parts
  step "kernels alone, without Vulkan" kernels_alone
}

long_run() {
  step "clang-tidy, all files" scripts/tidy.sh --all
  step "clang 16: build and tests" build_and_test clang
  step "address sanitizer: build and tests" build_and_test asan
  step "thread sanitizer: build and tests" build_and_test tsan
  step "C interface under valgrind" scripts/valgrind.sh
  step "fuzzer: 30 s per reader" scripts/fuzz.sh 30
  step "packages in a fresh Debian" scripts/packages_test.sh
}

# Recorded data that lies beside the checkout; tests that need it are skipped elsewhere.
if [ -z "${EDGESCOUT_DATA:-}" ] && [ -d ../shared/data ]; then
  EDGESCOUT_DATA=$(realpath ../shared/data)
  export EDGESCOUT_DATA
fi
# Inputs as users have them, with the right answers.
if [ -z "${EDGESCOUT_FIELD:-}" ] && [ -d ../shared/field ]; then
  EDGESCOUT_FIELD=$(realpath ../shared/field)
  export EDGESCOUT_FIELD
fi

scripts/setup.sh --dev
case "${1:-}" in
  '') every_change ;;
  --long) long_run ;;
  -*)
    echo "test: found $1, expected --long, names of presets or nothing" >&2
    exit 2
    ;;
  *)
    for preset in "$@"; do
      step "$preset: build and tests" build_and_test "$preset"
    done
    ;;
esac

say "summary"
printf '%s\n' "${summary[@]}" | sed '/^$/d'
echo "all: $(((SECONDS + 59) / 60)) min"
if [ "${1:-}" = --long ]; then
  say "line for docs/reliability.md"
  printf '| %s | %s |' "$(date -u +%F)" "$(git rev-parse --short=12 HEAD)"
  printf ' %s |' "${cells[@]}"
  printf '\n'
fi
exit "$failed"
