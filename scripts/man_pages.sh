#!/bin/bash
# Makes the manual pages of the program and of each verb from what `--help-all` prints.
#   scripts/man_pages.sh PROGRAM FOLDER
set -euo pipefail
program=$1 folder=$2
mkdir -p "$folder"

# NAME, what it does, the options that print its help
page() {
  help2man --no-info --manual edgescout --source "$("$program" --version)" --name "$2" \
    --help-option "$3" --output "$folder/$1.1" "$program"
}

# The lines of the list of commands: the verb, and what it does.
verbs_of() { "$program" "$@" --help | sed -nE '/^Subcommands:/,/^$/s/^  ([a-z]+) +(.*)/\1 \2/p'; }

page edgescout "find textureless objects and their poses in images" --help-all
while read -r verb summary; do
  page "edgescout-$verb" "${summary,}" "$verb --help-all"
  while read -r part part_summary; do
    page "edgescout-$verb-$part" "${part_summary,}" "$verb $part --help-all"
  done < <(verbs_of "$verb")
done < <(verbs_of)
