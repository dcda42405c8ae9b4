"""Files of MCAP (https://mcap.dev/spec) in indexed chunks, not compressed. Messages of ROS 2 are XCDR1 bytes (ros2msg)."""
import collections
import pathlib
import re
import struct

MAGIC = b"\x89MCAP0\r\n"
HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, MESSAGE_INDEX, CHUNK_INDEX, STATISTICS, DATA_END = (
    1, 2, 3, 4, 5, 6, 7, 8, 11, 15)
CHUNK_BYTES = 1 << 22
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


def record(kind, form, *values):
    """A record: H, I and Q are numbers, s is text, b bytes, q bytes with a longer length, r bytes as they are."""
    body = b""
    for code, value in zip(form, values, strict=True):
        value = value.encode() if code == "s" else value
        length = {"s": "<I", "b": "<I", "q": "<Q"}.get(code)
        body += struct.pack("<" + code, value) if code in "HIQ" else (struct.pack(length, len(value)) if length else b"") + value
    return struct.pack("<BQ", kind, len(body)) + body


def pairs(form, items):
    return b"".join(struct.pack(form, *one) for one in items)


class Writer:
    """Messages of ROS 2 in the order of their times."""

    def __init__(self, file):
        self.file, self.schemas, self.channels, self.described, self.indexes = file, {}, {}, [], []
        self.counts, self.chunk, self.times, self.ends = collections.Counter(), bytearray(), {}, []
        self.definitions = definitions()
        self.fields = fields_of(self.definitions)
        file.write(MAGIC + record(HEADER, "ss", "ros2", "sonarsim"))

    def write(self, topic, name, time_ns, message):
        """Writes a message of the type `name`, such as tf2_msgs/TFMessage."""
        if name not in self.schemas:
            self.schemas[name] = len(self.schemas) + 1
            self.described.append(record(SCHEMA, "Hssb", self.schemas[name], name.replace("/", "/msg/"), "ros2msg",
                                         schema_of(name, self.definitions).encode()))
            self.chunk += self.described[-1]
        if topic not in self.channels:
            self.channels[topic] = len(self.channels) + 1
            self.described.append(record(CHANNEL, "HHssb", self.channels[topic], self.schemas[name], topic, "cdr", b""))
            self.chunk += self.described[-1]
        channel = self.channels[topic]
        self.times.setdefault(channel, []).append((time_ns, len(self.chunk)))
        data = bytearray()
        put(data, self.fields, name, message)
        self.chunk += record(MESSAGE, "HIQQr", channel, self.counts[channel], time_ns, time_ns, b"\0\1\0\0" + data)
        self.counts[channel] += 1
        if len(self.chunk) > CHUNK_BYTES:
            self.end_chunk()

    def end_chunk(self):
        if not self.times:
            return
        times = [time for own in self.times.values() for time, _ in own]
        ends, size, begin, offsets = (min(times), max(times)), len(self.chunk), self.file.tell(), []
        self.file.write(record(CHUNK, "QQQIsq", *ends, size, 0, "", bytes(self.chunk)))
        index_at = self.file.tell()
        for channel, own in self.times.items():
            offsets.append((channel, self.file.tell()))
            self.file.write(record(MESSAGE_INDEX, "Hb", channel, pairs("<QQ", own)))
        self.indexes.append(record(CHUNK_INDEX, "QQQQbQsQQ", *ends, begin, index_at - begin, pairs("<HQ", offsets),
                                   self.file.tell() - index_at, "", size, size))
        self.ends += ends
        self.chunk, self.times = bytearray(), {}

    def finish(self):
        self.end_chunk()
        self.file.write(record(DATA_END, "I", 0))
        begin = self.file.tell()
        self.file.write(b"".join(self.described) + record(
            STATISTICS, "QHIIIIQQb", sum(self.counts.values()), len(self.schemas), len(self.channels), 0, 0, len(self.indexes),
            self.ends[0], self.ends[-1], pairs("<HQ", self.counts.items())) + b"".join(self.indexes))
        self.file.write(record(FOOTER, "QQI", begin, 0, 0) + MAGIC)
