"""The folder that NeuSIS, AONeuS, neusis_ngp and SonarSplat read: states of HoloOcean as pickles, and Config.json.

Columns of an image lie from starboard to port, theta = -Azimuth / 2 + column Azimuth / AzimuthBins, and a point is
(r cos theta cos phi, r sin theta cos phi, r sin phi) in the frame of PoseSensor: x forward, y left, z up, as here."""
import hashlib
import json
import pathlib
import pickle
import struct

import numpy as np
from PIL import Image, TiffImagePlugin

from ..command import naming
from ..data import DataError, moved, own_file
from .formats import place, write_json
from .source import full_value_of, mission_of

UNITS = {"m": 1.0, "mm": 1e-3, "cm": 0.01, "km": 1e3, "in": 0.0254, "ft": 0.3048}


def write(folder, dataset, sensors, options):
    """Data/000012.pkl for each ping, Config.json and heights of a made bed; a folder for each sonar if there are several."""
    mission, sensors = mission_of(dataset.folder), [one for one in sensors if one.kind == "imaging"]
    if not sensors:
        raise DataError(f"{dataset.folder}: has no imaging sonar, and this layout holds no other")
    for sensor in sensors:
        own = folder / sensor.name if len(sensors) > 1 else folder
        name = "clean" if options.clean else "raw" if "raw" in sensor.keys else "polar"
        if name not in sensor.keys:
            raise DataError(f"{dataset.folder}: sensor {sensor.name!r} has no {name}; set output."
                            f"{'labels: [clean]' if options.clean else name + ': true'} and render it again")
        full = full_value_of(sensor) if name == "raw" else 1.0
        for sample in sensor:
            image = sample[name]
            state = {"ImagingSonar": (image / full).astype(np.float32), "PoseSensor": matrix_of(sample["meta"]["T_world_sensor"])}
            # numpy 1 has no module _core.
            place(own / "Data", f"{sample.ping:06}.pkl", pickle.dumps(state, 3).replace(b"cnumpy._core.", b"cnumpy.core.", 1))
        write_json(own / "Config.json", config_of(sensor, mission))
        if (dataset.folder / "seabed/heights.tif").is_file():
            place(own, "heights.tif", own_file(dataset.folder, "seabed/heights.tif"))
        if options.mesh:
            write_surface(own, pathlib.Path(options.mesh), dataset, mission["scene"])
        yield f"{sensor.name}: {len(sensor)} states, {name} of {image.shape[0]} ranges x {image.shape[1]} azimuths"


def matrix_of(pose):
    """A pose as a matrix, float64 [4, 4]."""
    axes = moved(np.eye(3), pose) - pose["position_m"]
    return np.vstack([np.column_stack([axes.T, pose["position_m"]]), [0, 0, 0, 1]])


def config_of(sensor, mission):
    """Config.json with the keys of both layouts in use: within `agents`, and at its head."""
    own = mission["sensors"][sensor.name]
    width = own["instrument"]["beam"]["elevation_width_deg"] if "instrument" in sensor.description else 0
    (low, *_, high), azimuths = sensor.range_edges_m.tolist(), sensor.azimuth_edges_rad
    sonar = {"Azimuth": round(float(np.degrees(np.ptp(azimuths))), 9), "Elevation": width or own["elevation_deg"], "RangeMin": low, "RangeMax": high,
             "RangeBins": len(sensor.range_edges_m) - 1, "AzimuthBins": len(azimuths) - 1}
    kinds = [{"sensor_type": "PoseSensor"}, {"sensor_type": "ImagingSonar", "sensor_name": sensor.name, "configuration": sonar}]
    return {"name": mission["name"], "main_agent": "vehicle", "agents": [{"agent_name": "vehicle", "sensors": kinds}],
            "ds_factor": 1.0, "simple_denoise": False, **sonar}     # two keys of AONeuS


def write_surface(folder, source, dataset, scene):
    """A file of the scene in the frame of the world: scene.file as mesh.glb, or scene.heightmap as heights.tif."""
    data, named = source.read_bytes(), (scene.get("file"), (scene.get("heightmap") or {}).get("file"))
    if hashlib.sha256(data).hexdigest() not in [one["sha256"] for one in dataset.description["inputs"] if one["file"] in named]:
        raise ValueError(f"{source}: is not the file of the scene or its heightmap: --mesh takes these")
    if data[:4] in (b"II*\0", b"MM\0*") and scene.get("heightmap"):
        write_heights(folder / "heights.tif", source, scene["heightmap"])
    else:
        write_mesh(folder / "mesh.glb", source, data, scene)


def write_heights(path, source, rule):
    """A GeoTIFF of heights in metres of the world. ValueError for one whose place is not in its tags."""
    with Image.open(source) as image:
        tags, z = dict(image.tag_v2), np.array(image, np.float64)
    pixel, no_data = rule["pixel_m"], tags.get(42113)
    if pixel == "auto" and not {33550, 33922} <= tags.keys():
        raise ValueError(f"{source}: has no tags of its place, and --mesh takes no world file")
    scale = (pixel, pixel, 0.0) if pixel != "auto" else tags[33550]
    row, column, west, north = (tags[33922][k] for k in (1, 0, 3, 4)) if pixel == "auto" else (0, 0, 0.0, len(z) * pixel)
    keys = {key: value for key, place, _, value in zip(*[iter(tags.get(34735, ()))] * 4) if place == 0}
    if keys.get(3076, 9001) != 9001:
        raise ValueError(f"{source}: is not in metres, and --mesh takes no other unit")
    if pixel == "auto" and keys.get(1025) == 2:
        west, north = west - scale[0] / 2, north + scale[1] / 2     # the tie point is the centre of a pixel
    if no_data is not None:
        z[z == float(no_data.strip("\0 "))] = np.nan
    info = TiffImagePlugin.ImageFileDirectory_v2()
    for tag, values in ((33550, scale), (33922, (column, row, 0.0, west - rule["origin_m"][0], north - rule["origin_m"][1], 0.0))):
        info[tag], info.tagtype[tag] = tuple(map(float, values)), 12
    info[42113] = "nan"
    z = z * rule["height_scale"] + rule["height_offset_m"]
    with naming(path):
        Image.fromarray(z.astype(np.float32)).save(path, "TIFF", tiffinfo=info)


def write_mesh(path, source, data, scene):
    """A .glb of the scene with its coordinates turned into those of the world: z up, in metres."""
    if data[:4] != b"glTF":
        raise ValueError(f"{source}: is not a .glb file, and --mesh takes no other")
    size = struct.unpack_from("<I", data, 12)[0]
    content, rest = json.loads(data[20:20 + size]), data[20 + size:]
    unit, shown = UNITS[scene["units"]], content["scenes"][content.get("scene", 0)]
    up = (0, 0, 1, 0, 0, -1, 0, 0) if scene["up"] == "y" else (0, 1, 0, 0, 0, 0, 1, 0)
    content["nodes"].append({"name": "world", "children": shown["nodes"],
                             "matrix": [unit * one for one in (1, 0, 0, 0, *up)] + [0, 0, 0, 1]})
    shown["nodes"] = [len(content["nodes"]) - 1]
    text = json.dumps(content).encode()
    text += b" " * (-len(text) % 4)
    with naming(path):
        path.write_bytes(struct.pack("<4sIII4s", b"glTF", 2, 20 + len(text) + len(rest), len(text), b"JSON") + text + rest)
