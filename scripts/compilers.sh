#!/usr/bin/env bash
# ./scripts/compilers.sh: compares the bytes that the release build (g++) renders with those of the
# build for the address sanitizer (clang++). debian13.sh compares with a newer g++.
set -euo pipefail
cd "$(dirname "$0")/.."
for preset in release asan; do
    SONARSIM_PRESET=$preset SONARSIM_BUILD=no ./scripts/setup.sh
done

# As test.sh configures it, so that its build is used where there is one.
export SONARSIM_JOINED=${SONARSIM_JOINED:-ON}
cmake --preset release >&2
cmake --build build-release --target sonarsim >&2
cmake --preset asan >&2
cmake --build build-asan --target sonarsim >&2
exec ./scripts/same_bytes.sh \
    --mission tests/four_sonars.yaml,engine=rays --mission tests/four_sonars.yaml,engine=octree \
    --mission tests/four_sonars.yaml,engine=strips \
    --mission configs/tank_imaging.yaml,trajectory.rate_hz=0.5 \
    --mission configs/tank_multipath.yaml,trajectory.rate_hz=0.5 \
    --mission configs/tank_scanning.yaml \
    --mission configs/tank_calibrated.yaml,trajectory.rate_hz=0.2 \
    build-release/sonarsim build-asan/sonarsim
