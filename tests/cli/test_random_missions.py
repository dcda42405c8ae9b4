"""Random missions: every key drawn from the range that `sonarsim keys --json` states for it, extremes
included, over small scenes from a hundredth of a millimetre to the size of the Earth; half of the
sonars are calibrated instruments. Whatever they ask for: no crash, no hang, no pixel that is not
finite, the same bytes on one thread and on two, and a refusal has a place for each fault.

RANDOM_MISSIONS is their number and RANDOM_SEED names the set; mission I alone, with its files kept:
RANDOM_ONLY=I. A mission has at most six pings of some ten thousand bins and is to end within
MOST_CPU_S of processor time, LONGEST_S on a machine that is busy with other things, and MOST_MEMORY.
One that does not is no fault where `validate` has said so: by its hours, or by W26."""
import array
import json
import math
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from sandbox import SONARSIM, box_gltf

SANITIZED = os.environ["SANITIZED"] == "1"
MISSIONS = int(os.environ.get("RANDOM_MISSIONS", "15" if SANITIZED else "60"))
SEED = os.environ.get("RANDOM_SEED", "1")
ONLY = os.environ.get("RANDOM_ONLY")
MOST_CPU_S = 300 if SANITIZED else 60
LONGEST_S = 10 * MOST_CPU_S
# What takes longer is not rendered again on one thread.
MOST_TWICE_S = 600 if MISSIONS > 100 else 1
MOST_MEMORY = 6 << 30

PLACE = re.compile(r"error: (mission\.json|materials\.csv|scene\.gltf|path\.(csv|tum)"
                   r"|/[^ ]*\.(json|csv|gltf|tum)|sensor '\w+'|[a-z_]+(\.[a-z_]+)*)\b")


def extreme(draw, low, high, default):
    """A number from low to high, often one of the ends or one at the edge of what floats hold."""
    kind = draw.random()
    if kind < 0.2:
        return low
    if kind < 0.4:
        return high
    if kind < 0.5 and low <= 0 <= high:
        return draw.choice([0.0, 5e-324, 1e-300, 1e-30])
    sign = -1 if low < 0 and draw.random() < 0.5 else 1
    largest = max(abs(low), abs(high))
    smallest = low if low > 0 else min(1e-9, largest)
    value = sign * math.exp(draw.uniform(math.log(smallest), math.log(largest)))
    return min(max(value, low), high)


def moderate(draw, low, high, default):
    """A number within a factor of ten of the default."""
    value = (default or draw.uniform(0, 1)) * 10 ** draw.uniform(-1, 1)
    return min(max(value, low), high)


def number(draw, key, wild):
    low, high, default = key["low"], key["high"], key["default"]
    if "choices" in key and draw.random() < 0.5:
        return draw.choice(key["choices"])
    if not isinstance(default, (int, float)):
        default = 0
    value = (extreme if draw.random() < wild else moderate)(draw, low, high, default)
    if not key["low_allowed"] and value <= low:
        value = math.nextafter(low, high)
    return min(max(int(value), int(low)), int(high)) if key["type"] == "whole number" else value


def section(draw, keys, path, wild, share, kind=None):
    """A section in which about `share` of the optional keys are given; of a sonar, those that a
    sonar of this kind has."""
    out = {}
    for key in keys[path]:
        by_kind = key.get("default_by_kind")
        if key["required"] or by_kind and kind not in by_kind or draw.random() > share:
            continue
        # A section of a sonar has keys for some kinds.
        inner = keys.get(f"{path}.{key['name']}", []) if key["type"] == "section" else []
        if inner and all(kind not in one.get("default_by_kind", {kind: None}) for one in inner):
            continue
        key = {**key, "default": by_kind[kind] if by_kind else key.get("default")}
        name, what = key["name"], key["type"]
        if what in ("number", "whole number"):
            out[name] = number(draw, key, wild)
        elif what.endswith(" numbers"):
            one = {**key, "type": "number", "default": 1.0}
            out[name] = [number(draw, one, wild) for _ in range(int(what.split()[0]))]
        elif what == "true or false":
            out[name] = draw.random() < 0.5
        elif what == "choice":
            out[name] = draw.choice(key["choices"])
        elif what == "section" and f"{path}.{name}" in keys:
            out[name] = section(draw, keys, f"{path}.{name}", wild, share, kind)
    return out


def sensor(draw, keys, kind, size, wild):
    out = section(draw, keys, "sensors.NAME", wild, 0.4, kind)
    highest = {key["name"]: key["high"] for key in keys["sensors.NAME"]
               if kind in key.get("default_by_kind", {}) and "high" in key}
    out["kind"] = kind
    out["every"] = draw.choice([1, 1, 1, 2, 10**9])
    # Images small enough to be many; now and then one side as long as it may be.
    for key in ("range_bins", "azimuth_bins"):
        if key in highest:
            out[key] = draw.choice([1, 2, draw.randint(1, 64), draw.randint(1, 300)])
    if draw.random() < 0.03:
        out["range_bins"] = int(highest["range_bins"])
    elif draw.random() < 0.03 and "azimuth_bins" in highest:
        out["azimuth_bins"] = int(highest["azimuth_bins"])
    # Mostly the range in which there is something to see, and one that the mission can have.
    if draw.random() < 0.7:
        out["range_min_m"] = draw.choice([0, 0.01 * size, 0.5 * size])
        out["range_max_m"] = min(draw.choice([1, 3, 100]) * size, 1e9)
    if draw.random() < 0.9 and out.get("range_min_m", 0.5) >= out.get("range_max_m", 10):
        out["range_min_m"] = 0
    if kind == "sidescan":
        out.get("noise", {}).pop("range_lambda_m", None)
    for of_instrument in ("model", "instrument"):
        out.pop(of_instrument, None)
    if draw.random() < 0.5:
        instrument(draw, keys, kind, wild, out)
    return out


def instrument(draw, keys, kind, wild, sonar):
    """The calibrated model with an instrument, mostly one that fits the sonar's view."""
    sonar["model"] = "calibrated"
    path = "sensors.NAME.instrument"
    sonar["instrument"] = section(draw, keys, path, wild, 0.6, kind)
    for unused in ("noise", "streaks"):
        sonar.pop(unused, None)
    default = {key["name"]: key["default_by_kind"][kind] for key in keys["sensors.NAME"]
               if kind in key.get("default_by_kind", {})}
    beam = sonar["instrument"].get("beam", {})
    of_beam = {key["name"]: key for key in keys[f"{path}.beam"]}
    width = beam.get("width_deg", of_beam["width_deg"]["default_by_kind"][kind])
    if draw.random() < 0.05:
        return
    view = {"echosounder": "opening_deg", "sidescan": "elevation_deg"}.get(kind, "azimuth_deg")
    angle = sonar.get(view, default[view])
    if kind in ("echosounder", "sidescan", "scanning"):
        angle = max(angle, width)
    if view == "azimuth_deg":
        angle = min(angle, draw.choice([1, 30, 120, 179.9]) if kind != "scanning" else 179.9)
    sonar[view] = angle
    if 0 < beam.get("view_azimuth_deg", 0) < angle:
        beam["view_azimuth_deg"] = draw.choice([angle, 179.95, 180])


def trajectory(draw, size, at, folder):
    """A few poses in and around a scene of that size."""
    def position():
        reach = size * draw.choice([0.0, 0.3, 1.0, 3.0])
        return [c + draw.uniform(-reach, reach) for c in at]

    def angle():
        return draw.choice([0.0, 90.0, -90.0, 180.0, 360.0, draw.uniform(-360, 360)])

    kind = draw.choice(["csv", "tum", "waypoints", "lawnmower"])
    if kind == "waypoints":
        points = [position() for _ in range(2)]
        points[1][0] += 0.1 * size
        length = math.dist(*points)
        speed = 10 ** draw.uniform(-3, 3)
        return {"waypoints": [{"position_m": p, "rpy_deg": [angle() for _ in range(3)]}
                              for p in points],
                "speed_m_s": speed, "rate_hz": 3 * speed / length}
    if kind == "lawnmower":
        low = position()
        return {"lawnmower": {"area_min_m": low[:2], "area_max_m": [c + size for c in low[:2]],
                              "z_m": low[2], "heading_deg": angle(),
                              "line_spacing_m": size * draw.choice([0.7, 2, 100]),
                              "speed_m_s": size, "rate_hz": draw.choice([0.5, 1.5])}}
    poses = [(0.5 * i, *position()) for i in range(draw.randint(1, 6))]
    if kind == "csv":
        lines = ["t_s,x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg"]
        lines += [",".join(map(repr, (*pose, angle(), angle(), angle()))) for pose in poses]
    else:
        lines = []
        for pose in poses:
            q = [draw.gauss(0, 1) for _ in range(4)]
            norm = math.hypot(*q)
            lines.append(" ".join(map(repr, (*pose, *(c / norm for c in q)))))
    (folder / f"path.{kind}").write_text("\n".join(lines) + "\n")
    rate = {} if draw.random() < 0.7 else {"rate_hz": draw.choice([0, 0.1, 2.0])}
    return {"file": f"path.{kind}", **rate}


def scene(draw, size, at):
    """A closed box around `at`, or one that is flat in one direction, in world axes."""
    half = [size * draw.choice([1.0, 1.0, 0.3, 1e-3]) for _ in range(3)]
    if draw.random() < 0.2:
        half[draw.randrange(3)] = 0.0
    document = json.loads(box_gltf(half=tuple(half)))
    x, y, z = at
    document["nodes"][0]["translation"] = [x, z, -y]  # glTF is y up
    return json.dumps(document)


def medium(draw, keys):
    """A density or a speed of sound."""
    density = next(key for key in keys["water"] if key["name"] == "density_kg_m3")
    return number(draw, {**density, "low": 1e-9, "high": 1e9, "default": 2000.0}, 0.3)


def keep_rules(draw, mission, surface_m):
    """Mends what a rule across keys refuses; test_refusals.py has these rules."""
    profile = mission.get("water", {}).get("profile")
    for sonar in mission["sensors"].values():
        span = sonar.get("range_max_m", 10) - sonar.get("range_min_m", 0.5)
        sonar["range_bins"] = min(sonar["range_bins"], max(1, int(span / 1.1e-6)))
        if "sector_deg" in sonar or "step_deg" in sonar:
            sonar["step_deg"] = min(sonar.get("step_deg", 0.9), sonar.get("sector_deg", 360))
        if sonar.get("moves_in_ping") or profile is not None:
            sonar.pop("multipath", None)
        for part, key, least in (("speckle", "clutter_shape", 0.05), ("beam", "elevation_width_deg", 0.01)):
            values = sonar.get("instrument", {}).get(part, {})
            if 0 < values.get(key, 0) < least:
                values[key] = least
    if profile is not None:
        profile["named"] = draw.choice(["isothermal", "mixed_layer", "summer"])
        mission["scene"]["water_surface"] = {"height_m": surface_m}
    calibrated = any(sonar.get("model") == "calibrated" for sonar in mission["sensors"].values())
    if mission["engine"] == "octree" and (calibrated or profile is not None):
        mission["engine"] = "rays"


def write_mission(draw, keys, folder):
    """A mission and its files; returns the mission."""
    size = draw.choice([2.0, 2.0, 2.0, 10 ** draw.uniform(-5, 7), 1e-5, 1e7])
    far = draw.choice([0.0, 0.0, 100.0, 5e6, 9e7])
    at = [far * draw.choice([-1, 0.1, 1]) for _ in range(3)]
    wild = draw.choice([0.0, 0.2, 0.6])
    mission = {name: section(draw, keys, name, wild, 0.3)
               for name in ("water", "accuracy", "octree", "output") if draw.random() < 0.5}
    mission["seed"] = draw.choice([0, 7, 2**64 - 1])
    mission["engine"] = draw.choice(["auto", "rays", "octree", "slices"])
    mission["name"] = "random"
    mission["scene"] = {"file": "scene.gltf", "materials": "materials.csv"}
    mission["trajectory"] = trajectory(draw, size, at, folder)
    kinds = next(key["choices"] for key in keys["sensors.NAME"] if key["name"] == "kind")
    mission["sensors"] = {f"s{i}": sensor(draw, keys, draw.choice(kinds), size, wild)
                          for i in range(draw.choice([1, 1, 2]))}
    keep_rules(draw, mission, at[2] + 3 * size)
    output = mission.setdefault("output", {})
    output["folder"] = "out"
    # The finest goals and the widest images together are long work, and no fault.
    if any(s.get("azimuth_bins", 1) > 1000 or s["range_bins"] > 1000
           for s in mission["sensors"].values()):
        mission.pop("accuracy", None)
    (folder / "mission.json").write_text(json.dumps(mission, indent=1))
    (folder / "scene.gltf").write_text(scene(draw, size, at))
    (folder / "materials.csv").write_text(
        "material,density_kg_m3,sound_speed_m_s\n"
        f"Concrete,{medium(draw, keys)!r},{medium(draw, keys)!r}\n")
    return mission


def float32_values(path):
    data = path.read_bytes()
    start = 10 + int.from_bytes(data[8:10], "little")
    return array.array("f", data[start:]) if b"'<f4'" in data[:start] else ()


def check_dataset(out):
    def refuse(name):
        raise AssertionError(f"{name} in JSON")

    for path in out.rglob("*.json"):
        json.loads(path.read_text(), parse_constant=refuse)
    dataset = json.loads((out / "dataset.json").read_text())
    assert dataset["complete"] is True, "exit 0, but not complete"
    for path in out.rglob("*.npy"):
        bad = sum(not math.isfinite(v) for v in float32_values(path))
        assert bad == 0, f"{path.relative_to(out)}: {bad} values are not finite"


def limit_memory():
    if not SANITIZED:
        resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))


def is_said_before(folder):
    """Whether `validate` says that the mission takes long, or more memory than there is."""
    done = subprocess.run([SONARSIM, "validate", "mission.json", "--json", "--overwrite"],
                          cwd=folder, capture_output=True, timeout=LONGEST_S,
                          preexec_fn=limit_memory)
    if done.returncode != 0:
        return b"out of memory" in done.stderr
    found = json.loads(done.stdout)
    seconds = sum(s["seconds_per_ping"] * s["pings"] for s in found.get("sensors", {}).values()
                  if s["seconds_per_ping"] is not None)
    too_large = any(warning["number"] == "W26" for warning in found.get("warnings", []))
    return too_large or seconds > MOST_CPU_S / 3


def run(folder, threads=2):
    """Exit code, what was said, and seconds; the code is None after LONGEST_S. A process that has
    had more than MOST_CPU_S is ended by SIGXCPU."""
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (MOST_CPU_S, MOST_CPU_S + 5))
        limit_memory()

    start = time.monotonic()
    with subprocess.Popen([SONARSIM, "render", "mission.json", f"-j{threads}"], cwd=folder, text=True,
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                          preexec_fn=limit) as process:
        try:
            _, stderr = process.communicate(timeout=LONGEST_S)
            code = process.returncode
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGTERM)
            _, stderr = process.communicate(timeout=60)
            code = None
    return code, stderr, time.monotonic() - start


def check_one_thread(folder):
    """The same bytes again."""
    (folder / "out").rename(folder / "two_threads")
    code, stderr, _ = run(folder, threads=1)
    assert code == 0, stderr
    sums = [(folder / out / "SHA256SUMS").read_text() for out in ("two_threads", "out")]
    assert sums[0] == sums[1], "one thread makes other files than two"


def check(folder):
    """Renders; returns the exit code, or raises AssertionError."""
    code, stderr, seconds = run(folder)
    if code in (None, -signal.SIGXCPU) and is_said_before(folder):
        return 1, seconds
    assert code is not None, f"not done after {LONGEST_S} s: {stderr}"
    assert code in (0, 1, 2), f"exit code {code}: {stderr}"
    errors = [line for line in stderr.splitlines() if line.startswith("error:")]
    if code == 0:
        assert not errors, stderr
        check_dataset(folder / "out")
        if seconds < MOST_TWICE_S:
            check_one_thread(folder)
    else:
        assert errors and stderr.splitlines()[-len(errors):] == errors, stderr
        assert not any("nan" in error.lower() for error in errors), stderr
        if code == 1:
            assert "out of memory" in errors[0], stderr
            assert is_said_before(folder), f"{stderr}, and validate says nothing of it"
        else:
            for error in errors:
                assert PLACE.match(error), f"a refusal without a place: {stderr}"
            assert not (folder / "out" / "dataset.json").exists(), "a refused mission has a dataset"
    return code, seconds


def main():
    listed = subprocess.run([SONARSIM, "keys", "--json"], check=True, capture_output=True)
    keys = {part["path"]: part["keys"] for part in json.loads(listed.stdout)["sections"]}
    codes = {0: 0, 1: 0, 2: 0}
    slowest = (0.0, None)
    failed = []
    for i in [int(ONLY)] if ONLY else range(MISSIONS):
        folder = pathlib.Path(tempfile.mkdtemp(prefix=f"sonarsim-random-{i}-"))
        mission = write_mission(random.Random(f"{SEED}/{i}"), keys, folder)
        try:
            code, seconds = check(folder)
            codes[code] += 1
            slowest = max(slowest, (seconds, i))
        except AssertionError as error:
            failed.append(i)
            print(f"mission {i} (RANDOM_SEED={SEED} RANDOM_ONLY={i}): {error}\n"
                  f"{json.dumps(mission)}\n", flush=True)
        if ONLY:
            print(f"its files are in {folder}")
        else:
            shutil.rmtree(folder)
    print(f"{MISSIONS} missions: {codes[0]} rendered, {codes[2]} refused, {codes[1]} out of "
          f"memory; the slowest, {slowest[1]}, took {slowest[0]:.1f} s; failed: {failed}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
