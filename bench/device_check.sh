#!/bin/bash
# Measures and tests edgescout on a machine with a graphics card and its driver. Needs no compiler,
# no Vulkan headers and no network: bench/make_bundle.sh has packed the programs.
#
#   bench/device_check.sh BUNDLE.tar.xz OUT
#
# Takes less than six minutes. Every step has its own limit of time, so that one that fails or hangs
# does not cost the others. The end status is 0 where all steps passed. OUT gets seven files:
#   summary.md        what passed, how long it took, and the figures of the batch
#   log.txt           all that the steps printed
#   devices.md, .json the stages of one frame and every kernel on every device, against the CPU
#   kernels.json      what edgescout_bench measured: a list with an entry a device
#   kernels_test.txt  what the kernels' tests printed
#   batch.json        a batch of images on the CPU and on the card
#
# Shorter for a rehearsal on a slow device, all from the environment:
#   IMAGES=60       images of the batch
#   REPETITIONS=7   of every stage and kernel
#   SCALE=1         of bench devices' image
#   SMALL=          not empty: edgescout_bench times its small sizes alone
#   TESTS='*'       filter of the kernels' tests
#   TEMPLATES=      options of bench devices and detect (--viewpoints 1 --in-plane-steps 4)
#   TIMES=1         factor on every limit of time
#   DEVICE=vulkan   the device of the batch
set -uo pipefail
[ $# = 2 ] || { sed -n '5p' "$0" >&2; exit 2; }
bundle=$1 out=$2
images=${IMAGES:-60} repetitions=${REPETITIONS:-7} scale=${SCALE:-1} small=${SMALL:-}
tests=${TESTS:-*} times=${TIMES:-1} device=${DEVICE:-vulkan}
templates=${TEMPLATES:-}
in_all=$((350 * times))
mkdir -p "$out" || exit
out=$(cd "$out" && pwd)
work=$(mktemp -d)
export XDG_CACHE_HOME=$work/caches  # templates that other runs have kept are not read
trap 'rm -rf "$work"' EXIT
log=$out/log.txt
: >"$log"
declare -A took  # seconds of a step
rows='' failed=0

# step NAME LIMIT COMMAND...: runs it for at most LIMIT seconds and notes how it ended.
step() {
  local name=$1 limit=$(($2 * times)) left=$((in_all - SECONDS)) begin end rc=0 word
  shift 2
  [ "$limit" -le "$left" ] || limit=$left
  printf '\n== %s\n' "$name" | tee -a "$log"
  begin=$(date +%s%N)
  if [ "$limit" -lt 1 ]; then
    rc=skipped word='no time left'
  else
    # A group of its own: what the command has started ends with it.
    timeout -k 3 "$limit" "$@" >>"$log" 2>&1 || rc=$?
    case $rc in
      0) word=passed ;;
      124 | 137) word="stopped after $limit s" ;;
      *) word=failed ;;
    esac
  fi
  end=$(date +%s%N)
  took[$name]=$(((end - begin) / 1000000))
  took[$name]=$((took[$name] / 1000)).$(printf %03d $((took[$name] % 1000)))
  [ "$rc" = 0 ] || failed=1
  rows+="| $name | $word | $rc | ${took[$name]} |"$'\n'
  printf '%s: %s, rc %s, %s s\n' "$name" "$word" "$rc" "${took[$name]}" | tee -a "$log"
}

# Old tar and machines without xz: Python reads the archive too.
unpack() {
  tar -C "$work" -xf "$bundle" ||
    python3 -c 'import sys, tarfile; tarfile.open(sys.argv[1]).extractall(sys.argv[2])' \
      "$bundle" "$work" || return
  local file
  for file in "$work"/spare/*; do
    [ -n "$(ldconfig -p | grep "^[[:space:]]*${file##*/} ")" ] || cp "$file" "$work/lib"
  done
  ls "$work/lib" | grep -Fxf <(ls "$work/spare") | sed 's/^/not on this machine: /'
  return 0
}

machine() {
  uname -srm
  sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | sort | uniq -c
  head -3 /proc/meminfo
  nvidia-smi || true
  ldd --version | sed -n 1p
}

# The programs alone get the libraries of the bundle, not the shell's own tools.
program() {
  local name=$1
  shift
  LD_LIBRARY_PATH=$work/lib "$work/bin/$name" "$@"
}

# In four processes, for most of the time is the reference's, which has one thread.
kernels_test() {
  local shard rc=0 pids=()
  for shard in 0 1 2 3; do
    GTEST_TOTAL_SHARDS=4 GTEST_SHARD_INDEX=$shard EDGESCOUT_TESTS_UNVALIDATED=1 \
      program kernels_test --gtest_filter="$tests" --gtest_print_time=1 \
      >"$work/tests.$shard" 2>&1 &
    pids+=($!)
  done
  for shard in 0 1 2 3; do
    wait "${pids[$shard]}" || { rc=$?; echo "part $shard of the tests: rc $rc"; }
  done
  return $rc
}

# One part, so one model.
on_scenes() { # VERB WORD...
  local verb=$1
  shift
  program edgescout "$verb" "$@" "$work/scenes" --model "$work"/scenes/models/obj_*.ply \
    --unit mm --models-info "$work/scenes/models/models_info.json"
}

batch() { # DEVICE NAME
  on_scenes detect $templates --no-overlays --device "$1" --out "$work/batch_$2"
}

evaluate() { # NAME
  on_scenes eval "$work/batch_$1/results.csv" | tee "$work/eval_$1"
}

# `timeout` runs programs, not functions: a step is this script's function in a shell of its own.
export -f unpack machine program kernels_test on_scenes batch evaluate
export work bundle tests templates
in_shell() { printf '%s\0' bash -o pipefail -c '"$@"' bash "$@"; }
run() { # NAME LIMIT FUNCTION [WORD...]
  local name=$1 limit=$2 words
  shift 2
  mapfile -d '' words < <(in_shell "$@")
  step "$name" "$limit" "${words[@]}"
  collect
}

join_json() { # FILE...: a list of them
  local file comma=''
  printf '['
  for file in "$@"; do
    [ -s "$file" ] || continue
    printf '%s\n' "$comma"
    cat "$file"
    comma=,
  done
  printf ']\n'
}

field() { sed -n "s/.*\"$2\": *\"\{0,1\}\([^\",]*\).*/\1/p" "$1" | head -1; } # FILE NAME

summary() {
  echo '# Check on a device'
  echo
  sed -n '/^== devices$/,/^devices: /p' "$log" | grep -v '^==\|^devices: ' | sed '/^$/d; s/^/    /'
  echo
  printf '| step | result | rc | seconds |\n|---|---|---|---|\n%s\n' "$rows"
  echo '## Tests of the kernels'
  echo
  grep -ah '^\[  PASSED\|^\[  SKIPPED \] [0-9]' "$out/kernels_test.txt" | sed 's/^/    /'
  echo
  echo 'Failed:'
  echo
  grep -ah '^\[  FAILED  \] .*\.' "$out/kernels_test.txt" | grep -v 'tests\{0,1\}, listed' |
    sed 's/ (.* ms)$//; s/,* where.*$//; s/^\[  FAILED  \] /- /' | sort -u
  echo
  echo "## $images images of 1024 x 768, five parts each"
  echo
  echo '| device | images | failed | poses | seconds | images/s |'
  echo '|---|---|---|---|---|---|'
  for name in cpu card; do
    file=$work/batch_$name/summary.json
    [ -s "$file" ] || continue
    printf '| %s | %s | %s | %s | %s | %s |\n' "$(field "$file" device)" "$(field "$file" done)" \
      "$(field "$file" failed)" "$(field "$file" poses)" "$(field "$file" seconds)" \
      "$(field "$file" images_per_second)"
  done
  echo
  for name in cpu card; do
    printf 'Recall, %s:\n\n' "$name"
    tail -3 "$work/eval_$name" 2>/dev/null | sed 's/^/    /'
    echo
  done
}

# After every step, so that nothing is lost if this script is ended.
collect() {
  cp "$work"/devices/devices.{json,md} "$out" 2>/dev/null
  cat "$work"/tests.* >"$out/kernels_test.txt" 2>/dev/null
  join_json "$work"/kernels/*.json >"$out/kernels.json"
  join_json "$work"/batch_{cpu,card}/summary.json >"$out/batch.json"
  summary >"$out/summary.md"
}

run 'unpack' 60 unpack
run 'machine' 20 machine
run 'devices' 20 program edgescout devices
run 'bench devices' 130 program edgescout bench devices --out "$work/devices" \
  --repetitions "$repetitions" --image-scale "$scale" $templates
run 'edgescout_bench' 70 program edgescout_bench --out "$work/kernels" \
  --repetitions "$repetitions" ${small:+--small}
run 'kernels_test' 110 kernels_test
run 'render' 60 program edgescout render --part bearing_block --scenes "$images" --objects 5 \
  --clutter 1 --pile 0.3 --seed 1000 --out "$work/scenes"
run "detect on $device" 130 batch "$device" card
run 'detect on the CPU' 110 batch cpu cpu
run "recall on $device" 10 evaluate card
run 'recall on the CPU' 10 evaluate cpu

# Small enough to carry away, even after a program that printed without end.
for file in "$out"/*; do
  [ "$(stat -c %s "$file")" -le 15000000 ] || truncate -s 15000000 "$file"
done
cat "$out/summary.md"
exit "$failed"
