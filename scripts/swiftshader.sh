#!/bin/bash
# Runs tests on SwiftShader, a second software device with a compiler and limits of its own. Takes
# the driver out of Debian's package chromium-common; nothing is installed.
#   scripts/swiftshader.sh              the kernels, detection and the next view on a device, from
#                                       the release preset as it is built. Prints a line for
#                                       docs/reliability.md
#   scripts/swiftshader.sh COMMAND...   runs COMMAND with SwiftShader as the only Vulkan driver
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

folder=$PWD/build/swiftshader
driver=$folder/usr/lib/chromium/vk_swiftshader_icd.json

fetch_driver() {
  mkdir -p "$folder"
  (cd "$folder" && apt-get download chromium-common && dpkg -x chromium-common_*.deb . &&
    rm chromium-common_*.deb)
}

# on_device PROGRAM [FILTER]: a test program; its result goes into the summary.
on_device() {
  local log=$folder/$1.log
  say "$1 on SwiftShader"
  "build/release/tests/$1" ${2:+--gtest_filter="$2"} >"$log" || {
    failed=1
    grep -E '^\[  FAILED  \]|Failure' -A 5 "$log"
  }
  local passed skipped
  passed=$(sed -nE 's/^\[  PASSED  \] ([0-9]+) test.*/\1/p' "$log")
  skipped=$(sed -nE 's/^\[  SKIPPED \] ([0-9]+) test.*/\1/p' "$log")
  summary+=("$1: ${passed:-0} passed, ${skipped:-0} skipped")
}

if [ ! -f "$driver" ]; then fetch_driver; fi
export VK_DRIVER_FILES=$driver
if [ $# -gt 0 ]; then exec "$@"; fi

failed=0
summary=()
on_device kernels_test
on_device detect_test '*OnADevice*:DeviceWork.*'
on_device active_test '*OnEveryDevice*'
on_device cli_test '*OfADevice*:LostDevice.*:*OnAVulkanDevice*:Devices.*'
say "line for docs/reliability.md"
joined=$(printf '%s; ' "${summary[@]//_test:/}")
printf '| %s | %s | SwiftShader | %s |\n' "$(date -u +%F)" "$(git rev-parse --short=12 HEAD)" \
  "${joined%; }"
exit "$failed"
