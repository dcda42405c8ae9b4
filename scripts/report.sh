#!/usr/bin/env bash
# ./scripts/report.sh [options of `sonarsim report`]: measures the tank and the sea floor and puts
# the tables and plots into README.md and docs/. Takes some minutes on an idle machine.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
"$root/scripts/setup.sh"
python3 "$root/scripts/make_scenes.py" seafloor
for scene in tank seafloor; do
    "$root/build/sonarsim" report "$root/configs/${scene}_imaging.yaml" \
        --out "$root/out/report_$scene" "$@"
    cp "$root/out/report_$scene/error_fls.svg" "$root/docs/error_$scene.svg"
done
python3 "$root/scripts/readme_report.py" "$root/README.md" \
    "tank=$root/out/report_tank/report.md" "seafloor=$root/out/report_seafloor/report.md"
