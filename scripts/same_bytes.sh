#!/usr/bin/env bash
# Renders missions with several builds of sonarsim and compares every byte of their datasets:
#   ./scripts/same_bytes.sh [--folder DIR] [--mission FILE[,KEY=VALUE...]]... PROGRAM PROGRAM...
# A program may be a command of several words. Without --mission it is tests/four_sonars.yaml, once with each engine.
# `build` of dataset.json may differ. Exit code 0: all alike; 1: not.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
parent=${TMPDIR:-/tmp}
missions=()
while [[ ${1:-} == --* ]]; do
    case $1 in
        --folder) parent=$2 ;;
        --mission) missions+=("$2") ;;
        *) sed -n '2,5s/^# //p' "$0" >&2 && exit 2 ;;
    esac
    shift 2
done
if ((${#missions[@]} == 0)); then
    missions=("$root/tests/four_sonars.yaml,engine="{rays,octree,strips})
fi
out=$(mktemp -d "$parent/same_bytes-XXXXXX")
trap 'rm -rf "$out"' EXIT

sums() { # program, mission: the sum of every file of the dataset
    local words=()
    IFS=, read -ra words <<<"$2"
    # shellcheck disable=SC2046,SC2086  # a program of several words
    $1 render "${words[0]}" --quiet $(printf -- '--set %s ' "${words[@]:1}" "output.folder=$out/dataset")
    (
        cd "$out/dataset"
        find . -name dataset.json -exec sed -i '/^ "build": {/,/^ }/d' {} +
        find . -type f ! -name SHA256SUMS -print0 | sort -z | xargs -0 sha256sum
    )
    rm -rf "$out/dataset"
}

failed=0
first=$1
shift
for mission in "${missions[@]}"; do
    sums "$first" "$mission" >"$out/expected"
    for program in "$@"; do
        sums "$program" "$mission" >"$out/found"
        if cmp -s "$out/expected" "$out/found"; then
            echo "$mission: $first and $program: $(wc -l <"$out/expected") files, all alike"
        else
            failed=1
            echo "$mission: $first and $program: files differ"
            diff "$out/expected" "$out/found" | head -20 || true
        fi
    done
done
exit $failed
