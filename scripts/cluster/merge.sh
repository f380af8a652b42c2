#!/bin/bash
# Puts the shards of shards.slurm together: merge.sh FOLDER writes FOLDER/all.
set -euo pipefail
if [ $# -ne 1 ] || [ ! -d "$1/shard-1" ]; then
  echo "usage: merge.sh FOLDER, with the FOLDER that shards.slurm was given" >&2
  exit 2
fi
exec "${ROCKYARD:-rockyard}" merge "$1"/shard-* --out "$1/all"
