#!/usr/bin/env bash
# ./scripts/fuzz.sh [seconds]: runs each target of tests/fuzz for that long (default: 60), as many at
# a time as there are cores, in the build of the preset asan. New inputs are kept in
# build-asan/fuzz/NAME, the output in NAME.log, and an input that ends a target in NAME-crash-*.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60}
[[ $seconds =~ ^[1-9][0-9]*$ ]] || { echo "usage: $0 [seconds]" >&2; exit 2; }

export SONARSIM_PRESET=asan
SONARSIM_BUILD=no ./scripts/setup.sh
cmake --preset asan >&2
cmake --build build-asan --target fuzz >&2

fuzz() {
    local name=$1 seconds=$2 folder=build-asan/fuzz code=0 leaks=1
    # OpenImageIO and libassimp leak a little of files that they refuse.
    case $name in images | mesh) leaks=0 ;; esac
    mkdir -p "$folder/$name"
    ASAN_OPTIONS="detect_leaks=$leaks:${ASAN_OPTIONS:-}" build-asan/tests/fuzz/fuzz_"$name" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 \
        -artifact_prefix="$folder/$name"- -print_final_stats=1 \
        "$folder/$name" "tests/fuzz/corpus/$name" >"$folder/$name.log" 2>&1 || code=$?
    local runs
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$folder/$name.log")
    echo "$name: ${runs:-0} executions in $seconds s, $([ "$code" = 0 ] && echo no finding || echo "FINDING, see $folder/$name.log")"
    return "$code"
}
export -f fuzz
find tests/fuzz -name 'fuzz_*.cpp' | sed 's/.*fuzz_//; s/\.cpp$//' | sort |
    xargs -P "$(nproc)" -I{} bash -c "fuzz {} $seconds"
