#!/usr/bin/env bash
# Installs the Debian packages that are missing, then configures and builds.
#   ./scripts/setup.sh [more packages]
# SONARSIM_PRESET picks the CMake preset (default: program, build/sonarsim without the tests);
# SONARSIM_BUILD=no only installs; SONARSIM_IMAGES=no installs nothing for heightmaps and maps.
set -euo pipefail
cd "$(dirname "$0")/.."

preset=${SONARSIM_PRESET:-program}

install() {
    local package missing=() as_root=()
    for package in "$@"; do
        dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
    done
    ((${#missing[@]})) || return 0
    echo "installing: ${missing[*]}" >&2
    [ "$(id -u)" -eq 0 ] || as_root=(sudo)
    "${as_root[@]}" apt-get update -qq
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y -qq --no-install-recommends "${missing[@]}" >&2
}

# OpenImageIO brings more packages than all others together.
[ "${SONARSIM_IMAGES:-yes}" = no ] || set -- libopenimageio-dev libtiff-dev "$@"
# The tests need their framework; the Python package is left out under sanitizers.
[ "$preset" = program ] || set -- doctest-dev "$@"
case $preset in
    program) set -- pybind11-dev python3-dev python3-numpy python3-pil "$@" ;;
    release | dev)
        set -- pybind11-dev python3-dev python3-numpy python3-pil python3-scipy python3-matplotlib python3-yaml "$@"
        ;;
esac
install g++ cmake ninja-build ccache make pkg-config python3 \
    libeigen3-dev libembree-dev libtbb-dev librandom123-dev libtinygltf-dev \
    libyaml-cpp-dev libcli11-dev nlohmann-json3-dev libspdlog-dev libdeflate-dev nettle-dev libassimp-dev "$@"
case $preset in
    asan | tsan)
        install clang
        # The sanitizers' package has the compiler's version in its name: 14 on Debian 12, 19 on Debian 13.
        install "libclang-rt-$(clang++ -dumpversion | cut -d. -f1)-dev"
        ;;
esac
[ "${SONARSIM_BUILD:-yes}" = yes ] || exit 0

cmake --preset "$preset" >&2
cmake --build --preset "$preset" >&2
