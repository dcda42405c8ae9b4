#!/usr/bin/env bash
# ./scripts/write_keys.sh [program]: writes the tables of keys in docs/mission.md, as the program
# (default: build/sonarsim) prints them. A test fails while they differ.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
table=$(mktemp)
trap 'rm -f "$table"' EXIT
"${1:-$root/build/sonarsim}" keys > "$table"
python3 "$root/scripts/insert_tables.py" "$root/docs/mission.md" "keys=$table"
