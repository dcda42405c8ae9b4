#!/usr/bin/env bash
# Installs the Debian packages that are missing, then configures and builds.
#   ./scripts/setup.sh [more packages]
# SONARSIM_PRESET picks the CMake preset (default: release); SONARSIM_BUILD=no only installs.
set -euo pipefail
cd "$(dirname "$0")/.."

packages=(g++ cmake ninja-build ccache make pkg-config python3
    libeigen3-dev libembree-dev libtbb-dev librandom123-dev libopenimageio-dev libtinygltf-dev
    libyaml-cpp-dev libcli11-dev nlohmann-json3-dev libspdlog-dev doctest-dev "$@")
preset=${SONARSIM_PRESET:-release}
case $preset in asan | tsan) packages+=(clang libclang-rt-14-dev) ;; esac
missing=()
for package in "${packages[@]}"; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done
if ((${#missing[@]})); then
    echo "installing: ${missing[*]}" >&2
    as_root=()
    [ "$(id -u)" -eq 0 ] || as_root=(sudo)
    "${as_root[@]}" apt-get update -qq
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y -qq --no-install-recommends "${missing[@]}" >&2
fi
[ "${SONARSIM_BUILD:-yes}" = yes ] || exit 0

cmake --preset "$preset" >&2
cmake --build --preset "$preset" >&2
