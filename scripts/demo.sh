#!/bin/bash
# Installs what is missing, builds, and detects objects: in photographs that Debian ships (package
# visp-images-data), in the rendered scenes of docs/examples, where the true poses are known, and in
# a rendered cell where the camera is sent to the views that promise most. Results go to out/demo,
# made anew at every run.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

scripts/setup.sh
build_preset release edgescout_cli
edgescout=build/release/host/cli/edgescout
photographs=/usr/share/visp-images-data/ViSP-images/mbt
examples=docs/examples
out=out/demo
rm -rf "$out"

say "devices"
"$edgescout" devices

say "a cube on a desk: photographs"
"$edgescout" detect "$photographs"/cube/image0000.pgm "$photographs"/cube/image0120.pgm \
  --model "$photographs/cube.cao" --unit m --models-info "$examples/visp/cube_models_info.json" \
  --camera "$examples/visp/cube_camera.yaml" --distance-min 0.4 --distance-max 0.8 \
  --max-detections 1 \
  --out "$out/cube"

# Where there is no graphics card this is lavapipe, Mesa's software device: right, and slower than
# the CPU path.
say "the first of them on a Vulkan device, looked for where the cube stands: the same pose"
"$edgescout" detect "$photographs/cube/image0000.pgm" --device vulkan \
  --model "$photographs/cube.cao" --unit m --models-info "$examples/visp/cube_models_info.json" \
  --camera "$examples/visp/cube_camera.yaml" --distance-min 0.4 --distance-max 0.8 \
  --max-detections 1 \
  --region-x 250 --region-y 150 --region-width 250 --region-height 250 --out "$out/cube_vulkan"

say "parts on a printed board: rendered"
"$edgescout" detect "$examples/scenes/000000" \
  --model "$examples"/parts/obj_00000{1,2,5}.ply --unit mm \
  --models-info "$examples/parts/models_info.json" \
  --out "$out/parts"

say "looking again from the best place: a rendered cell"
"$edgescout" scout cell --model "$examples"/parts/obj_00000{1,5}.ply --unit mm \
  --models-info "$examples/parts/models_info.json" \
  --objects 5 --seed 3 --pile 0.7 --width 640 --height 480 --focal 700 --view-count 24 \
  --max-views 5 \
  --viewpoints 4 --coarse-poses 300 --candidates 20 --out "$out/scout"

say "pictures to look at: what was found, drawn over the images, and how the views were chosen"
find "$out" -name '*.png' -o -name '*.html' | sort
