#!/usr/bin/env bash
# ./scripts/foreign_mesh.sh: makes scenes/generated/motorbike.glb, a detailed mesh of other
# origin: motorBike.obj of Debian's openfoam-examples, enlarged twice (4.1 x 1.4 x 2.7 m), all of steel,
# with its wheels on z = 0 and its middle at the origin. Installs the packages that it needs.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
SONARSIM_BUILD=no "$root/scripts/setup.sh" openfoam-examples assimp-utils
folder=$root/scenes/generated
mkdir -p "$folder"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
echo "newmtl steel" >"$work/steel.mtl"
# The file is z up, and glTF is y up.
zcat /usr/share/doc/openfoam-examples/examples/resources/geometry/motorBike.obj.gz | awk '
    BEGIN { print "mtllib steel.mtl" }
    /^v / { printf "v %.6f %.6f %.6f\n", 2 * ($2 - 0.7297), 2 * $4, -2 * $3; next }
    /^g / { print; print "usemtl steel"; next }
    /^f / { print }' >"$work/motorbike.obj"
assimp export "$work/motorbike.obj" "$work/motorbike.glb" -fglb2 >"$work/log" || {
    cat "$work/log" >&2
    exit 1
}
mv "$work/motorbike.glb" "$folder/motorbike.glb"
echo "$folder/motorbike.glb"
