"""Fails for comments that begin as fragments, and for words that a reader of this field does not expect.

    python3 tests/words.py <root of the repository>

A comment begins with a noun phrase or a sentence ("True if ...", "The number of ..."), not with a preposition or a
question word ("Of the ...", "Whether ..."). BANNED names the words and what to write instead; they are searched in
comments and string literals of C++ and in pages. The rules are first tried on made-up faults.
"""
import pathlib
import re
import sys

# Folders and pages that follow the rules.
CLEAN = ["CHANGELOG.md", "CONTRIBUTING.md", "README.md", "apps", "docs", "lib", "tests"]
# Begins of a comment that lack a subject.
FRAGMENT = re.compile(r"(of|by|that of|those|what|whether|how|where|whose|which|in which)\b", re.IGNORECASE)
# The same within a comment, after a full stop, and in pages at the begin of a line.
INVERSION = re.compile(r"(?:(?<=\. )|^)(Of|That of|Those of|By how|In which|Whether|What is)\b")
BANNED = {
    r"there and back": "two-way", r"by way of": "over, through or by",
    r"told\b": "reported, named or warned", r"heard?\b": "insonified, received or visible",
    r"lit\b": "occupied or insonified", r"by so much": "the quantity",
    r"sees? anew": "again", r"makes? (?:it|them) anew": "again", r"goes on from there": "continues",
    r"is no (?:\.npy|archive|dataset|file|PNG|shard)\b": "is not a, or cannot be", r"doubt(?:s|ful|ed)?\b": "warning", }
WORDS = re.compile(r"\b(?:" + "|".join(f"({word})" for word in BANNED) + ")", re.IGNORECASE)
LITERAL = re.compile(r'"(?:\\.|[^"\\])*"')


def comments_of(lines: list[str]) -> list[tuple[int, str]]:
    """The comments of a C++ file with the number of their first line; consecutive comment lines are one, a comment
    behind code begins another."""
    comments, open_block = [], False
    for number, line in enumerate(lines, 1):
        alone = line.lstrip().startswith("//")
        match = re.search(r"//(?:/<?)?(.*)$", line if alone else LITERAL.sub('""', line))
        text = match.group(1).strip() if match else ""
        if text and alone and open_block:
            comments[-1] = (comments[-1][0], comments[-1][1] + " " + text)
        elif text:
            comments.append((number, text))
        open_block = alone and text != ""
    return comments


def faults_of(path: str, text: str) -> list[str]:
    """What is wrong with the text of a file."""
    def banned_in(text):
        return [f"'{match.group()}'; write: {list(BANNED.values())[match.lastindex - 1]}" for match in WORDS.finditer(text)]

    def inversions_in(text):
        return [f"a sentence begins with '{found}'" for found in INVERSION.findall(text)]

    faults, lines = [], text.splitlines()
    if path.endswith(".md"):
        faults += [(number, fault) for number, line in enumerate(lines, 1) for fault in banned_in(line) + inversions_in(line)]
    else:
        for number, text in comments_of(lines):
            fragment = FRAGMENT.match(text)
            begins = [f"a comment begins with '{fragment.group()}'"] if fragment else inversions_in(text)
            faults += [(number, fault) for fault in begins + banned_in(text)]
        faults += [(number, fault) for number, line in enumerate(lines, 1)
                   if not line.lstrip().startswith(("//", "#include"))
                   for text in LITERAL.findall(line) for fault in banned_in(text)]
    return [f"{path}:{number}: {fault}" for number, fault in faults]


def try_the_rules():
    """Each rule finds its fault, and accepts the sound text."""
    cases = [("x.h", '#include "told.h"\n/// The mean of what is visible. Where two meet, both count.\n'
              'int n = 0;  ///< number of items; what is left is 0\nconst char* url = "http://of.example";  // sound\n', None),
             ("x.h", "/// Of the beams the first.\n", "begins with 'Of'"),
             ("x.h", "int n;  ///< of the items\n", "begins with 'of'"),
             ("x.h", "/// The first.\n/// second. Of those the last.\n", "begins with 'Of'"),
             ("x.h", "/// Fine,\n/// but the way there and back.\n", "'there and back'"),
             ("x.h", 'fail("the user is told");\n', "'told'"),
             ("x.md", "Sound goes by\nby way of the floor.\n", "'by way of'"), ("x.md", "It ends. Of these, two.\n", "'Of'")]
    for name, text, fault in cases:
        found = faults_of(name, text)
        assert len(found) == (fault is not None) and (fault or "") in "".join(found), f"{text!r}: {found}"


def main(root: pathlib.Path) -> int:
    try_the_rules()
    files = [path for name in CLEAN for path in ([root / name] if (root / name).is_file() else sorted((root / name).rglob("*")))
             if path.suffix in (".h", ".cpp", ".md")]
    faults = [fault for path in files for fault in faults_of(str(path.relative_to(root)), path.read_text())]
    faults += [f"CLEAN names {name}, which is not there" for name in CLEAN if not (root / name).exists()]
    print("\n".join(faults) if faults else f"{len(files)} files are in plain words")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
