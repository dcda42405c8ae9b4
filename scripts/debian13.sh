#!/usr/bin/env bash
# ./scripts/debian13.sh [--prepare] [folder]: runs README's first command on Debian 13, in a chroot
# (default: /var/tmp/sonarsim-debian13, kept for the next time) and in a copy of the last commit;
# verifies the dataset, and compares the datasets of that build and of this machine's, byte by byte.
# --prepare only makes the chroot and installs the packages. The chroot takes root and some 1.2 GB.
# Exit code 77 if a chroot cannot be made.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
prepare=no
if [ "${1:-}" = --prepare ]; then
    prepare=yes
    shift
fi
chroot=${1:-/var/tmp/sonarsim-debian13}
clone=$root/build-debian13/clone

skip() {
    echo "skipped: $1" >&2
    exit 77
}
[ "$(id -u)" -eq 0 ] || skip "only root can make a chroot of Debian 13"
SONARSIM_BUILD=no ./scripts/setup.sh mmdebstrap debian-archive-keyring ||
    skip "mmdebstrap cannot be installed"
unshare --mount true 2>/dev/null || skip "this machine does not let root mount into a chroot"

if [ ! -e "$chroot/etc/debian_version" ]; then
    # The name is final only when the chroot is whole: an interrupted run leaves none behind.
    rm -rf "$chroot.part"
    mmdebstrap --quiet --variant=minbase --include=ca-certificates \
        --aptopt='Acquire::Check-Valid-Until "false"' --aptopt='Acquire::Check-Date "false"' trixie "$chroot.part" \
        "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian trixie main" ||
        skip "Debian 13 cannot be fetched"
    mv "$chroot.part" "$chroot"
fi

# The mounts end with the process that made them. The checkout has the same path inside and outside,
# so that one command line serves both.
cat >"$chroot/enter" <<'END'
set -euo pipefail
chroot=$1 root=$2
shift 2
mkdir -p "$chroot$root"
mount --bind "$root" "$chroot$root"
mount --bind /dev "$chroot/dev"
mount -t proc proc "$chroot/proc"
exec chroot "$chroot" "$@"
END
enter=(unshare --mount bash "$chroot/enter" "$chroot" "$root")
"${enter[@]}" env SONARSIM_BUILD=no "$root/scripts/setup.sh"
[ "$prepare" = no ] || exit 0

rm -rf "$clone"
mkdir -p "$clone"
# No clone: git would require the checkout to belong to this user.
git -c safe.directory='*' archive HEAD | tar -x -C "$clone"
"${enter[@]}" "$clone/scripts/render.sh" "$clone/configs/tank_imaging.yaml" --quiet --out "$clone/out/tank"
"${enter[@]}" "$clone/build/sonarsim" verify "$clone/out/tank"

# The build of the tests is used where there is one.
program=$root/build-release/sonarsim
if [ ! -x "$program" ]; then
    ./scripts/setup.sh
    program=$root/build/sonarsim
fi
configs=$root/configs
exec ./scripts/same_bytes.sh --folder "$root/build-debian13" \
    --mission "$root/tests/four_sonars.yaml,engine=rays" --mission "$root/tests/four_sonars.yaml,engine=octree" \
    --mission "$configs/tank_imaging.yaml,trajectory.rate_hz=1" \
    --mission "$configs/tank_multipath.yaml,trajectory.rate_hz=1" \
    --mission "$configs/tank_calibrated.yaml,trajectory.rate_hz=0.2" \
    --mission "$configs/tank_echosounder.yaml" "$program" "${enter[*]} $clone/build/sonarsim"
