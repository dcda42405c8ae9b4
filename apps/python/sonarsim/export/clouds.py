"""Points of pings with what they show, as .npz and .ply: the surface that imaging sonars see, the soundings of others."""
import re

import numpy as np

from ..command import naming
from ..data import bin_of

PLY = {"f8": "double", "f4": "float", "u2": "uint", "u4": "uint"}     # meshio knows no ushort


def points_of(sample, depth, top_m):
    """The points of a ping, name -> array [n]: x, y, z in the world, intensity, class, instance, and depths below the height
    `top_m`: `depth` of the surface itself, `depth_m` of a sounding. Class and instance are those of its bin."""
    sensor, found = sample.sensor, {}
    if "soundings" in sensor.keys:
        rows = np.array(sample["soundings"])
        beams = np.flatnonzero(np.isfinite(rows[:, 0]))
        rows = rows[beams]
        at = np.maximum(bin_of(rows[:, 0], sensor.range_edges_m), 0), beams
        found = dict(zip("xyz", rows.T[1:4]), quality=rows[:, 4].astype("f4"), depth_m=top_m - rows[:, 3])
    else:
        points = sensor.points(sample)
        at = tuple(points.bins.T)
        found = dict(zip("xyz", points.position_m.T), **{depth: top_m - points.position_m[:, 2]})
    for name, source, kind in (("intensity", "polar", "f4"), ("class", "class", "u2"), ("instance", "instance", "u2")):
        if source in sensor.keys:
            found[name] = sample[source][at].astype(kind)
    return found


def write(folder, dataset, sensors, options):
    """NAME-000012.npz and .ply of each ping, or NAME.npz and .ply of all, which say the ping. Yields lines to print."""
    # Where a profile bends sound, places by straight sound are apparent ones.
    mission = (dataset.folder / "mission.resolved.yaml").read_text("utf-8")
    is_bent = re.search(r"^water:\n(?:  .*\n)*?  profile:", mission, re.MULTILINE)
    top = re.search(r"^  water_surface:\n(?:    .*\n)*?    height_m: (.*)", mission, re.MULTILINE)
    for sensor in sensors:
        clouds, count = [], 0
        for sample in sensor:
            cloud = points_of(sample, "depth_apparent_m" if is_bent else "depth_true_m", float(top[1]) if top else 0.0)
            count += len(cloud["x"])
            if options.whole:
                clouds.append(cloud | {"ping": np.full(len(cloud["x"]), sample.ping, "u4")})
            else:
                write_cloud(folder / f"{sensor.name}-{sample.ping:06}", cloud)
        if options.whole:
            write_cloud(folder / sensor.name, {name: np.concatenate([one[name] for one in clouds]) for name in clouds[0]})
        yield f"{sensor.name}: {count} points of {len(sensor)} pings"


def write_cloud(path, cloud):
    with naming(f"{path}.npz"):
        np.savez_compressed(f"{path}.npz", **cloud)
    kinds = [(name, "<" + values.dtype.str[1:].replace("u2", "u4")) for name, values in cloud.items()]
    lines = ["ply", "format binary_little_endian 1.0", f"element vertex {len(cloud['x'])}",
             *(f"property {PLY[kind[1:]]} {name}" for name, kind in kinds), "end_header\n"]
    rows = np.empty(len(cloud["x"]), kinds)
    for name, values in cloud.items():
        rows[name] = values
    with naming(f"{path}.ply"), open(f"{path}.ply", "wb") as file:
        file.write("\n".join(lines).encode() + rows.tobytes())
