#!/usr/bin/env bash
# ./scripts/debian13.sh [folder]: builds the program on Debian 13 in a chroot (default:
# /var/tmp/sonarsim-debian13, kept for the next time) and compares the bytes that it and the build of
# this machine render. Takes root and, at first, some 700 MB. Exit code 77 where it cannot run.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
chroot=${1:-/var/tmp/sonarsim-debian13}
program=$root/build-debian13/sonarsim

skip() {
    echo "skipped: $1" >&2
    exit 77
}
[ "$(id -u)" -eq 0 ] || skip "only root may make a chroot"
command -v mmdebstrap >/dev/null || skip "mmdebstrap is not installed"
[ -e /usr/share/keyrings/debian-archive-keyring.gpg ] || skip "Debian's keys are not installed"

if [ ! -e "$chroot/etc/debian_version" ]; then
    mmdebstrap --quiet --variant=minbase --include=ca-certificates \
        --aptopt='Acquire::Check-Valid-Until "false"' --aptopt='Acquire::Check-Date "false"' trixie "$chroot" \
        "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian trixie main" ||
        skip "Debian 13 cannot be fetched"
fi
./scripts/setup.sh python3-pil

# The mounts go with the process that made them. The checkout is where it is outside, so that one
# command line serves both.
cat >"$chroot/enter" <<'END'
#!/usr/bin/env bash
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
"${enter[@]}" bash -c "cd '$root' && cmake --preset program -B build-debian13 && cmake --build build-debian13 --target sonarsim"

configs=$root/configs
# Another zlib compresses the same pixels otherwise.
# Debian's Pillow belongs to Debian's Python, which need not be the first on the PATH.
exec /usr/bin/python3 ./scripts/same_bytes.py --pixels --folder "$root/build-debian13" \
    --mission "$root/tests/four_sonars.yaml,engine=rays" --mission "$root/tests/four_sonars.yaml,engine=octree" \
    --mission "$configs/tank_imaging.yaml,trajectory.rate_hz=1" \
    --mission "$configs/tank_multipath.yaml,trajectory.rate_hz=1" \
    --mission "$configs/tank_echosounder.yaml" "$root/build/sonarsim" "${enter[*]} $program"
