#!/usr/bin/env bash
# ./scripts/same_sums.sh [SONARSIM]: renders a small mission with labels in every way that must give
# the same dataset, and prints the SHA-256 of SHA256SUMS for each: threads, shards merged in any order,
# ten kills and a resumption, a Slurm array, GNU parallel, another folder, another user. Exit code 1
# if one differs. Ways that need a missing program or root are skipped with a note.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
program=$(realpath "${1:-$root/build/sonarsim}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
chmod 755 "$work"

inputs() {  # FOLDER: the mission and the files that it names
    mkdir -p "$1/configs" "$1/scenes" "$1/trajectories"
    cp "$root/configs/tank_labels.yaml" "$1/configs/"
    cp "$root/scenes/tank.glb" "$root/scenes/materials.csv" "$1/scenes/"
    head -n 61 "$root/trajectories/tank_loop.csv" >"$1/trajectories/tank_loop.csv"
}
inputs "$work/here"
cd "$work/here"
mission=configs/tank_labels.yaml
small=(--set sensors.fls.range_bins=128 --set sensors.fls.azimuth_bins=64
    --set output.labels=true)
render() {  # OUT [options]
    "$program" render "$mission" "${small[@]}" --quiet --out "$@"
}

expected=
failed=0
report_sum() {  # OUT WORDS
    local sum
    sum=$(sha256sum <"$1/SHA256SUMS" | cut -c1-64)
    expected=${expected:-$sum}
    [[ $sum == "$expected" ]] || failed=1
    printf '%s  %s%s\n' "${sum:0:16}" "$2" "$([[ $sum == "$expected" ]] || echo '  DIFFERS')"
}

render "$work/j1" -j1
report_sum "$work/j1" "-j1"
render "$work/j2" -j2
report_sum "$work/j2" "-j2"

for k in 1 2 3; do
    render "$work/part$k" -j"$k" --shard "$k/3"
done
for order in "1 2 3" "1 3 2" "2 1 3" "2 3 1" "3 1 2" "3 2 1"; do
    read -r -a parts <<<"$order"
    "$program" merge "${parts[@]/#/$work/part}" "$work/merged" --quiet
    render "$work/merged"
    report_sum "$work/merged" "3 shards, merged as $order"
    rm -r "$work/merged"
done

pings() {  # the number of pings that the killed run has written
    find "$work" -path '*/killed/*/polar/*.npy' 2>/dev/null | wc -l
}
kills=0
for ((k = 1; k <= 10; ++k)); do
    before=$(pings)
    "$program" render "$mission" "${small[@]}" --quiet --out "$work/killed" -j2 \
        --checkpoint 0.01 &  # not through render(): its shell would be killed instead
    run=$!
    while kill -0 $run 2>/dev/null && (($(pings) < before + 1)); do :; done
    kill -9 $run 2>/dev/null && kills=$((kills + 1))
    wait $run 2>/dev/null || true
done
left=$(pings)
render "$work/killed" -j2
report_sum "$work/killed" "$kills kill -9, the last with $left pings written, then resumed"

for ((k = 1; k <= 3; ++k)); do
    SONARSIM=$program SLURM_ARRAY_TASK_ID=$k SLURM_ARRAY_TASK_COUNT=3 SLURM_ARRAY_TASK_MIN=1 \
        SLURM_ARRAY_TASK_MAX=3 bash "$root/scripts/slurm/shard.sbatch" "$mission" "$work/slurm" \
        "${small[@]}" 2>/dev/null
done
SONARSIM=$program bash "$root/scripts/slurm/merge.sbatch" 3 "$mission" "$work/slurm" \
    "${small[@]}"
report_sum "$work/slurm" "Slurm array of 3 tasks, its variables set by hand (a real one: tests/cli/test_clusters.py)"

if command -v parallel >/dev/null; then
    parallel -j2 "$program" render "$mission" "${small[@]}" --quiet --threads 1 \
        --shard '{}/4' --out "$work/gnu{}" ::: 1 2 3 4
    "$program" merge "$work"/gnu{1,2,3,4} "$work/gnu" --quiet
    render "$work/gnu"
    report_sum "$work/gnu" "GNU parallel, 4 shards"
else
    echo "not tried: GNU parallel (apt-get install parallel)"
fi

inputs "$work/another folder/deeper"
(cd "$work/another folder/deeper" && render out)
report_sum "$work/another folder/deeper/out" "another folder"

if ((EUID == 0)) && command -v setpriv >/dev/null; then
    inputs "$work/user"
    cp "$program" "$work/user/sonarsim"
    chown -R nobody "$work/user"
    (cd "$work/user" && setpriv --reuid=nobody --regid=nogroup --clear-groups env HOME=/nowhere \
        TZ=Asia/Tokyo LANG=C ./sonarsim render "$mission" "${small[@]}" --quiet --out out)
    report_sum "$work/user/out" "another user, home, time zone and language ($(stat -c %U "$work/user/out"))"
else
    echo "not tried: another user (needs root)"
fi
exit $failed
