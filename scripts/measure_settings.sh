#!/bin/bash
# Measures accuracy, false poses and seconds per image: the tables of README.md and docs/tuning.md.
#   scripts/measure_settings.sh [--part NAME]... [DATA [PROGRAM [OUT]]]
#     --part    views: one, three and five views; photographs: DATA/brackets;
#               settings: one view with other settings. Default: all three.
#     DATA      folder with the set `brackets` (docs/evaluation.md). Without it, or with "-", the
#               photographs are left out.
#     PROGRAM   default: build/release/host/cli/edgescout
#     OUT       folder of images and results; default: out/settings. Results that are there are not
#               computed again, so give another folder for another program.
# Seconds hold only for a machine that does nothing else; the script warns if it does. About 10
# minutes on two idle cores.
parts=()
while [ "${1:-}" = --part ]; do
  parts+=("$2")
  shift 2
done
data=${1:--}
if [ "$data" != - ]; then data=$(realpath "$data"); fi
program=${2:+$(realpath "$2")}
out=${3:+$(realpath -m "$3")}
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
edgescout=${program:-build/release/host/cli/edgescout}
out=${out:-out/settings}
[ "${#parts[@]}" -gt 0 ] || parts=(views photographs settings)
if [ ! -x "$edgescout" ]; then
  echo "measure_settings: $edgescout: no such program; scripts/demo.sh builds it" >&2
  exit 2
fi
mkdir -p "$out"
XDG_CACHE_HOME=$(realpath "$out")/caches  # templates that other runs have kept are not read
export XDG_CACHE_HOME

# row NAME RESULT SCENES MODELS MIN_PROBABILITY MIN_VISIBLE: prints one row.
row() {
  python3 - "$@" << 'PYTHON'
import csv, json, math, pathlib, statistics, sys

name, result, scenes, models, min_probability, min_visible = sys.argv[1:]
min_probability, min_visible = float(min_probability), float(min_visible)
MAX_RAD, MAX_MM = 0.1, 5.0  # a right pose
IDENTITY = ([[1, 0, 0], [0, 1, 0], [0, 0, 1]], [0, 0, 0])


def matrix(numbers):
    return [numbers[0:3], numbers[3:6], numbers[6:9]]


def times(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def moved(rotation, point, translation):
    return [sum(rotation[i][k] * point[k] for k in range(3)) + translation[i] for i in range(3)]


def symmetries_of(info):
    if info.get("symmetries_continuous"):
        sys.exit("measure_settings: continuous symmetries are not handled")
    listed = info.get("symmetries_discrete", [])
    return [IDENTITY] + [([s[0:3], s[4:7], s[8:11]], [s[3], s[7], s[11]]) for s in listed]


# Angle and distance modulo symmetry, at the symmetry where the pair passes most easily.
def pose_error(estimate, truth, symmetries):
    best = (math.inf, math.inf)
    for rotation, translation in symmetries:
        turned = times(truth[0], rotation)
        shifted = moved(truth[0], translation, truth[1])
        trace = sum(estimate[0][i][j] * turned[i][j] for i in range(3) for j in range(3))
        error = (math.acos(max(-1, min(1, (trace - 1) / 2))), math.dist(estimate[1], shifted))
        best = min(best, error, key=lambda e: max(e[0] / MAX_RAD, e[1] / MAX_MM))
    return best


def ratio(error):
    return max(error[0] / MAX_RAD, error[1] / MAX_MM)


info = json.load(open(pathlib.Path(models) / "models_info.json"))
estimates = {}
for line in csv.DictReader(open(pathlib.Path(result) / "results.csv")):
    if float(line["score"]) < min_probability:
        continue
    pose = (matrix([float(x) for x in line["R"].split()]), [float(x) for x in line["t"].split()])
    key = int(line["scene_id"]), int(line["im_id"]), int(line["obj_id"])
    estimates.setdefault(key, []).append((-float(line["score"]), pose))

# As `edgescout eval` matches: estimates by falling score take the free truth of smallest error.
right = []
for scene in sorted(pathlib.Path(scenes).glob("*/scene_gt.json")):
    visible = scene.parent / "scene_gt_info.json"
    visible = json.load(open(visible)) if visible.exists() else None
    for image, truths in json.load(open(scene)).items():
        for object_id in {t["obj_id"] for t in truths}:
            open_truths = {
                i: (matrix(t["cam_R_m2c"]), t["cam_t_m2c"])
                for i, t in enumerate(truths) if t["obj_id"] == object_id
            }
            key = int(scene.parent.name), int(image), object_id
            for _, pose in sorted(estimates.get(key, []), key=lambda e: e[0]):
                symmetries = symmetries_of(info[str(object_id)])
                errors = {i: pose_error(pose, t, symmetries) for i, t in open_truths.items()}
                nearest = min(errors, key=lambda i: ratio(errors[i]), default=None)
                if nearest is None or ratio(errors[nearest]) >= 1:
                    continue
                del open_truths[nearest]
                if visible is None or visible[image][nearest]["visib_fract"] >= min_visible:
                    right.append(errors[nearest])

judged = json.load(open(f"{result}_{min_probability:g}.json"))["all"]
expected = round(judged["recall_pose_symmetric"] * judged["truths"])
if expected != len(right):
    sys.exit(f"measure_settings: {name}: found {len(right)} right poses, eval counts {expected}")

# A joint result lists the stages of all its images in each of their files.
seconds = []
for file in sorted(pathlib.Path(result).glob("[0-9]*.json")):
    image = json.load(open(file))
    views = image["settings"]["views"].split()[0]  # "alone", or how many
    together = int(views) if views.isdigit() else 1
    seconds.append(sum(stage["ms"] for stage in image["timings_ms"]) / 1000 / together)

median_mm = f'{statistics.median(e[1] for e in right):.1f}' if right else "-"
median_rad = f'{statistics.median(e[0] for e in right):.3f}' if right else "-"
by_px = round(judged["recall_mspd_below_max"] * judged["truths"])
print(f'| {name} | {judged["truths"]} | {len(right)} | {by_px} '
      f'| {judged["false_positives_per_image"]:.2f} | {median_mm} | {median_rad} '
      f'| {statistics.median(seconds):.1f} |')
PYTHON
}

# measure NAME RESULT SCENES MODELS MIN_PROBABILITY OPTION...: detects, unless that is done, and
# prints one row. MODELS is a folder with models_info.json and the parts.
measure() {
  local name=$1 result=$out/$2 scenes=$3 models=$4 min_probability=$5
  shift 5
  local objects=(--model "$models"/obj_*.ply --unit mm --models-info "$models/models_info.json")
  if [ ! -f "$result/summary.json" ]; then
    "$edgescout" detect "$scenes" "${objects[@]}" --device cpu --no-overlays --resume \
      --min-probability 0.05 "$@" --out "$result" \
      > "$result.log" 2>&1 || { cat "$result.log" >&2; exit 1; }
  fi
  "$edgescout" eval "$result/results.csv" "$scenes" "${objects[@]}" --min-visible "$min_visible" \
    --min-score "$min_probability" --json "${result}_$min_probability.json" > /dev/null
  row "$name" "$result" "$scenes" "$models" "$min_probability" "$min_visible"
}

# first_views SCENES COUNT: makes SCENES_COUNT, the same scenes with their first COUNT images.
first_views() {
  python3 - "$1" "$2" << 'PYTHON'
import json, os, pathlib, sys

source, count = pathlib.Path(sys.argv[1]).resolve(), int(sys.argv[2])
target = pathlib.Path(f"{source}_{count}")
for scene in sorted(p.parent for p in source.glob("*/scene_gt.json")):
    folder = target / scene.name
    folder.mkdir(parents=True, exist_ok=True)
    if not (folder / "gray").exists():
        os.symlink(scene / "gray", folder / "gray")
    for file in scene.glob("scene_*.json"):
        entries = list(json.load(open(file)).items())[:count]
        json.dump(dict(entries), open(folder / file.name, "w"))
PYTHON
}

render() {
  local scenes=$1
  shift
  if [ ! -d "$scenes/models" ]; then
    "$edgescout" render "$@" --views 5 --width 640 --height 480 --focal 700 --min-distance 0.35 \
      --max-distance 0.5 --out "$scenes" > "$scenes.log" 2>&1 || { cat "$scenes.log" >&2; exit 1; }
  fi
}

heap=$out/heap
apart=$out/apart
min_visible=0.1
range=(--distance-min 0.3 --distance-max 0.6)

# heading TITLE FIRST_COLUMN: begins a table.
heading() {
  say "$1"
  echo "| $2 | instances | 0.1 rad, 5 mm | MSPD < 10 px | false per image" \
    "| mm | rad | s per image |"
  echo "|---|---|---|---|---|---|---|---|"
}

load=$(cut -d ' ' -f 1 /proc/loadavg)
if [ "${load%.*}" -ge 1 ]; then
  echo "measure_settings: the machine is busy (load $load): the seconds are not valid" >&2
fi
"$edgescout" --version
if [[ " ${parts[*]} " =~ ( views | settings ) ]]; then
  render "$heap" --part l_bracket --scenes 2 --objects 6 --clutter 1 --pile 0.9 --seed 400
  first_views "$heap" 3
fi
if [[ " ${parts[*]} " == *" views "* ]]; then
  render "$apart" --part l_bracket bearing_block --scenes 2 --objects 6 --clutter 1 --pile 0.3 \
    --seed 300
fi

if [[ " ${parts[*]} " == *" views "* ]]; then
  for probability in 0.05 0.1 0.25 0.4 0.5 0.75 0.9; do
    heading "rendered heaps of six parts, probability from $probability" "views"
    measure one heap_1 "$heap" "$heap/models" "$probability" "${range[@]}"
    measure three heap_joint_3 "${heap}_3" "$heap/models" "$probability" "${range[@]}" --joint
    measure five heap_joint_5 "$heap" "$heap/models" "$probability" "${range[@]}" --joint
  done
  heading "two types of parts that lie apart, one view" "probability from"
  for probability in 0.05 0.1 0.25 0.4 0.5 0.75; do
    measure "$probability" apart_1 "$apart" "$apart/models" "$probability" "${range[@]}"
  done
fi

if [[ " ${parts[*]} " == *" photographs "* && "$data" != - ]]; then
  photographs=$data/brackets
  photographs_range=(--distance-min 0.4 --distance-max 0.8)
  mkdir -p "$out/pile"
  [ -e "$out/pile/000001" ] || ln -s "$photographs/000001" "$out/pile/000001"
  for probability in 0.05 0.25 0.4 0.5 0.9; do
    heading "photographs of brackets, probability from $probability" "views"
    measure one brackets_1 "$photographs" "$photographs/models" "$probability" \
      "${photographs_range[@]}"
    measure three brackets_joint_3 "$out/pile" "$photographs/models" "$probability" \
      "${photographs_range[@]}" --joint
  done
fi

if [[ " ${parts[*]} " == *" settings "* ]]; then
  # setting NAME RESULT OPTION...: one view, on the first three images of every heap.
  setting() {
    local name=$1 result=$2
    shift 2
    measure "$name" "$result" "${heap}_3" "$heap/models" "$probability" "$@"
  }
  for probability in 0.05 0.4; do
    heading "settings, one view, probability from $probability" "setting"
    setting "defaults" settings_default "${range[@]}"
    setting "\`--distance-min 0.34 --distance-max 0.52\`" settings_distance \
      --distance-min 0.34 --distance-max 0.52
    setting "\`--viewpoints 4 --in-plane-steps 18\`" settings_templates "${range[@]}" \
      --viewpoints 4 --in-plane-steps 18
    setting "\`--coarse-poses 4000 --medium-poses 400 --candidates 25\`" settings_few "${range[@]}" \
      --coarse-poses 4000 --medium-poses 400 --candidates 25
    setting "\`--coarse-poses 20000 --medium-poses 2500 --candidates 120\`" settings_many \
      "${range[@]}" --coarse-poses 20000 --medium-poses 2500 --candidates 120
    setting "\`--restart-rotation 0\`" settings_restart "${range[@]}" --restart-rotation 0
  done
fi
