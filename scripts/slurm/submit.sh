#!/bin/bash
# Submits a batch to Slurm: an array of N shards, and a job after them that merges.
#   scripts/slurm/submit.sh N OUT detect|register ARGUMENT...
# The arguments are those of the verb without --out, --shard and --resume. Shards write OUT/shard_I,
# the merge writes OUT/merged, logs go to OUT/log. OUT must be a folder that all nodes share. sbatch
# takes its own options from SBATCH_* variables (SBATCH_PARTITION, SBATCH_TIMELIMIT ..); SHARD_CPUS
# is the number of processors of a shard, EDGESCOUT the program. Prints the number of the merge job.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
if [ $# -lt 3 ] || ! [[ $1 =~ ^[1-9][0-9]*$ ]]; then
  echo "submit: found '${1:-}' and $# arguments, expected N OUT VERB ARGUMENT..." >&2
  exit 2
fi
shards=$1
mkdir -p "$2/log"
out=$(realpath "$2")
shift 2
EDGESCOUT=${EDGESCOUT:-edgescout}
export EDGESCOUT

# A node that fails gives its shards back to the queue; --resume goes on with what is on the disk.
array=$(sbatch --parsable --job-name=edgescout --array="1-$shards" --requeue --open-mode=append \
  --ntasks=1 --cpus-per-task="${SHARD_CPUS:-1}" --output="$out/log/shard_%a.txt" \
  "$here/shard.sh" "$out" "$shards" "$@")
# Also after shards that failed: the merge names what is missing.
sbatch --parsable --job-name=edgescout-merge --dependency="afterany:${array%%;*}" --requeue \
  --output="$out/log/merge.txt" "$here/merge.sh" "$out"
