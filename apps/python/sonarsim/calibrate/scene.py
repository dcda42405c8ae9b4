"""Scenes as the program renders them with a preset: their echoes without noise, and passes to judge a fit by."""
import json
import pathlib
import tempfile

import numpy as np
import yaml

from ..compare.behind import first_returns, strongest_echoes
from ..compare.images import images_of, zones_of
from ..data import middles, open_datasets
from ..recording.dataset import recording_of
from ..recording.description import read_yaml
from .preset import run_program, with_key
from .statistics import CalibrationError

MAX_VARIANTS, ABOUT_PINGS = 10, {"imaging": 10, "sidescan": 64, "scanning": 64, "echosounder": 64}
NO_NOISE_DB = -300
# Bottoms differ by 20 dB; the first is the one that a value comes from, the others widen its interval.
BOTTOMS = ("sand", "silt", "gravel")
MATERIALS = ("material,density_kg_m3,sound_speed_m_s,grain_phi\nsand,1900,1650,1.5\nrock,2700,5250,-9.99\n"
             "silt,1500,1490,6\ngravel,2200,1900,-2\n")


def usual_mission(kind, range_m, view=None, bottom="sand"):
    """A level bottom seen from `view`, the height in metres and the pitch in rad; without one it has rocks, and sonars are
    0.15 to 0.4 of the range above it with the boresight at three quarters."""
    range_m = float(range_m)
    views = [(view[0] / range_m, view[1])] * 2 if view else [(share, np.arcsin(share / 0.75))
                                                             for share in (0.15, 0.23, 0.32, 0.4)]
    rocks = {"rocks": {"density_per_m2": 10.0 / range_m**2, "diameter_m": [0.02 * range_m, 0.1 * range_m], "material": "rock"}}
    return {"name": "usual", "seed": 1, "scene": {"materials": "materials.csv", "seabed": {
                "cell_m": range_m / 200.0, "material": bottom, **({} if view else rocks)}},
            "trajectory": {"speed_m_s": 0.1 * range_m, "rate_hz": 1 if kind == "imaging" else 8, "waypoints": [
                {"position_m": [0.4 * k * range_m, 0, float(share * range_m)], "rpy_deg": [0, float(np.degrees(pitch)), 0]}
                for k, (share, pitch) in enumerate(views)]}, "sensors": {"sonar": {}}}


def view_of(recording, start):
    """(height in metres, pitch in rad) of a recording over a level bottom, None if no bottom stands out. The first return of
    a side-scan and the peak of an echosounder are below it. The beam of others, as high as the start's, meets the bottom
    from r1 to r2: sin(pitch + half) / sin(pitch - half) = r2 / r1."""
    images = images_of(recording, False)
    if recording.kind in ("sidescan", "echosounder"):
        edges = first_returns(images) if recording.kind == "sidescan" else strongest_echoes(images)
        return (float(images.ranges_m[int(np.median(edges[edges > 0]))]), 0.0) if (edges > 0).any() else None
    zones = zones_of(images.mean_powers())
    near, far = (images.first_range_m + images.range_step_m * k for k in zones.bottom)
    half = 0.5 * np.radians(start.instrument["beam"].get("elevation_width_deg", 20.0))
    pitch = np.arctan(np.tan(half) * (far + near) / (far - near))
    return None if zones.is_one or near <= 0.0 else (float(near * np.sin(min(pitch + half, 0.5 * np.pi))), float(pitch))


def own_mission(path, name):
    """The mission of a file and the name of its sonar: `name`, else the first."""
    mission = read_yaml(path, 1 << 24)
    sensors = mission.get("sensors") if isinstance(mission, dict) else None
    if not isinstance(sensors, dict) or (name or next(iter(sensors))) not in sensors:
        raise CalibrationError(f"{path}: is not a mission with a sonar {name or ''}")
    return mission, name or next(iter(sensors))


def rendered(start, text, mission, name, paths_from, settings, read):
    """What `read` makes of the folder into which the program renders a mission with the text of a preset."""
    with tempfile.TemporaryDirectory(prefix="sonarsim-") as folder:
        folder = pathlib.Path(folder)
        (folder / "preset.yaml").write_text(text, "utf-8")
        (folder / "materials.csv").write_text(MATERIALS, "utf-8")
        left_out = ("instrument", "kind", "every", *start.shape)
        own = {key: value for key, value in (mission["sensors"][name] or {}).items() if key not in left_out}
        rules = [rule for rule in mission.get("vary") or [] if not str(rule.get("key")).startswith("sensors.")
                 or str(rule["key"]).startswith(f"sensors.{name}.mount.")]
        mission = {**mission, "sensors": {name: {**own, "preset": str(folder / "preset.yaml")}}, "vary": rules,
                   "output": {"fan": False, "polar": True, "folder": str(folder / "out")},
                   "variants": min(mission.get("variants") or 0, MAX_VARIANTS)}
        words = [f"--paths-from={paths_from or folder}", *(f"--set={one}" for one in settings)]

        def program(command, *more):
            (folder / "mission.yaml").write_text(yaml.safe_dump(mission), "utf-8")
            return run_program(command, folder / "mission.yaml", *words, *more)
        found = json.loads(program("validate", "--json"))
        pings = found["pings"] if "pings" in found else found["sensors"][name]["pings"]
        mission["sensors"][name]["every"] = max(pings // ABOUT_PINGS[start.kind], 1)
        program("render", "-q")
        return read(folder / "out")


def with_shape(start, text, more=()):
    """The text of a preset with the shape of the pings."""
    for key, value in {**start.shape, **dict(more)}.items():
        text = with_key(text, key, value, "", start.file)
    return text


class Echoes:
    """Amplitudes of echoes before the gain, in the unit of source_level_db: [ping, range, beam] or [image, range, ping]."""

    def __init__(self, start, mission, name, paths_from, settings=()):
        text = with_shape(start, start.text, {"instrument.receiver.noise_db": NO_NOISE_DB,
                                              "instrument.receiver.converter_noise_db": NO_NOISE_DB,
                                              "instrument.receiver.full_scale_db": start.full_scale_db})
        powers = rendered(start, text, mission, name, paths_from, settings, lambda out: self._powers(out, name))
        receiver = start.instrument["receiver"]
        self.range_m = np.maximum(middles(self.sensor.range_edges_m), receiver["tvg_from_m"])[:, None]
        gain_db = receiver["tvg_log"] * np.log10(self.range_m) - start.full_scale_db
        gain_db += 2.0 * start.absorption_db_per_m * self.range_m * receiver["tvg_absorption"]
        self.amplitude = np.sqrt(powers) * 10.0 ** (-0.05 * gain_db)

    def _powers(self, folder, name):
        datasets = open_datasets(folder)
        self.sensor = datasets[0][name]
        recordings = [recording_of(one.folder, one[name], len(one[name]), "linear") for one in datasets]
        return np.concatenate([one.values if one.kind == "imaging" else images_of(one, False).powers for one in recordings])


def pass_of(start, text, mission, name, paths_from, settings=()):
    """The Recording of a pass over a scene with the text of a preset."""
    def read(folder):
        dataset = open_datasets(folder)[0]
        return recording_of(dataset.folder, dataset[name], len(dataset[name]))
    return rendered(start, text, mission, name, paths_from, settings, read)
