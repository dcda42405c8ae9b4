#!/usr/bin/env bash
# ./scripts/render.sh [mission.yaml] [options of `sonarsim render`]: installs, builds and renders.
# Scenes of scripts/make_scenes.py and foreign_mesh.sh that the mission names and that are missing
# are made first. SONARSIM=PROGRAM renders with that program: nothing is built then.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
if [[ -z ${SONARSIM:-} ]]; then
    SONARSIM_IMAGES=no "$root/scripts/setup.sh"
    SONARSIM=$root/build/sonarsim
fi
# Builds the module that reads heightmaps and maps, if a mission has some.
add_images() {
    [[ $SONARSIM = "$root/build/sonarsim" && ! -e $root/build/lib/sonarsim/libsonarsim_images.so ]] || return 0
    [[ $("$SONARSIM" validate "$1" 2>&1) = *"install libopenimageio-dev"* ]] || return 0
    "$root/scripts/setup.sh"
}
if (($# == 0)); then
    set -- "$root/configs/tank_imaging.yaml"
fi
# The first argument that is a file is the mission; the program says what is wrong with it.
for argument in "$@"; do
    if [[ -f $argument ]]; then
        /usr/bin/python3 -B "$root/scripts/make_scenes.py" --for "$argument" "$@" >&2
        add_images "$argument"
        break
    fi
done
exec "$SONARSIM" render "$@"
