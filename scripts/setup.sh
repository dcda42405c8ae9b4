#!/usr/bin/env bash
# Installs the Debian packages that are missing, configures and builds. Sourced by render.sh and
# test.sh, or run alone. SONARSIM_PRESET picks the CMake preset (default: release).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

packages=(g++ cmake ninja-build ccache pkg-config python3
    libeigen3-dev libembree-dev libtbb-dev librandom123-dev libopenimageio-dev libtinygltf-dev
    libyaml-cpp-dev libcli11-dev nlohmann-json3-dev libspdlog-dev doctest-dev)
missing=()
for package in "${packages[@]}"; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done
if ((${#missing[@]})); then
    echo "installing: ${missing[*]}" >&2
    sudo=""
    [ "$(id -u)" -eq 0 ] || sudo=sudo
    $sudo apt-get update -qq
    DEBIAN_FRONTEND=noninteractive $sudo apt-get install -y -qq --no-install-recommends "${missing[@]}"
fi

preset=${SONARSIM_PRESET:-release}
cmake --preset "$preset" >&2
cmake --build --preset "$preset" >&2
