#!/usr/bin/env bash
# ./scripts/fuzz.sh [seconds]: builds tests/fuzz with clang and runs each target for that long
# (default: 60). New inputs are kept in build-fuzz/corpus, a crash in build-fuzz/crash-*.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60}
[[ $seconds =~ ^[1-9][0-9]*$ ]] || { echo "usage: $0 [seconds]" >&2; exit 2; }

SONARSIM_BUILD=no ./scripts/setup.sh clang libclang-rt-14-dev
cmake -S . -B build-fuzz -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DSONARSIM_FUZZ=ON >&2
cmake --build build-fuzz --target fuzz >&2

shopt -s nullglob
failed=()
for source in tests/fuzz/fuzz_*.cpp; do
    target=$(basename "$source" .cpp)
    name=${target#fuzz_}
    mkdir -p "build-fuzz/corpus/$name"
    corpora=("build-fuzz/corpus/$name")
    [ -d "tests/fuzz/corpus/$name" ] && corpora+=("tests/fuzz/corpus/$name")
    build-fuzz/tests/fuzz/"$target" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 \
        -artifact_prefix=build-fuzz/crash-"$name"- -print_final_stats=1 \
        "${corpora[@]}" || failed+=("$name")
done
if ((${#failed[@]})); then
    echo "failed: ${failed[*]}" >&2
    exit 1
fi
