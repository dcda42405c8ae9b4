"""The files that a mission names, read from its text: YAML is not in Python's library."""
import os
import pathlib
import re

# Quoted text, a comment, or plain text between the signs of lists and maps.
PIECE = re.compile(r""""(?P<double>[^"\n]*)"|'(?P<single>[^'\n]*)'|(?:^|(?<=\s))#[^\n]*|"""
                   r"""(?P<plain>(?:[^\s,\[\]{}"'#]|(?<=\S)#|[ \t](?!#))+)""", re.MULTILINE)


def values_in(text: str) -> list[str]:
    """Every text of a YAML document that may be a value."""
    values = []
    for piece in PIECE.finditer(text):
        if piece["plain"] is None:
            values.append(piece["double"] or piece["single"] or "")
        else:  # "- file: a.glb": the value comes last
            values.append(re.split(r":\s+|^\s*-\s+", piece["plain"])[-1].strip())
    return values


def text_of(mission: pathlib.Path, options: list[str]) -> str:
    """A mission and the options of sonarsim as lines. OSError where the mission cannot be read."""
    return "\n".join([mission.read_text(encoding="utf-8", errors="replace"), *options])


def stock_named(mission: pathlib.Path, options: list[str], kinds, clutter: tuple) -> list[str]:
    """The kinds of the stock that stand in lists or on lines after the word `stock`, and those of clutter where
    the mission has some."""
    text = re.sub(r"#.*", "", text_of(mission, options))
    words = re.findall(r"\w+", " ".join(re.findall(r"\bstock\b(?:[^\n\[]*\[[^\]]*\])?[^\n]*", text)))
    if re.search(r"\bclutter[\"']?\s*[:.=]", text):
        words += clutter
    return sorted(set(words) & set(kinds))


def files_named(mission: pathlib.Path, options: list[str]) -> list[pathlib.Path]:
    """Absolute paths of the .glb, .obj, .tif and .png files in a mission and in options of sonarsim, as in
    `--set scene.file=a.glb`, in their order. Relative paths start at the folder of the mission, or
    at `--paths-from`. OSError where the mission cannot be read."""
    options = [part for option in options for part in (option.split("=", 1) if option.startswith("--") else [option])]
    base = mission.resolve().parent
    if "--paths-from" in options[:-1]:
        base = pathlib.Path(options[options.index("--paths-from") + 1]).resolve()
    text = text_of(mission, [option.split("=", 1)[-1] for option in options])
    names = dict.fromkeys(value for value in values_in(text) if value.endswith((".glb", ".obj", ".tif", ".png")))
    return [pathlib.Path(os.path.normpath(base / name)) for name in names]
