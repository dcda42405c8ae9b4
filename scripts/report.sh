#!/usr/bin/env bash
# ./scripts/report.sh [options of `sonarsim report`]: measures the tank and the sea floor and puts
# the tables into docs/accuracy.md. Takes some minutes on an idle machine.
# SCENES="tank seafloor wreck lifeboat motorbike" ./scripts/report.sh: measures these, into
# out/report_SCENE. Tables that docs/accuracy.md has marks for go into that page.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
"$root/scripts/setup.sh"
tables=()

measure() { # scene, the name of its report, options of `sonarsim report`
    local scene=$1 name=$2 out=$root/out/report_$2
    shift 2
    "$root/build/sonarsim" report "$root/configs/${scene}_imaging.yaml" --out "$out" "$@"
    if grep -q "<!-- report $name -->" "$root/docs/accuracy.md"; then
        awk '/^\|/ { print; found = 1; next } found { exit }' "$out/report.md" >"$out/table.md"
        tables+=("$name=$out/table.md")
    fi
}

if [[ " $* " != *" --engines"* ]]; then
    set -- --engines rays,strips "$@"
fi
for scene in ${SCENES:-tank seafloor}; do
    case $scene in
        tank) measure tank tank "$@" ;;
        motorbike)
            "$root/scripts/foreign_mesh.sh"
            measure motorbike motorbike "$@"
            ;;
        *)
            /usr/bin/python3 "$root/scripts/make_scenes.py" "$scene"
            measure "$scene" "$scene" "$@"
            ;;
    esac
done
if ((${#tables[@]})); then
    "$root/scripts/insert_tables.sh" "$root/docs/accuracy.md" "${tables[@]}"
fi
