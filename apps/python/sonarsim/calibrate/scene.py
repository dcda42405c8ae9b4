"""The echoes of a scene without noise, as the program renders them with the start, for the fit of fans."""
import json
import pathlib
import subprocess
import tempfile

import numpy as np
import yaml

from ..data import middles, open_datasets
from ..recording.description import read_yaml
from .preset import PROGRAM, with_key
from .statistics import CalibrationError

MOST_VARIANTS, ABOUT_PINGS = 10, 10
NO_NOISE_DB = -300
MATERIALS = "material,density_kg_m3,sound_speed_m_s,grain_phi\nsand,1900,1650,1.5\nrock,2700,5250,-9.99\n"


def usual_mission(range_m):
    """Sand with rocks, seen from a height of 0.15 to 0.4 of the range. The boresight meets it at three quarters."""
    range_m, heights = float(range_m), (0.15, 0.23, 0.32, 0.4)
    return {"name": "usual", "seed": 1,
            "scene": {"materials": "materials.csv", "seabed": {
                "cell_m": range_m / 200.0, "material": "sand",
                "rocks": {"density_per_m2": 10.0 / range_m**2, "diameter_m": [0.02 * range_m, 0.1 * range_m],
                          "material": "rock"}}},
            "trajectory": {"speed_m_s": 0.1 * range_m, "rate_hz": 1, "waypoints": [
                {"position_m": [0.4 * k * range_m, 0, share * range_m],
                 "rpy_deg": [0, float(np.degrees(np.arcsin(share / 0.75))), 0]} for k, share in enumerate(heights)]},
            "sensors": {"sonar": {}}}


def own_mission(path, name):
    """The mission of a file and the name of its sonar: `name`, else the first."""
    mission = read_yaml(path, 1 << 24)
    sensors = mission.get("sensors") if isinstance(mission, dict) else None
    if not isinstance(sensors, dict) or (name or next(iter(sensors))) not in sensors:
        raise CalibrationError(f"{path}: is not a mission with a sonar {name or ''}")
    return mission, name or next(iter(sensors))


class Echoes:
    """Amplitudes of echoes before the gain, [ping, range, beam], in the unit of source_level_db."""

    def __init__(self, start, mission, name, paths_from, settings=()):
        with tempfile.TemporaryDirectory(prefix="sonarsim-") as folder:
            folder = pathlib.Path(folder)
            text = start.text
            for key, value in {**start.shape, "instrument.receiver.noise_db": NO_NOISE_DB,
                               "instrument.receiver.full_scale_db": start.full_scale_db}.items():
                text = with_key(text, key, value, "", start.file)
            (folder / "preset.yaml").write_text(text, "utf-8")
            (folder / "materials.csv").write_text(MATERIALS, "utf-8")
            left_out = ("instrument", "kind", "every", *start.shape)
            own = {key: value for key, value in (mission["sensors"][name] or {}).items() if key not in left_out}
            rules = [rule for rule in mission.get("vary") or [] if not str(rule.get("key")).startswith("sensors.")
                     or str(rule["key"]).startswith(f"sensors.{name}.mount.")]
            mission = {**mission, "sensors": {name: {**own, "preset": str(folder / "preset.yaml")}}, "vary": rules,
                       "output": {"fan": False}, "variants": min(mission.get("variants") or 0, MOST_VARIANTS)}
            self._render(folder, mission, name, [f"--paths-from={paths_from or folder}", *(f"--set={one}" for one in settings)])
            self._read(folder / "out", name)
        receiver = start.instrument["receiver"]
        self.range_m = np.maximum(middles(self.sensor.range_edges_m), receiver["tvg_from_m"])[:, None]
        gain_db = receiver["tvg_log"] * np.log10(self.range_m) - start.full_scale_db
        gain_db += 2.0 * start.absorption_db_per_m * self.range_m * receiver["tvg_absorption"]
        self.amplitude = np.sqrt(self.amplitude) * 10.0 ** (-0.05 * gain_db)

    def _render(self, folder, mission, name, words):
        def program(command, *more):
            (folder / "mission.yaml").write_text(yaml.safe_dump(mission), "utf-8")
            run = subprocess.run([PROGRAM, command, str(folder / "mission.yaml"), *words, *more],
                                 capture_output=True, text=True, check=False)
            if run.returncode:
                raise CalibrationError(f"{mission.get('name')}: {(run.stderr.strip().splitlines() or ['it failed'])[-1]}")
            return run.stdout
        try:
            found = json.loads(program("validate", "--json"))
            pings = found["pings"] if "pings" in found else found["sensors"][name]["pings"]
            mission["sensors"][name]["every"] = max(pings // ABOUT_PINGS, 1)
            program("render", "-q", "--out", str(folder / "out"))
        except OSError as fault:
            raise CalibrationError(f"{PROGRAM}: {fault.strerror}; set SONARSIM to the path of the program") from fault

    def _read(self, folder, name):
        sensors = [one[name] for one in open_datasets(folder)]
        self.sensor = sensors[0]
        self.amplitude = np.array([sensor[k]["polar"] for sensor in sensors for k in range(len(sensor))])
