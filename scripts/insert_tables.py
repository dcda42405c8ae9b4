#!/usr/bin/python3
"""insert_tables.py document.md name=table.md ...: puts each table between its marks
<!-- report NAME --> (or <!-- begin NAME -->) and <!-- end NAME --> in the document."""
import pathlib
import re
import sys


def main() -> int:
    document = pathlib.Path(sys.argv[1])
    text = document.read_text()
    for argument in sys.argv[2:]:
        name, table = argument.split("=", 1)
        marks = re.compile(rf"(<!-- (?:report|begin) {name} -->\n).*?(<!-- end {name} -->)", re.DOTALL)
        body = pathlib.Path(table).read_text()
        text, found = marks.subn(lambda m: m.group(1) + "\n" + body + "\n" + m.group(2), text)
        if found != 1:
            print(f"{document}: {found} places for the table '{name}'", file=sys.stderr)
            return 1
    document.write_text(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
