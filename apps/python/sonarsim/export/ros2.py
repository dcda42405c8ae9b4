"""Messages of ROS 2 as XCDR1 bytes, by their definitions (ros2msg)."""
import pathlib
import re
import struct

PLAIN = {"bool": "?", "byte": "B", "char": "B", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i",
         "uint32": "I", "int64": "q", "uint64": "Q", "float32": "f", "float64": "d"}
FIELD = re.compile(r"([\w/]+)(\[(\d*)\])? (\w+)", re.ASCII)      # constants have a sign of equality behind
RULE = "\n" + "=" * 80 + "\nMSG: "
OWN = pathlib.Path(__file__).with_name("messages.txt")


def definitions():
    """The text of each definition in messages.txt."""
    return dict(block.split("\n", 1) for block in OWN.read_text().rstrip().removeprefix("MSG: ").split(RULE))


def fields_of(blocks):
    """{type: [(field, type, count)]} of definitions; count None for one value, -1 for a list."""
    return {name: [(field, kind, int(count or -1) if array else None)
                   for kind, array, count, field in (m.groups() for m in map(FIELD.fullmatch, text.splitlines()) if m)]
            for name, text in blocks.items()}


def schema_of(name, blocks):
    """The definition of a message with those that it needs."""
    needed = [name]
    for one in needed:
        needed += [kind for kind in dict.fromkeys(re.findall(r"^(\w+/\w+)", blocks[one], re.M)) if kind not in needed]
    return RULE.join([blocks[name].rstrip()] + [f"{one}\n{blocks[one].rstrip()}" for one in needed[1:]])


def put(out, types, kind, value):
    """Adds a value to the bytes of a message. Fields that it lacks are 0 or empty."""
    if kind == "string":
        text = (value or "").encode() + b"\0"
        put(out, types, "uint32", len(text))
        out += text
    elif kind in PLAIN:
        out += bytes(-len(out) % struct.calcsize(PLAIN[kind])) + struct.pack("<" + PLAIN[kind], value or 0)
    else:
        for field, own, count in types[kind]:
            inner = (value or {}).get(field)
            if count is None:
                put(out, types, own, inner)
                continue
            inner = (() if count < 0 else (0,) * count) if inner is None else inner
            if count < 0:
                put(out, types, "uint32", len(inner))
            if isinstance(inner, bytes):
                out += inner
            else:
                for one in inner:
                    put(out, types, own, one)
