#!/bin/bash
# Runs `detect` on a loop of images and then `scout`, each for hours, and reports whether resident
# memory or open files grow.
#   scripts/soak.sh [--hours H] [--out FOLDER]     # default: 1 hour each, out/soak
# Stopped, it goes on where it was when it is started again with the same folder: what was measured
# lies in FOLDER/detect.csv and FOLDER/scout.csv (seconds of the run, process, MiB, open files).
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
hours=1 out=out/soak
while [ $# -gt 0 ]; do
  case "$1" in
    --hours) hours=$2 ;;
    --out) out=$2 ;;
    *)
      echo "soak: found $1, expected --hours H or --out FOLDER" >&2
      exit 2
      ;;
  esac
  shift 2
done
edgescout=${EDGESCOUT:-build/release/host/cli/edgescout}
parts=docs/examples/parts
model=(--model "$parts/obj_000001.ply" --unit mm --device "${DEVICE:-cpu}")
mkdir -p "$out"
limit=$(awk "BEGIN { print int($hours * 3600) }")

# seconds_of VERB: how long was measured so far, over all runs.
seconds_of() { (tail -n 1 "$out/$1.csv" 2>/dev/null || echo 0) | cut -d, -f1; }

# watch VERB COMMAND...: runs the command, and writes down memory and files every five seconds.
watch() {
  local verb=$1 before
  shift
  before=$(seconds_of "$verb")
  "$@" >>"$out/$verb.txt" 2>&1 &
  local process=$! start=$SECONDS
  trap 'kill "$process" 2>/dev/null || true' EXIT
  while kill -0 "$process" 2>/dev/null && [ $((before + SECONDS - start)) -lt "$limit" ]; do
    sleep 5
    local memory files
    memory=$(awk '/VmRSS/ { print $2 / 1024 }' "/proc/$process/status" 2>/dev/null || true)
    files=$(find "/proc/$process/fd" -mindepth 1 2>/dev/null | wc -l || true)
    if [ -n "$memory" ]; then
      echo "$((before + SECONDS - start)),$process,$memory,$files" >>"$out/$verb.csv"
    fi
  done
  kill "$process" 2>/dev/null || true
  wait "$process" || true
  trap - EXIT
}

# One long run of detect: the same images by many names, as links.
loop_of_images() {
  local number image
  if [ -d "$out/images" ]; then return; fi
  mkdir -p "$out/images.part"
  number=0
  while [ "$number" -lt "${IMAGES:-20000}" ]; do
    for image in docs/examples/scenes/*/gray/*.png; do
      ln -s "$PWD/$image" "$out/images.part/$(printf %06d "$number").png"
      number=$((number + 1))
    done
  done
  mv "$out/images.part" "$out/images"
}

say "detect, $hours h"
loop_of_images
while [ "$(seconds_of detect)" -lt "$limit" ]; do
  watch detect "$edgescout" detect "$out/images" "${model[@]}" \
    --camera docs/examples/scenes/000000/scene_camera.json --no-overlays --resume --out "$out/found"
  if [ "$(seconds_of detect)" -lt "$limit" ]; then rm -rf "$out/found"; fi  # all done: once more
done

say "scout, $hours h"
number=0
while [ "$(seconds_of scout)" -lt "$limit" ]; do
  # A run ends after some views: memory is compared within each, and from run to run.
  watch scout "$edgescout" scout cell "${model[@]}" --objects 5 --seed "$number" --width 640 \
    --height 480 --focal 700 --view-count 64 --max-views 32 --min-information 0 --resume \
    --out "$out/scout_$number"
  rm -rf "$out/scout_$number"
  number=$((number + 1))
done

scripts/soak_report.py "$out/detect.csv" "$out/scout.csv"
