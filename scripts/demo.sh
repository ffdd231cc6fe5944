#!/bin/bash
# Installs what is missing, builds, and shows what the program does on photographs and on rendered scenes. Results go to
# out/demo, made anew at every run.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

scripts/setup.sh
build_preset release
edgescout=build/release/host/cli/edgescout
photographs=/usr/share/visp-images-data/ViSP-images/mbt
examples=docs/examples
out=out/demo
rm -rf "$out"
mkdir -p "$out"

say "Vulkan devices"
"$edgescout" devices

say "the models"
"$edgescout" model inspect "$photographs/cube.cao" --unit m
"$edgescout" model inspect "$examples"/parts/*.ply --unit mm

say "a scene of known poses"
"$edgescout" render --part l_bracket bearing_block u_channel --width 640 --height 480 --focal 750 --objects 5 --out "$out/scenes"

say "pictures to look at"
find "$out" -name '*.png' | sort
