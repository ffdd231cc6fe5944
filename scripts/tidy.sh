#!/bin/bash
# Runs clang-tidy 14 with the checks of .clang-tidy. Every warning is an error.
#   scripts/tidy.sh                on the .cpp files that the last 40 commits changed
#   scripts/tidy.sh --all          on all .cpp files
#   scripts/tidy.sh FILE...        on these
# For a changed header the .cpp file of the same name is checked. Commits that change only the
# layout (.git-blame-ignore-revs), merges, and the oldest commit of a shallow clone do not count.
# With TIDY_SECONDS=N no further file is begun after N seconds. Files of the newest commits come
# first. The last line says how many files were left.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

commits_looked_at=40
database=build/dev/compile_commands.json
logs=build/tidy

# Newest commits first; a file may come more than once.
changed_files() {
  local oldest=() layout=.git-blame-ignore-revs
  # The parents of these are not there, so every file looks changed.
  if [ -f "$(git rev-parse --git-path shallow)" ]; then
    mapfile -t oldest < "$(git rev-parse --git-path shallow)"
  fi
  git log -n "$commits_looked_at" --no-merges --format=%H HEAD ${oldest[0]:+--not "${oldest[@]}"} |
    { if [ -f "$layout" ]; then grep -vFf <(grep -v '^#' "$layout") || true; else cat; fi; } |
    while read -r commit; do
      git show --format= --name-only --diff-filter=d "$commit" -- '*.h' '*.cpp'
    done
}

# Of the files named by the lines of standard input those that the database has, each once.
in_database() {
  sed 's/\.h$/.cpp/' | awk '!seen[$0]++' |
    while read -r file; do
      if grep -qF "\"file\": \"$PWD/$file\"" "$database"; then echo "$file"; fi
    done
}

# Called for each file, several at a time.
tidy_file() {
  local file=$1 start=$SECONDS log
  log=$logs/${file//\//_}
  if [ "$TIDY_SECONDS" -gt 0 ] && [ "$(date +%s)" -ge "$TIDY_END" ]; then
    touch "$log.left"
  elif "$TIDY" -p build/dev --quiet "$file" > "$log.out" 2> "$log.err"; then
    echo "$((SECONDS - start)) $file" > "$log.seconds"
  else
    cat "$log.out" "$log.err"
    echo "$file" > "$log.failed"
  fi
}

need git cmake ninja
TIDY=$(need_version clang-tidy 14)
TIDY_SECONDS=${TIDY_SECONDS:-0}
TIDY_END=$(($(date +%s) + TIDY_SECONDS))
export TIDY TIDY_SECONDS TIDY_END logs
export -f tidy_file

say "preparing clang-tidy"
cmake --preset dev > /dev/null
# Headers that the build makes.
made=(edgescout_shader_headers edgescout_arguments_commit edgescout_bench_commit)
# To the end of the list: -q would stop ninja early, which counts as a failure here.
if ninja -C build/dev -t targets all | grep '^edgescout_ros2_types:' > /dev/null; then
  made+=(edgescout_ros2_types)
fi
cmake --build --preset dev -j "$jobs" --target "${made[@]}" > /dev/null
rm -rf "$logs"
mkdir -p "$logs"

case "${1:-}" in
  '') mapfile -t files < <(changed_files | in_database) ;;
  --all) mapfile -t files < <(git ls-files '*.cpp' | in_database) ;;
  *) mapfile -t files < <(printf '%s\n' "$@" | in_database) ;;
esac
if [ "${#files[@]}" = 0 ]; then
  echo "tidy: no file to check"
  exit 0
fi

say "clang-tidy on ${#files[@]} files ($jobs jobs)"
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$jobs" bash -c 'tidy_file "$1"' tidy_file

count() { find "$logs" -name "*.$1" | wc -l; }
failed=$(count failed) left=$(count left)
echo "slowest: $(cat "$logs"/*.seconds 2> /dev/null | sort -rn | head -3 |
  awk '{ printf "%s%s %s s", sep, $2, $1; sep = ", " }')"
echo "tidy: $((${#files[@]} - left)) files, $failed with findings," \
  "$left left for --long, $SECONDS s"
[ "$failed" = 0 ]
