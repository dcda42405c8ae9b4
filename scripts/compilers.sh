#!/usr/bin/env bash
# ./scripts/compilers.sh: builds the program with clang++ (in build-compilers/) and compares the bytes
# that it renders with those of the release build (g++). debian13.sh does so with a newer g++.
set -euo pipefail
cd "$(dirname "$0")/.."
SONARSIM_BUILD=no ./scripts/setup.sh clang

# As test.sh configures it, so that its build is used where there is one.
export SONARSIM_JOINED=${SONARSIM_JOINED:-ON}
cmake --preset release >&2
cmake --build build-release --target sonarsim >&2
# Warnings are no errors here: a folder is compiled as one file, in which names of one file shadow
# those of another. The other builds check warnings file by file.
cmake --preset program -B build-compilers -DCMAKE_CXX_COMPILER=clang++ -DSONARSIM_WERROR=OFF >&2
cmake --build build-compilers --target sonarsim >&2
exec ./scripts/same_bytes.py \
    --mission tests/four_sonars.yaml,engine=rays --mission tests/four_sonars.yaml,engine=octree \
    --mission tests/four_sonars.yaml,engine=slices \
    --mission configs/tank_imaging.yaml,trajectory.rate_hz=0.5 \
    --mission configs/tank_multipath.yaml,trajectory.rate_hz=0.5 \
    --mission configs/tank_scanning.yaml \
    --mission configs/tank_calibrated.yaml,trajectory.rate_hz=0.2 \
    build-release/sonarsim build-compilers/sonarsim
