#!/bin/bash
# One shard of a batch, as a task of a job array of submit.sh: OUT N VERB ARGUMENT...
set -uo pipefail
out=$1 shards=$2 verb=$3
shift 3
# A node that lost its power keeps its lock on a file server for a while, 90 s with NFS 4.
if [ "${SLURM_RESTART_COUNT:-0}" -gt 0 ]; then sleep "${LOCK_SECONDS:-100}"; fi

"$EDGESCOUT" "$verb" "$@" --shard "$SLURM_ARRAY_TASK_ID/$shards" --resume \
  --out "$out/shard_$SLURM_ARRAY_TASK_ID"
code=$?
# 3: a device failed, which another node may not. At most three times.
if [ "$code" = 3 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 3 ]; then
  scontrol requeue "$SLURM_JOB_ID"
fi
# 1: images failed. They are listed, and no further run mends them.
if [ "$code" = 1 ]; then code=0; fi
exit "$code"
