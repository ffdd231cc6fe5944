#!/bin/bash
# Gives the readers of files bytes that libFuzzer makes, one reader after the other, on one core
# that nothing else wants. Prints a row of docs/reliability.md for each.
#   scripts/fuzz.sh [SECONDS] [READER...]   SECONDS of the processor for each (default 60); all
#                                           readers. Several of these may run at once
#   scripts/fuzz.sh --keep [READER...]      makes the least corpus that reaches what was reached so
#                                           far, in tests/fuzz/corpus
# What is found lies in build/fuzz/found; `build/fuzz/tests/fuzz/edgescout_fuzz --reader=READER
# FILE` shows it again. A second run goes on where the first one ended (build/fuzz/work).
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

readers=(stl ply obj off cao camera_text camera_json poses targets results bop_camera bop_truth
  bop_models templates scout_state options image)

# The files that read what this reader is given.
sources_of() {
  case $1 in
    stl) echo host/io/{stl,text_tokens,polygon,mesh_file}.cpp ;;
    ply) echo host/io/{ply,ply_header,text_tokens,polygon,mesh_file}.cpp ;;
    obj | off | cao) echo host/io/{"$1",text_tokens,polygon,mesh_file}.cpp ;;
    camera_*) echo host/io/camera_*.cpp ;;
    poses) echo host/io/{poses,results,rotations,json_fields}.cpp ;;
    targets) echo host/io/{bop_targets,json_fields}.cpp ;;
    results) echo host/io/{bop_results,rotations,text_tokens}.cpp ;;
    bop_models) echo host/io/{bop_symmetries,json_fields}.cpp ;;
    bop_*) echo host/io/{bop,bop_layout,rotations,json_fields}.cpp ;;
    templates) echo host/model/template_file.cpp host/io/binary_file.cpp ;;
    scout_state) echo host/active/scout_state.cpp host/io/binary_file.cpp ;;
    options) echo host/cli/{config,renamed_options}.cpp ;;
    image) echo host/io/{image_header,tiff_header,png_chunks,exif}.cpp ;;
  esac
}

program=build/fuzz/tests/fuzz/edgescout_fuzz
idle=(chrt -i 0 nice -n 19)

work_of() { mkdir -p "build/fuzz/work/$1" && echo "build/fuzz/work/$1"; }

# Each run has its own folder for the files that readers get, in memory; it goes with the run.
scratch=$(mktemp -d --tmpdir="$([ -d /dev/shm ] && echo /dev/shm || echo /tmp)" edgescout-fuzz-XXXX)
trap 'rm -rf "$scratch"' EXIT
export TMPDIR=$scratch

fuzz() {
  LLVM_PROFILE_FILE=$scratch/%p.profraw "${idle[@]}" "$program" "--reader=$1" "${@:2}"
}

# Lines of the reader's own files that its corpus reaches.
lines_of() {
  local work
  work=$(work_of "$1")
  rm -f "$scratch"/*.profraw
  fuzz "$1" -runs=0 "$work" "tests/fuzz/corpus/$1" >"$scratch/replay.log" 2>&1
  llvm-profdata-16 merge -o "$scratch/all.profdata" "$scratch"/*.profraw
  # shellcheck disable=SC2046  # a list of files
  llvm-cov-16 export -summary-only -instr-profile="$scratch/all.profdata" "$program" \
    $(sources_of "$1") |
    python3 -c '
import json, sys
lines = json.load(sys.stdin)["data"][0]["totals"]["lines"]
print("{covered} of {count} ({percent:.0f} %)".format(**lines))'
}

# libFuzzer counts an input's time on the wall. A timeout of a machine that had no time for it is
# none: the input then takes less than a minute of the processor.
drop_false_timeouts() {
  local input still=no
  for input in build/fuzz/found/"$1"-timeout-*; do
    [ -e "$input" ] || continue
    if (ulimit -t 60 && fuzz "$1" "$input") >"$scratch/timeout.log" 2>&1; then
      rm "$input"
    else
      still=yes
    fi
  done
  [ $still = no ]
}

# Whether the run that ended with this log failed.
has_failed() {
  if tail -n 200 "$2" | grep -q 'ERROR: libFuzzer: timeout'; then ! drop_false_timeouts "$1"; fi
}

# What the processor spent on other programs does not count: libFuzzer counts time on the wall, so it
# goes on for what is missing, until the first failure.
run_reader() {
  local reader=$1 seconds=$2 work log found=no used=0 TIMEFORMAT='%U %S'
  work=$(work_of "$reader")
  log=$work.log
  mkdir -p build/fuzz/found
  : >"$log"
  while [ "$used" -lt "$seconds" ] && [ $found = no ]; do
    { time fuzz "$reader" -max_total_time="$((seconds - used))" -timeout=120 -max_len=8192 \
      -print_final_stats=1 -dict="tests/fuzz/dictionaries/$reader.dict" \
      -artifact_prefix="build/fuzz/found/$reader-" "$work" "tests/fuzz/corpus/$reader" \
      >>"$log" 2>&1 || ! has_failed "$reader" "$log" || found=yes; } 2>"$scratch/time"
    used=$(awk -v used="$used" '{ print int(used + $1 + $2 + 0.5) }' "$scratch/time")
  done
  if [ $found = yes ]; then
    failed=1
    grep -E 'ERROR|SUMMARY|what\(\)|runtime error|artifact' "$log" >&2
  fi
  printf '| %s | %s | %s | %s | %s | %s | %s files, %s KiB | %s |\n' "$(date -u +%F)" \
    "$(git rev-parse --short=12 HEAD)" "$reader" "$used" \
    "$(awk '/^stat::number_of_executed_units/ { sum += $2 } END { print sum }' "$log")" \
    "$(lines_of "$reader")" "$(find "$work" -type f | wc -l)" "$(du -sk "$work" | cut -f 1)" "$found"
}

# The files are named after their content, so a corpus that did not change stays as it is. Those
# named found-* were failures once; they stay.
keep() {
  local least=$scratch/$1 corpus=tests/fuzz/corpus/$1
  mkdir -p "$least"
  fuzz "$1" -set_cover_merge=1 "$least" "$corpus" "$(work_of "$1")" >"$scratch/merge.log" 2>&1
  find "$corpus" -type f ! -name 'found-*' -delete
  cp "$least"/* "$corpus"
  echo "$1: $(find "$corpus" -type f | wc -l) files, $(du -sbk "$corpus" | cut -f 1) KiB"
}

failed=0
action=run
seconds=60
if [ "${1:-}" = --keep ]; then
  action=keep
  shift
elif [[ "${1:-}" =~ ^[0-9]+$ ]]; then
  seconds=$1
  shift
fi
need clang++-16 llvm-cov-16
build_preset fuzz edgescout_fuzz >&2
if [ $# -eq 0 ]; then set -- "${readers[@]}"; fi
for reader in "$@"; do
  # shellcheck disable=SC2046  # a list of files
  ls -- $(sources_of "$reader") >/dev/null  # or its lines are counted without a file
  if [ "$action" = keep ]; then keep "$reader"; else run_reader "$reader" "$seconds"; fi
done
exit "$failed"
