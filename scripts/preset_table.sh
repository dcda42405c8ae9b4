#!/usr/bin/env bash
# ./scripts/preset_table.sh program: prints the table of presets of docs/calibrated.md.
set -euo pipefail
"$1" preset --json | python3 -c '
import json, sys
def level(preset, key):  # a star: the preset gives it
    return format(preset[key + "_db"], ".1f") + " *" * (preset[key] == "given")
print("| preset | source level | noise | directivity | band, kHz | full scale "
      "| mud, m | sand, m | rock, m | sphere, m | range, m |")
print("|---" * 11 + "|")
for preset in json.load(sys.stdin):
    cells = [preset["preset"], level(preset, "source_level"), level(preset, "noise"),
             format(preset["receiving_directivity_db"], ".1f"),
             format(1e-3 * preset["noise_bandwidth_hz"], ".3g"), level(preset, "full_scale"),
             *(format(range_m, ".3g") for range_m in preset["noise_range_m"].values()),
             format(preset["range_max_m"], ".4g")]
    print("|", " | ".join(cells), "|")
'
