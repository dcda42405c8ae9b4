"""A dataset as the recording of a robot with ROS 2: pictures, images, boxes and poses in pings.mcap."""
import re

import numpy as np

from ..command import naming
from ..data import middles
from .mcap import Writer
from .source import mission_of

DTYPES = {"u1": 0, "u2": 2, "f4": 8}    # numbers of marine_acoustic_msgs/SonarImageData
WORLD, VEHICLE = "map", "base_link"
FAN = {"rotation": {"x": 0.5**0.5, "z": 0.5**0.5}}      # marine_acoustic_msgs: x up, y to starboard, z forward


def write(folder, dataset, sensors, _options):
    """pings.mcap. Frames: map, base_link, NAME (x forward, y left, z up) and NAME_fan, in which beams are named."""
    mission, path = mission_of(dataset.folder), folder / "pings.mcap"
    jobs = sorted(((sample.ping, k, sample) for k, sensor in enumerate(sensors) for sample in sensor), key=lambda job: job[:2])
    with naming(path), open(path, "wb") as file:
        writer, last = Writer(file), None
        for ping, _, sample in jobs:
            meta, name = sample["meta"], re.sub(r"\W", "_", sample.sensor.name, flags=re.ASCII)     # as ROS has them
            whole_s, rest_s = divmod(meta["time_s"], 1)
            time_ns = int(whole_s) * 10**9 + round(rest_s * 1e9)
            if not 0 <= time_ns < 2**31 * 10**9:
                raise ValueError(f"{dataset.folder}: has pings before 1970 or after 2038, which ROS does not know")
            stamp = dict(zip(("sec", "nanosec"), divmod(time_ns, 10**9)))
            transforms = [transform(stamp, WORLD, name, meta["T_world_sensor"]), {
                "header": {"stamp": stamp, "frame_id": name}, "child_frame_id": f"{name}_fan", "transform": FAN}]
            if ping != last:
                transforms.append(transform(stamp, WORLD, VEHICLE, meta["T_world_vehicle"]))
                reported = meta.get("T_world_vehicle_reported", meta["T_world_vehicle"])
                writer.write("/odometry", "nav_msgs/Odometry", time_ns, {
                    "header": {"stamp": stamp, "frame_id": WORLD}, "child_frame_id": VEHICLE, "pose": {"pose": {
                        "position": dict(zip("xyz", reported["position_m"])),
                        "orientation": dict(zip("xyzw", reported["quaternion_xyzw"]))}}})
            last = ping
            writer.write("/tf", "tf2_msgs/TFMessage", time_ns, {"transforms": transforms})
            write_ping(writer, name, sample, time_ns, stamp, mission)
        writer.finish()
    yield f"pings.mcap: {sum(writer.counts.values())} messages, {', '.join(writer.channels)}"


def transform(stamp, parent, child, pose):
    return {"header": {"stamp": stamp, "frame_id": parent}, "child_frame_id": child, "transform": {
        "translation": dict(zip("xyz", pose["position_m"])), "rotation": dict(zip("xyzw", pose["quaternion_xyzw"]))}}


def write_ping(writer, frame, sample, time_ns, stamp, mission):
    sensor, header = sample.sensor, {"stamp": stamp, "frame_id": frame}
    picture = next((name for name in ("fan", "image") if name in sensor.keys), None)
    if picture:
        writer.write(f"/{frame}/image/compressed", "sensor_msgs/CompressedImage", time_ns, {
            "header": header, "format": "png", "data": sensor.raw(sample.index, picture)})
    if picture and "objects" in sensor.keys:
        key, *axes = ("box_px", "x", "y") if picture == "fan" else ("box_bins", "beam", "range")
        boxes = [(one, one[picture] if picture == "fan" else one) for one in sample["objects"]["objects"]]
        writer.write(f"/{frame}/objects", "vision_msgs/Detection2DArray", time_ns, {
            "header": header, "detections": [detection(header, one, *map(box[key].get, axes)) for one, box in boxes if box]})
    name = next((name for name in ("raw", "polar") if name in sensor.keys), None)
    if name:
        image, bearing = sample[name], middles(sensor.azimuth_edges_rad)
        own, speed = mission["sensors"][sensor.name], mission["water"]["sound_speed_m_s"]
        writer.write(f"/{frame}/sonar_image", "marine_acoustic_msgs/ProjectedSonarImage", time_ns, {
            "header": header | {"frame_id": f"{frame}_fan"},
            "ping_info": {"frequency": (own.get("instrument") or {}).get("frequency_hz", 0),
                          "sound_speed": 0 if isinstance(speed, dict) else speed},     # a section if it depends on depth
            "beam_directions": [{"y": y, "z": z} for y, z in zip((-np.sin(bearing)).tolist(), np.cos(bearing).tolist())],
            "ranges": middles(sensor.range_edges_m).tolist(),
            "image": {"dtype": DTYPES[image.dtype.str[1:]], "beam_count": image.shape[1], "data": image.astype(
                image.dtype.newbyteorder("<")).tobytes()}})


def detection(header, one, across, along):
    return {"header": header, "id": one["name"], "results": [{"hypothesis": {"class_id": one["class"], "score": 1.0}}],
            "bbox": {"center": {"position": {"x": 0.5 * sum(across), "y": 0.5 * sum(along)}},
                     "size_x": across[1] - across[0], "size_y": along[1] - along[0]}}
