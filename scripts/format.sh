#!/bin/bash
# Lays out all C and C++ files of the repository as .clang-format says, by clang-format 14.
#   scripts/format.sh           changes the files
#   scripts/format.sh --check   changes nothing; prints what differs and fails where something does
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

mode=(-i)
case "${1:-}" in
  '') ;;
  --check) mode=(--dry-run --Werror) ;;
  *)
    echo "format: found $1, expected --check or nothing" >&2
    exit 2
    ;;
esac

need git
clang_format=$(need_version clang-format 14)
start=$SECONDS
git ls-files -z '*.h' '*.cpp' '*.c' | xargs -0 -r -n 20 -P "$jobs" "$clang_format" "${mode[@]}"
echo "format: $(git ls-files '*.h' '*.cpp' '*.c' | wc -l) files, $((SECONDS - start)) s"
