#!/usr/bin/env bash
# Installs, builds and runs every test. SONARSIM_PRESET=asan or tsan runs them under sanitizers.
set -euo pipefail
cd "$(dirname "$0")/.."
export SONARSIM_PRESET=${SONARSIM_PRESET:-release}
./scripts/setup.sh
exec ctest --preset "$SONARSIM_PRESET" -j2
