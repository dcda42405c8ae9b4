#!/usr/bin/env bash
# ./scripts/write_keys.sh [program]: writes the tables of keys in docs/mission.md, the table of
# docs/warnings.md and that of presets in docs/calibrated.md, as the program (default: build/sonarsim)
# prints them. A test fails while they differ.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
program=${1:-$root/build/sonarsim}
tables=$(mktemp -d)
trap 'rm -rf "$tables"' EXIT
"$program" keys > "$tables/keys"
"$program" warnings > "$tables/warnings"
"$root/scripts/preset_table.sh" "$program" > "$tables/presets"
"$root/scripts/insert_tables.sh" "$root/docs/mission.md" "keys=$tables/keys"
"$root/scripts/insert_tables.sh" "$root/docs/warnings.md" "warnings=$tables/warnings"
"$root/scripts/insert_tables.sh" "$root/docs/calibrated.md" "presets=$tables/presets"
