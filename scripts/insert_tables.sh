#!/usr/bin/env bash
# insert_tables.sh document.md name=table.md ...: puts each table between its marks
# <!-- report NAME --> (or <!-- begin NAME -->) and <!-- end NAME --> in the document.
set -euo pipefail
document=$1
shift
for argument in "$@"; do
    awk -v name="${argument%%=*}" -v table="${argument#*=}" '
        $0 == "<!-- end " name " -->" && within { within = 0; print "" }
        !within
        $0 ~ "^<!-- (report|begin) " name " -->$" { within = 1; found++; print ""; while ((getline line < table) > 0) print line }
        END { if (found != 1 || within) { print FILENAME ": " found + 0 " places for the table " name > "/dev/stderr"; exit 1 } }
    ' "$document" >"$document.part" || { rm "$document.part"; exit 1; }
    mv "$document.part" "$document"
done
