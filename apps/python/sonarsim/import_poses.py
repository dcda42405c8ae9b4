"""`sonarsim import-poses`: the poses of a topic of a recording of ROS 2 (MCAP) as a TUM file, for trajectory.file."""
import argparse
import pathlib
import struct
import sys

from .command import replaced, run
from .export.mcap import CHANNEL, CHUNK, MAGIC, MESSAGE, SCHEMA

# The texts of a message between its time and its pose.
TEXTS = {"nav_msgs/msg/Odometry": 2, "geometry_msgs/msg/PoseStamped": 1, "geometry_msgs/msg/PoseWithCovarianceStamped": 1}


def records(data):
    """Yields (kind, content) of records, also of those in chunks."""
    while data:
        kind, size = struct.unpack_from("<BQ", data)
        content, data = struct.unpack_from(f"{size}s", data, 9)[0], data[9 + size:]
        if kind == CHUNK and content[28:32] != bytes(4):
            raise ValueError("has compressed chunks; `mcap decompress` writes a file without them")
        yield from records(memoryview(content)[40:]) if kind == CHUNK else [(kind, content)]


def text_at(data, at):
    """A text with its length before it, and the offset behind it."""
    end = at + 4 + struct.unpack_from("<I", data, at)[0]
    return str(data[at + 4:end], "utf-8"), end


def pose_of(message, texts):
    """t x y z qx qy qz qw of a message, without the head of CDR."""
    at = 8
    for _ in range(texts):
        _, at = text_at(message, at + -at % 4)
    second, nanosecond = struct.unpack_from("<iI", message)
    return " ".join([f"{second}.{nanosecond:09}", *map(repr, struct.unpack_from("<7d", message, at + -at % 8))])


def poses_of(data, topic):
    """The poses of a topic, and the topics with poses."""
    kinds, topics, poses = {}, {}, []
    for kind, content in records(data):
        number = bytes(content[:2])
        if kind == SCHEMA:
            kinds[number] = text_at(content, 2)[0]
        elif kind == CHANNEL:
            topics[number] = text_at(content, 4)[0], TEXTS.get(kinds[bytes(content[2:4])])
        elif kind == MESSAGE and topics[number][0] == topic and topics[number][1]:
            poses.append(pose_of(content[26:], topics[number][1]))
    return poses, sorted({name for name, texts in topics.values() if texts})


def convert(options):
    data = memoryview(pathlib.Path(options.recording).read_bytes())
    try:
        if not data[:8] == data[-8:] == MAGIC:
            raise ValueError("is not a whole MCAP file")
        poses, topics = poses_of(data[8:-8], options.topic)
        if not poses:
            raise ValueError(f"has no poses of {options.topic}; there are {', '.join(topics) or 'none'}")
    except (ValueError, struct.error, KeyError) as fault:
        raise ValueError(f"{options.recording}: {fault if type(fault) is ValueError else 'is cut off or damaged'}") from fault
    with replaced(options.out) as part:
        part.write_text("\n".join([*poses, ""]), "utf-8")
    print(f"{options.out}: {len(poses)} poses")


def main():
    parser = argparse.ArgumentParser("sonarsim import-poses", description=__doc__.split(": ")[1])
    parser.add_argument("recording", help="a .mcap file")
    parser.add_argument("--topic", required=True, help="one of nav_msgs/Odometry or geometry_msgs/Pose(WithCovariance)Stamped")
    parser.add_argument("--out", required=True, metavar="FILE.tum", help="the trajectory to write")
    return run("import-poses", convert, parser.parse_args())


if __name__ == "__main__":
    sys.exit(main())
