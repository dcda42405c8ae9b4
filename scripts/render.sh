#!/usr/bin/env bash
# ./scripts/render.sh [mission.yaml] [options of `sonarsim render`]: installs, builds and renders.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
"$root/scripts/setup.sh"
if (($# == 0)); then
    set -- "$root/configs/tank_imaging.yaml"
fi
exec "$root/build/sonarsim" render "$@"
