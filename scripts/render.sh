#!/usr/bin/env bash
# ./scripts/render.sh [mission.yaml] [options of `sonarsim render`]: installs, builds and renders.
# A scene of scripts/make_scenes.py that the mission names and that is missing is made first.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
"$root/scripts/setup.sh"
if (($# == 0)); then
    set -- "$root/configs/tank_imaging.yaml"
fi
if [[ -f $1 ]]; then
    name=$(sed -n 's#^ *file: *\.\./scenes/generated/\([a-z]*\)\.glb.*#\1#p' "$1")
    if [[ -n $name && ! -e $root/scenes/generated/$name.glb ]]; then
        case $name in
            motorbike) "$root/scripts/foreign_mesh.sh" ;;
            *) "$root/scripts/make_scenes.py" "$name" ;;
        esac
    fi
fi
exec "$root/build/sonarsim" render "$@"
