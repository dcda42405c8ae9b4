"""Fails for comments that begin as fragments, and for words that a reader of this field does not expect.

    python3 tests/words.py <root of the repository>

A comment begins with a noun phrase or a sentence ("True if ...", "The number of ..."), not with a
preposition or a question word ("Of the ...", "Whether ...", "How many ..."). BANNED names the words
and what to write instead; they are searched in comments and string literals of C++ and in pages.
The rules hold for the folders and pages of CLEAN, and are first tried on made-up faults.
"""
import pathlib
import re
import sys
import tempfile

# Folders and pages that follow the rules.
CLEAN = ["CHANGELOG.md", "CONTRIBUTING.md", "README.md", "apps", "docs", "lib", "tests"]
# Begins of a comment that lack a subject.
FRAGMENT = re.compile(r"(of|by|that of|those|what|whether|how|where|whose|which|in which)\b",
                      re.IGNORECASE)
# The same within a comment, after a full stop, and in pages at the begin of a line.
INVERSION = re.compile(r"(?:(?<=\. )|^)(Of|That of|Those of|By how|In which|Whether|What is)\b")
BANNED = {
    r"there and back": "two-way",
    r"by way of": "over, through or by",
    r"told\b": "reported, named or warned",
    r"heard?\b": "insonified, received or visible",
    r"lit\b": "occupied or insonified",
    r"by so much": "the quantity",
    r"sees? anew": "again",
    r"makes? (?:it|them) anew": "again",
    r"goes on from there": "continues",
    r"is no (?:\.npy|archive|dataset|file|PNG|shard)\b": "is not a, or cannot be",
    r"doubt(?:s|ful|ed)?\b": "warning",
}
WORDS = re.compile(r"\b(?:" + "|".join(f"({word})" for word in BANNED) + ")", re.IGNORECASE)
LITERAL = re.compile(r'"(?:\\.|[^"\\])*"')


def comments_of(lines: list[str]) -> list[tuple[int, str]]:
    """The comments of a C++ file with the number of their first line; consecutive comment lines are
    one, a comment behind code begins another."""
    comments, open_block = [], False
    for number, line in enumerate(lines, 1):
        bare = LITERAL.sub('""', line) if not line.lstrip().startswith("//") else line
        match = re.search(r"//(?:/<?)?(.*)$", bare)
        alone = bare.lstrip().startswith("//")
        if match and alone and open_block and match.group(1).strip():
            comments[-1] = (comments[-1][0], comments[-1][1] + " " + match.group(1).strip())
        elif match and match.group(1).strip():
            comments.append((number, match.group(1).strip()))
        open_block = bool(match and alone and match.group(1).strip())
    return comments


def faults_of_comment(text: str) -> list[str]:
    faults = [f"a comment begins with '{match.group()}'" for match in [FRAGMENT.match(text)] if match]
    return faults or inversions_in(text)


def inversions_in(text: str) -> list[str]:
    return [f"a sentence begins with '{found}'" for found in INVERSION.findall(text)]


def banned_in(text: str) -> list[str]:
    return [f"'{match.group()}'; write: {list(BANNED.values())[match.lastindex - 1]}"
            for match in WORDS.finditer(text)]


def faults_of(path: pathlib.Path, root: pathlib.Path) -> list[str]:
    faults = []
    lines = path.read_text().splitlines()
    if path.suffix == ".md":
        for number, line in enumerate(lines, 1):
            faults += [(number, fault) for fault in banned_in(line) + inversions_in(line)]
    else:
        for number, text in comments_of(lines):
            faults += [(number, fault) for fault in faults_of_comment(text) + banned_in(text)]
        for number, line in enumerate(lines, 1):
            if not line.lstrip().startswith(("//", "#include")):
                faults += [(number, fault) for text in LITERAL.findall(line)
                           for fault in banned_in(text)]
    return [f"{path.relative_to(root)}:{number}: {fault}" for number, fault in faults]


def faults_in(root: pathlib.Path) -> tuple[int, list[str]]:
    """The number of files, and their faults."""
    files, faults = [], []
    for name in CLEAN:
        found = [path for path in ([root / name] if (root / name).is_file() else
                                   sorted((root / name).rglob("*")))
                 if path.suffix in (".h", ".cpp", ".md")]
        files += found
        faults += [] if found else [f"CLEAN names {name}, which holds no source or page"]
    return len(files), faults + [fault for path in files for fault in faults_of(path, root)]


def try_the_rules():
    """Each rule finds its fault, and accepts the sound text."""
    sound = ('#include "told.h"\n/// The mean of what is visible. Where two meet, both count.\n'
             'int n = 0;  ///< number of items; what is left is 0\n'
             'const char* url = "http://of.example";  // sound\n/// True if so.\n///\n/// Next.\n')
    cases = [("/// Of the beams the first.\n", "begins with 'Of'"),
             ("int n;  ///< of the items\n", "begins with 'of'"),
             ("// Whether it is so.\n", "begins with 'Whether'"),
             ("/// The first.\n/// second. Of those the last.\n", "begins with 'Of'"),
             ("/// Fine,\n/// but the way there and back.\n", "'there and back'"),
             ('fail("the user is told");\n', "'told'"),
             ("/// The heard surface.\n", "'heard'")]
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "x.h"
        file.write_text(sound)
        assert faults_of(file, file.parent) == [], faults_of(file, file.parent)
        for text, fault in cases:
            file.write_text(text)
            found = faults_of(file, file.parent)
            assert len(found) == 1 and fault in found[0], f"{text!r}: {found}"
        page = pathlib.Path(folder) / "x.md"
        page.write_text("Sound goes by\nby way of the floor.\nIt ends. Of these, two.\n# What is it\n")
        assert len(faults_of(page, page.parent)) == 2


def main(root: pathlib.Path) -> int:
    try_the_rules()
    files, faults = faults_in(root)
    print("\n".join(faults) if faults else f"{files} files are in plain words")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
