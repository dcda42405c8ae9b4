#!/usr/bin/env bash
# ./scripts/compilers.sh: builds the program with g++ -O2 and clang++ -O3 (below build-compilers/) and
# compares the bytes that they render with those of the release build (g++ -O3).
set -euo pipefail
cd "$(dirname "$0")/.."
SONARSIM_BUILD=no ./scripts/setup.sh clang

# As test.sh configures it, so that its build is used where there is one.
export SONARSIM_JOINED=${SONARSIM_JOINED:-ON}
cmake --preset release >&2
cmake --build build-release --target sonarsim >&2
programs=(build-release/sonarsim)
for build in "g++ -O2" "clang++ -O3"; do
    read -r compiler level <<<"$build"
    folder=build-compilers/$compiler$level
    # Warnings are no errors here: a folder is compiled as one file, in which names of one file shadow
    # those of another. The other builds check warnings file by file.
    cmake --preset program -B "$folder" -DCMAKE_CXX_COMPILER="$compiler" -DSONARSIM_WERROR=OFF \
        -DCMAKE_CXX_FLAGS_RELEASE="$level -DNDEBUG" >&2
    cmake --build "$folder" --target sonarsim >&2
    programs+=("$folder/sonarsim")
done
exec ./scripts/same_bytes.py \
    --mission tests/four_sonars.yaml,engine=rays --mission tests/four_sonars.yaml,engine=octree \
    --mission tests/four_sonars.yaml,engine=slices \
    --mission configs/tank_imaging.yaml,trajectory.rate_hz=0.5 \
    --mission configs/tank_multipath.yaml,trajectory.rate_hz=0.5 \
    --mission configs/tank_scanning.yaml \
    --mission configs/tank_calibrated.yaml,trajectory.rate_hz=0.2 \
    "${programs[@]}"
