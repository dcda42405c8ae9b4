#!/usr/bin/env bash
# ./scripts/benchmark.sh fls|sidescan [variants]: renders configs/benchmark/NAME.yaml, or its first variants, and
# compares the pictures with NAME.sha256: for each variant, the sum of the lines of its SHA256SUMS that name pictures
# and labels.
# ./scripts/benchmark.sh NAME --write: writes that list. SONARSIM=PROGRAM as for render.sh; OUT=FOLDER in place of out.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
name=${1:?fls or sidescan}
mission=$root/configs/benchmark/$name.yaml
list=$root/configs/benchmark/$name.sha256
out=${OUT:-$root/out}/benchmark_$name${2:+_${2#--}}
settings=()
[[ ${2:---write} = --write ]] || settings=(--set "variants=$2")
"$root/scripts/render.sh" "$mission" --out "$out" "${settings[@]}"
sums() {
    for folder in "$out"/variant_*; do
        sum=$(grep -E '/(fan|raw|objects|silhouette|waterfall)[/.]' "$folder/SHA256SUMS" | sha256sum)
        echo "${sum%% *}  ${folder##*/}"
    done
}
if [[ ${2:-} = --write ]]; then
    sums >"$list"
else
    diff <(sums) <(head -n "${2:-1000000}" "$list") && echo "benchmark_$name: the same pictures and labels as in $list"
fi
