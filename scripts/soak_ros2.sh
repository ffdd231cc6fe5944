#!/bin/bash
# Runs edgescout_ros2 beside a camera of 30 images per second, and prints every ten seconds how many
# images were answered, the latency and the memory.
#   scripts/soak_ros2.sh [SECONDS [OPTION OF edgescout_ros2...]]    default: 600
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

seconds=${1:-600}
shift || true
build_preset release edgescout_ros2 edgescout_bench_ros2

folder=$(mktemp -d)
trap 'kill "${node:-}" 2>/dev/null || true; rm -rf "$folder"' EXIT
printf 'image_width: 640\nimage_height: 480\ncamera_matrix:\n  rows: 3\n  cols: 3\n  data: [%s]\n' \
  "700, 0, 319.5, 0, 700, 239.5, 0, 0, 1" >"$folder/camera.yaml"
export ROS_LOCALHOST_ONLY=1 ROS_DOMAIN_ID=$((1 + $$ % 200))
build/release/host/bridge/ros2/edgescout_ros2 --model docs/examples/parts/obj_000001.ply --unit mm \
  "$@" &
node=$!
build/release/bench/edgescout_bench_ros2 docs/examples/scenes/000000/gray/000000.png \
  "$folder/camera.yaml" "$node" 30 "$seconds"
kill "$node"
wait "$node" && echo "edgescout_ros2 ended with exit code 0"
