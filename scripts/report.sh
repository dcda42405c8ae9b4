#!/usr/bin/env bash
# ./scripts/report.sh [options of `sonarsim report`]: measures the tank and the sea floor and puts
# the tables into docs/performance.md and the plots beside it. Takes some minutes on an idle machine.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
"$root/scripts/setup.sh" python3-matplotlib
python3 "$root/scripts/make_scenes.py" seafloor
tables=()
for scene in tank seafloor; do
    out=$root/out/report_$scene
    "$root/build/sonarsim" report "$root/configs/${scene}_imaging.yaml" --out "$out" "$@"
    # Debian's matplotlib belongs to Debian's Python, which need not be the first on the PATH.
    /usr/bin/python3 "$root/scripts/plot_report.py" "$out/report.json" "$out"
    cp "$out/error_fls.svg" "$root/docs/error_$scene.svg"
    tables+=("$scene=$out/report.md")
done
python3 "$root/scripts/insert_tables.py" "$root/docs/performance.md" "${tables[@]}"
