#!/bin/bash
# Runs the tests of the C interface under valgrind: handles that are null, freed or invented,
# structs and strings of other sizes, pixels of any layout, calls of several threads. An error or a
# definite leak fails. Prints a line for docs/reliability.md. Needs minutes: valgrind is some 50
# times slower.
#   scripts/valgrind.sh            all but the tests whose work is long (scout, tracker, memory)
#   scripts/valgrind.sh TEST...    these; tests/bindings/c/main.c has their names
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

tests=(versions nulls strings structs images options log models limits busy depth handles)
if [ $# -gt 0 ]; then tests=("$@"); fi

need valgrind
build_preset release c_interface_test

say "C interface under valgrind: ${tests[*]}"
build=$PWD/build/release
log=$build/valgrind.log
result=0
# One process: loading the libraries takes long. In the build folder: tests write files.
(cd "$build" && valgrind --error-exitcode=9 --leak-check=full --num-callers=25 \
  --show-leak-kinds=definite,possible --errors-for-leak-kinds=definite \
  --suppressions="$OLDPWD/tests/valgrind.supp" \
  --log-file="$log" tests/bindings/c/c_interface_test host/bindings/c/libedgescout_c.so \
  "$OLDPWD/docs/examples" "${tests[@]}") || result=$?
if [ "$result" != 0 ]; then sed -n 1,200p "$log"; fi

# Where nothing is lost there is no line of it.
count() { sed -nE "s/^.*$1: ([0-9,]+) .*/\1/p" "$log" | tail -1; }
lost=$(count 'definitely lost')
printf '| %s | %s | %s | %s errors, %s bytes lost |\n' "$(date -u +%F)" \
  "$(git rev-parse --short=12 HEAD)" "${#tests[@]}" "$(count 'ERROR SUMMARY')" "${lost:-0}"
exit "$result"
