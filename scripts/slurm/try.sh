#!/bin/bash
# Tries the scripts of this folder: starts a Slurm cluster of two nodes on this machine, detects in
# 400 small images in eight shards, kills a node in the middle, and compares the merged result with
# that of one run. Needs Debian's slurm-wlm and munge, and root. Takes minutes.
#   scripts/slurm/try.sh [FOLDER]        # default: a temporary one, removed at the end
# Images that an earlier try left in FOLDER/scenes are used again.
source "$(dirname "${BASH_SOURCE[0]}")/../common.sh"
here=$PWD/scripts/slurm
EDGESCOUT=$(realpath "${EDGESCOUT:-build/release/host/cli/edgescout}")
export EDGESCOUT
for command in sbatch slurmctld slurmd munged; do
  if ! command -v "$command" >/dev/null; then
    echo "try: found no $command, expected Debian's slurm-wlm and munge" >&2
    exit 2
  fi
done
if [ "$(id -u)" != 0 ]; then
  echo "try: found user $(id -un), expected root, which may start Slurm's daemons" >&2
  exit 2
fi

folder=${1:-}
if [ -z "$folder" ]; then folder=$(mktemp -d); fi
mkdir -p "$folder"
folder=$(realpath "$folder")
cluster=$folder/cluster
mkdir -p "$cluster"/{munge,state,spool_node1,spool_node2}
images=${IMAGES:-400} shards=${SHARDS:-8}
daemons=()

# descendants PID: the process and all that it started.
descendants() {
  local child
  echo "$1"
  for child in $(pgrep -P "$1" || true); do descendants "$child"; done
}

# of_node NAME: the processes of tasks that run on the node, and the step daemons above them.
of_node() {
  local process parent
  grep -lsz "^SLURMD_NODENAME=$1\$" /proc/[0-9]*/environ | cut -d/ -f3 | while read -r process; do
    if ! grep -qsz "^SLURM_CONF=$cluster/slurm.conf\$" "/proc/$process/environ"; then continue; fi
    echo "$process"
    parent=$(ps -o ppid= -p "$process" | tr -d ' ' || true)
    if [[ $(ps -o args= -p "${parent:-0}") == *slurmstepd* ]]; then echo "$parent"; fi
  done
}

clean_up() {
  for node in node1 node2; do of_node "$node"; done | xargs -r kill -9 2>/dev/null || true
  for daemon in "${daemons[@]}"; do kill "$daemon" 2>/dev/null || true; done
  if [ -z "${1:-}" ]; then rm -rf "$folder"; fi
}
trap 'clean_up "${kept:-}"' EXIT
kept=${1:-}

start_munge() {
  dd if=/dev/urandom of="$cluster/munge/key" bs=1024 count=1 status=none
  chmod 600 "$cluster/munge/key"
  chmod 755 "$folder" "$cluster"
  chown -R munge "$cluster/munge"
  runuser -u munge -- munged --foreground --key-file="$cluster/munge/key" \
    --socket="$cluster/munge/socket" --pid-file="$cluster/munge/pid" \
    --log-file="$cluster/munge/log" --seed-file="$cluster/munge/seed" --num-threads=2 \
    >"$cluster/munge/out" 2>&1 &
  daemons+=($!)
  until [ -S "$cluster/munge/socket" ]; do sleep 0.2; done
}

write_conf() {
  local host
  host=$(hostname -s)
  cat >"$cluster/slurm.conf" <<CONF
ClusterName=try
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$cluster/munge/socket
CredType=cred/munge
SlurmctldPort=16817
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmctldLogFile=$cluster/slurmctld.log
SlurmdPidFile=$cluster/slurmd_%n.pid
SlurmdLogFile=$cluster/slurmd_%n.log
SlurmdSpoolDir=$cluster/spool_%n
StateSaveLocation=$cluster/state
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SwitchType=switch/none
MpiDefault=none
ReturnToService=1
SlurmdTimeout=10
SlurmdParameters=config_overrides
KillWait=5
MinJobAge=600
JobRequeue=1
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
NodeName=node1 NodeHostname=$host NodeAddr=127.0.0.1 Port=16821 CPUs=1 State=UNKNOWN
NodeName=node2 NodeHostname=$host NodeAddr=127.0.0.1 Port=16822 CPUs=1 State=UNKNOWN
PartitionName=all Nodes=node1,node2 Default=YES MaxTime=INFINITE State=UP
CONF
  export SLURM_CONF=$cluster/slurm.conf
}

start_slurm() {
  slurmctld -D >"$cluster/slurmctld.out" 2>&1 &
  daemons+=($!)
  # Each node has a processor of its own.
  taskset -c 0 slurmd -D -N node1 >"$cluster/node1.out" 2>&1 &
  daemons+=($!)
  taskset -c $(($(nproc) - 1)) slurmd -D -N node2 >"$cluster/node2.out" 2>&1 &
  node2=$!
  daemons+=("$node2")
  for ((wait = 0; wait < 60; ++wait)); do
    if [ "$(sinfo -h -t idle -o %D 2>/dev/null)" = 2 ]; then return; fi
    sleep 1
  done
  echo "try: found no two idle nodes after 60 s:" >&2
  sinfo >&2 || true
  tail -n 5 "$cluster"/*.log "$cluster"/*.out >&2
  exit 1
}

results() { find "$folder/out" -name '0*_0*.json' 2>/dev/null | wc -l; }

say "$images images of 160x120 px"
if [ ! -d "$folder/scenes" ]; then
  "$EDGESCOUT" render --part l_bracket --objects 1 --scenes $((images / 10)) --views 10 \
    --width 160 --height 120 --focal 200 --seed 1 --supersampling 1 --out "$folder/scenes" \
    2>/dev/null
fi
detect=("$folder/scenes" --model "$folder/scenes/models/obj_000001.ply" --unit mm --device cpu
  --viewpoints 1 --in-plane-steps 6 --distance-min 0.25 --distance-max 0.27 --scan-hits 200
  --coarse-poses 8 --medium-poses 3 --candidates 1 --min-probability 0.0001 --no-overlays)

say "one run on one processor, as a node has"
taskset -c 0 "$EDGESCOUT" detect "${detect[@]}" --out "$folder/one" 2>/dev/null

say "a cluster of two nodes, $shards shards"
start_munge
write_conf
start_slurm
sinfo
merge=$(LOCK_SECONDS=0 scripts/slurm/submit.sh "$shards" "$folder/out" detect "${detect[@]}")
until [ "$(results)" -ge $((images / 3)) ]; do sleep 0.3; done
before=$(results)
squeue -h -o '%i %T %N' | sort
# As if it lost its power: the daemon, its steps and their programs end at once. They are stopped
# first, so that no step reports that its program was killed.
mapfile -t lost < <({ descendants "$node2"; of_node node2; } | sort -un)
kill -STOP "${lost[@]}" 2>/dev/null || true
kill -9 "${lost[@]}" 2>/dev/null || true
echo "node2 killed after $before of $images results"

while squeue -h -j "$merge" 2>/dev/null | grep -q .; do
  sleep 2
  state=$(sinfo -h -N -o '%N %T' | tr '\n' ' ')
  if [ "$state" != "${last:-}" ]; then echo "nodes: $state"; fi
  last=$state
done
scontrol show jobs | awk '/JobId=/ { task = $0 } /Restarts=/ { print task, $0 }' |
  sed -nE 's/.*ArrayTaskId=([0-9]+) .*Restarts=([1-9][0-9]*).*/shard \1 was restarted: \2/p'
cat "$folder/out/log/merge.txt"

say "the merged result against that of one run"
scripts/compare_batches.py "$folder/one" "$folder/out/merged" --tables
