#!/bin/bash
# Runs the first three sections of docs/evaluation.md (registration, rendered scenes with either
# edge detector, real photographs) and one detection's time and memory.
#
#   bench/evaluate.sh BUILD OUT [DATA]
#
# BUILD is a build folder (build/release), OUT a folder for results, DATA the folder with
# d2co-starts, brackets and cat; without it those parts are skipped. DEVICE (default cpu) names the
# device. Some 25 minutes on two cores.
set -euo pipefail
build=$1 out=$2 data=${3:-} device=${DEVICE:-cpu}
edgescout=$build/host/cli/edgescout
mkdir -p "$out"
XDG_CACHE_HOME=$(realpath "$out")/caches  # templates that other runs have kept are not read
export XDG_CACHE_HOME

say() { printf '\n== %s\n' "$*"; }

say "detection on rendered scenes: 10 scenes, 3 parts, 6 instances each, clutter and occlusion"
"$edgescout" render --part l_bracket bearing_block u_channel --scenes 10 --objects 6 --clutter 1 \
  --pile 0.4 --width 800 --height 600 \
  --focal 950 --min-distance 0.35 --max-distance 0.6 --seed 100 --out "$out/rendered"
for edges in gradient lsd; do
  say "with edges of $edges; summary.json has the time of every stage"
  "$edgescout" detect "$out/rendered" --model "$out"/rendered/models/*.ply --unit mm \
    --models-info "$out/rendered/models/models_info.json" \
    --distance-min 0.33 --distance-max 0.66 --min-probability 0.05 --edges $edges \
    --device "$device" --out "$out/rendered_$edges"
  "$edgescout" eval "$out/rendered_$edges/results.csv" "$out/rendered" \
    --model "$out"/rendered/models/*.ply --unit mm \
    --models-info "$out/rendered/models/models_info.json" --min-visible 0.7
done

say "time and peak memory of one detection in 1024x768"
"$edgescout" render --part l_bracket --objects 4 --clutter 1 --width 1024 --height 768 \
  --focal 1200 --min-distance 0.4 --max-distance 0.6 \
  --seed 7 --out "$out/one"
measure=(/usr/bin/time -f '%e s, %U s of CPU time, %M KiB at most')
[ -x /usr/bin/time ] || { say "not measured: /usr/bin/time (package time) is missing"; measure=(); }
"${measure[@]}" "$edgescout" detect "$out/one" --model "$out"/one/models/*.ply --unit mm \
  --models-info "$out/one/models/models_info.json" --distance-min 0.35 --distance-max 0.7 \
  --no-template-cache --device "$device" \
  --out "$out/one_results"

if [ -z "$data" ]; then
  say "skipped: registration, brackets and cat (no DATA given)"
  exit 0
fi

say "registration, one view, with and without search; three views; starts at the truth"
registration=$build/bench/edgescout_bench_registration
"$registration" "$data/d2co-starts" --device "$device"
"$registration" "$data/d2co-starts" --device "$device" --search 0
"$registration" "$data/d2co-starts" --device "$device" --views 3
"$registration" "$data/d2co-starts" --device "$device" --truth --search 0
"$registration" "$data/d2co-starts" --device "$device" --truth --search 0 --views 3

bracket() { # SCENE NAME [OPTION...]
  local scene=$1 name=$2
  shift 2
  "$edgescout" detect "$data/brackets/$scene" --model "$data/brackets/models/obj_000001.ply" \
    --unit mm \
    --models-info "$data/brackets/models/models_info.json" --distance-min 0.4 --distance-max 0.8 \
    --min-probability 0.05 --device "$device" --out "$out/$name" "$@"
  "$edgescout" eval "$out/$name/results.csv" "$data/brackets/$scene" \
    --model "$data/brackets/models/obj_000001.ply" --unit mm \
    --models-info "$data/brackets/models/models_info.json"
}
say "brackets, single views"
bracket 000001 brackets_pile
bracket 000002 brackets_flat
say "brackets, three views jointly"
bracket 000001 brackets_joint --joint

say "cat"
"$edgescout" detect "$data/cat" --model "$data/cat/models/obj_000001.ply" --unit mm \
  --distance-min 0.39 --distance-max 0.78 --min-probability 0.05 --device "$device" --out "$out/cat"
"$edgescout" eval "$out/cat/results.csv" "$data/cat" --model "$data/cat/models/obj_000001.ply" \
  --unit mm
