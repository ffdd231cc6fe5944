#!/bin/bash
# Joins the shards of submit.sh: OUT
set -euo pipefail
exec "$EDGESCOUT" merge "$1"/shard_* --out "$1/merged"
