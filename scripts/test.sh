#!/usr/bin/env bash
# Installs, builds and runs every test. SONARSIM_PRESET=asan or tsan runs them under sanitizers. Options are ctest's.
# SONARSIM_JOINED=OFF compiles each file by itself: slower for a full build, faster after a change.
set -euo pipefail
cd "$(dirname "$0")/.."
export SONARSIM_PRESET=${SONARSIM_PRESET:-release}
export SONARSIM_JOINED=${SONARSIM_JOINED:-ON}
./scripts/setup.sh
exec ctest --preset "$SONARSIM_PRESET" -j2 "$@"
