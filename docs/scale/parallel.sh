#!/bin/sh
# Every shard of a job with GNU parallel, on this machine or on those that ssh reaches, and the merged report:
#
#   docs/scale/parallel.sh docs/scale/errors.json 4 results/campaign
#   docs/scale/parallel.sh docs/scale/errors.json 400 /shared/campaign --sshloginfile machines
#
# With machines: the directory must be one that all of them see, and blysk of the same version be installed on each.
# A shard that fails is tried once more, and goes on from its checkpoint.
set -eu
job=$1 shards=$2 out=$3
shift 3
blysk=${BLYSK:-blysk}
"$blysk" shard plan "$job" --shards "$shards" --out "$out"
seq 0 $((shards - 1)) | parallel --retries 2 "$@" \
    RAYON_NUM_THREADS=1 "$blysk" shard run "$out" --index {}
"$blysk" shard merge "$out" --out "$out/merged"
