#!/bin/bash
# Makes the Debian packages, installs them in a fresh Debian 12 and detects the part of the example
# scene there: by the program, from Python, from C++ and, where they are built, from C. The program,
# Python and C also detect the demo's cube, where its photographs are installed (visp-images-data).
# Needs root.
#   scripts/packages_test.sh [BUILD]   the build folder; default build/release
# PACKAGES_ROOT=DIR keeps the installed system there.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

build=$(realpath "${1:-build/release}")
root=${PACKAGES_ROOT:-$(mktemp -d)}
[ -n "${PACKAGES_ROOT:-}" ] || trap 'rm -rf --one-file-system "$root"' EXIT
chmod 755 "$root"

say "packages"
cmake --build "$build"
rm -f "$build"/*.deb
(cd "$build" && cpack >cpack.log) || { cat "$build/cpack.log"; exit 1; }
ls "$build"/*.deb

say "a fresh Debian 12"
mmdebstrap --quiet --variant=apt --include=ca-certificates bookworm "$root"
in_root() { chroot "$root" env DEBIAN_FRONTEND=noninteractive PATH=/usr/sbin:/usr/bin:/sbin:/bin "$@"; }
mkdir -p "$root/debs" "$root/work/docs" "$root/work/tests/install"
cp "$build"/*.deb "$root/debs"
cp -r docs/examples "$root/work/docs"
cp -r tests/install/consumer "$root/work/tests/install"
# Compiler and build tools are what a user of libedgescout-dev has.
in_root sh -c 'apt-get -qq update && apt-get -qq install --no-install-recommends -y g++ cmake make pkg-config /debs/*.deb' \
  >"$root/install.log" 2>&1 || { tail -20 "$root/install.log"; exit 1; }
say "installed: $(in_root dpkg-query -W -f '${Package} ' '*edgescout*')"

scene=/work/docs/examples/scenes/000000
part="--model /work/docs/examples/parts/obj_000001.ply --unit mm --distance-min 0.32 --distance-max 0.36"

# The demo's cube: its photograph, and its model in millimetres, the unit that find_part takes.
photographs=/usr/share/visp-images-data/ViSP-images/mbt
has_cube=
if [ -e "$photographs/cube/image0000.pgm" ]; then
  has_cube=yes
  mkdir "$root/work/cube"
  cp "$photographs/cube/image0000.pgm" docs/examples/visp/cube_camera.yaml "$root/work/cube"
  sed 's/0\.084/84.0/g' "$photographs/cube.cao" >"$root/work/cube/cube.cao"
else
  say "the cube: left out, visp-images-data is missing"
fi

say "the program"
# shellcheck disable=SC2086  # several words
in_root edgescout detect $scene $part --device cpu --out /work/out
in_root edgescout eval /work/out/results.csv $scene --model /work/docs/examples/parts/obj_000001.ply --unit mm
in_root test -s /work/out/results.csv
if [ "$has_cube" ]; then
  in_root edgescout detect /work/cube/image0000.pgm --model /work/cube/cube.cao --unit mm \
    --camera /work/cube/cube_camera.yaml --distance-min 0.48 --distance-max 0.56 --device cpu --out /work/cube_out
fi
in_root test -s /usr/share/man/man1/edgescout-detect.1.gz -o -s /usr/share/man/man1/edgescout-detect.1

say "Python"
in_root python3 - <<'END'
import json
import os
import numpy as np
import edgescout

scene = "/work/docs/examples/scenes/000000"
image = edgescout.load_image(scene + "/gray/000000.png")
matrix = np.reshape(json.load(open(scene + "/scene_camera.json"))["0"]["cam_K"], (3, 3))
camera = edgescout.Camera(image.shape[1], image.shape[0], matrix)
mesh = edgescout.load_mesh("/work/docs/examples/parts/obj_000001.ply", "mm")
templates = edgescout.Templates(mesh, edgescout.TemplateOptions(distance_min=0.32, distance_max=0.36))
found = edgescout.detect(image, camera, templates, backend=edgescout.Backend("cpu"))

def compare(found, results):
    rows = [row.split(",") for row in open(results).read().splitlines()[1:]]
    assert len(found) == len(rows) > 0, (len(found), len(rows))
    best = max(rows, key=lambda row: float(row[3]))
    assert abs(found[0].probability - float(best[3])) < 1e-6
    place = [1000 * number for number in found[0].world_from_object[:3, 3]]
    assert np.allclose(place, [float(number) for number in best[5].split()], atol=1e-3)
    print(f"{len(found)} parts, the best of probability {found[0].probability:.2f}: as the program's")

compare(found, "/work/out/results.csv")
if os.path.exists("/work/cube"):
    image = edgescout.load_image("/work/cube/image0000.pgm")
    camera = edgescout.load_camera("/work/cube/cube_camera.yaml")
    mesh = edgescout.load_mesh("/work/cube/cube.cao", "mm")
    templates = edgescout.Templates(mesh, edgescout.TemplateOptions(distance_min=0.48, distance_max=0.56))
    found = edgescout.detect(image, camera, templates, backend=edgescout.Backend("cpu"))
    compare(found, "/work/cube_out/results.csv")
END

say "C++"
in_root sh -ec 'cmake -S /work/tests/install/consumer -B /work/build -DCMAKE_BUILD_TYPE=Release >/dev/null
  cmake --build /work/build --target consumer >/dev/null
  /work/build/consumer /work/docs/examples/scenes/000000 /work/docs/examples/parts/obj_000001.ply 1'

if [ -e "$root/usr/include/edgescout.h" ]; then
  say "C"
  cp docs/examples/c/find_part.c "$root/work/"
  # shellcheck disable=SC2016  # for the shell in the root
  in_root sh -ec 'cc -std=c11 /work/find_part.c -o /work/find_part $(pkg-config --cflags --libs edgescout-c) -lm
    cd /work && ./find_part docs/examples/scenes/000000/gray/000000.png docs/examples/scenes/000000/scene_camera.json \
      docs/examples/parts/obj_000001.ply 0.32 0.36'
  if [ "$has_cube" ]; then
    in_root sh -ec 'cd /work/cube && ../find_part image0000.pgm cube_camera.yaml cube.cao 0.48 0.56'
  fi
fi

if [ -x "$root/usr/bin/edgescout_ros2" ]; then
  say "the ROS 2 node"
  in_root edgescout_ros2 --version
  diff -r host/bridge/ros2/edgescout_msgs "$root/usr/share/edgescout/edgescout_msgs"
fi
say "packages: all passed"
