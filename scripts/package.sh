#!/usr/bin/env bash
# ./scripts/package.sh: builds the Debian packages sonarsim, libsonarsim-dev and python3-sonarsim in
# build-package/, for the release of Debian that it runs on, and checks them with lintian if that is installed.
#   sudo apt install ./build-package/sonarsim_*.deb
set -euo pipefail
cd "$(dirname "$0")/.."
SONARSIM_BUILD=no ./scripts/setup.sh dpkg-dev file pybind11-dev python3-dev
cmake --preset "${SONARSIM_PRESET:-program}" -B build-package -DSONARSIM_TESTS=OFF -DCMAKE_INSTALL_PREFIX=/usr \
    -DSONARSIM_PYTHON=ON -DPython3_EXECUTABLE=/usr/bin/python3 >&2
cmake --build build-package >&2
rm -f build-package/*.deb
# Directories and files as a package has them, whatever the umask of the checkout.
(umask 022 && cd build-package && cpack -G DEB >&2)
ls build-package/*.deb
if command -v lintian >/dev/null; then
    lintian --allow-root --fail-on error build-package/*.deb >&2
fi
