#!/usr/bin/env bash
# ./scripts/package.sh: builds the Debian packages sonarsim, libsonarsim-dev and python3-sonarsim in
# build-package/, for the release of Debian that it runs on, and checks them with lintian if that is installed.
#   sudo apt install ./build-package/sonarsim_*.deb
# SONARSIM_FOLDER=build-release SONARSIM_PRESET=release packs the build of test.sh, and compiles hardly anything.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=${SONARSIM_FOLDER:-build-package}
SONARSIM_BUILD=no ./scripts/setup.sh dpkg-dev file help2man pybind11-dev python3-dev
cmake --preset "${SONARSIM_PRESET:-program}" -B "$folder" -DSONARSIM_TESTS=OFF -DCMAKE_INSTALL_PREFIX=/usr \
    -DSONARSIM_PYTHON=ON >&2
cmake --build "$folder" >&2
rm -f "$folder"/*.deb
# Directories and files as a package has them, whatever the umask of the checkout.
(umask 022 && cd "$folder" && cpack -G DEB >&2)
ls "$folder"/*.deb
if command -v lintian >/dev/null; then
    lintian --allow-root --fail-on error "$folder"/*.deb >&2
fi
