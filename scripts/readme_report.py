#!/usr/bin/env python3
"""readme_report.py README.md name=table.md ...: puts each table between its marks
<!-- report NAME --> and <!-- end NAME --> in the README."""
import pathlib
import re
import sys


def main() -> int:
    readme = pathlib.Path(sys.argv[1])
    text = readme.read_text()
    for argument in sys.argv[2:]:
        name, table = argument.split("=", 1)
        marks = re.compile(rf"(<!-- report {name} -->\n).*?(<!-- end {name} -->)", re.DOTALL)
        body = pathlib.Path(table).read_text()
        text, found = marks.subn(lambda m: m.group(1) + "\n" + body + "\n" + m.group(2), text)
        if found != 1:
            print(f"{readme}: {found} places for the table '{name}'", file=sys.stderr)
            return 1
    readme.write_text(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
