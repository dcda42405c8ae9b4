#!/usr/bin/env bash
# Renders a mission on a Slurm cluster: an array of shards, then their merge.
#
#   scripts/slurm/render.sh N mission.yaml OUT [options of sbatch] [-- options of sonarsim render]
#
# submits N tasks, of which the k-th renders --shard k/N into OUT.parts/k, and a job that waits for
# all of them (afterok), merges the parts into OUT, completes and verifies it. Prints the number of that last
# job. To retry, give the same command again: parts that are done are not rendered again. OUT.parts/
# may be removed once OUT is verified. All nodes see the same folders and have the program at the same
# place; SONARSIM names it (default: build/sonarsim of this repository, else the one in the PATH).
set -euo pipefail
if (($# < 3)) || ! [[ $1 =~ ^[1-9][0-9]*$ ]]; then
    sed -n '2,/^set/s/^# \{0,1\}//p' "$0" >&2
    exit 2
fi
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
shards=$1 mission=$(realpath -e "$2") out=$(realpath -m "$3")
shift 3
batch=()
while (($# > 0)) && [[ $1 != -- ]]; do
    batch+=("$1")
    shift
done
built=$here/../../build/sonarsim
[[ -x $built ]] || built=$(command -v sonarsim || true)
export SONARSIM=${SONARSIM:-$built}
[[ -n $SONARSIM ]] || { echo "sonarsim is not built here nor in the PATH; say where: SONARSIM=..." >&2; exit 2; }
mkdir -p "$out.parts"
array=$(sbatch --parsable --array="1-$shards" --job-name="sonarsim-$(basename "$out")" \
    --output="$out.parts/%a.log" ${batch[@]+"${batch[@]}"} \
    "$here/shard.sbatch" "$mission" "$out" "${@:2}")
sbatch --parsable --dependency="afterok:${array%%;*}" --kill-on-invalid-dep=yes \
    --job-name="sonarsim-$(basename "$out")-merge" --output="$out.parts/merge.log" \
    ${batch[@]+"${batch[@]}"} "$here/merge.sbatch" "$shards" "$mission" "$out" "${@:2}"
