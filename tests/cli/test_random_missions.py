"""Random missions: keys drawn from the range that `sonarsim keys --json` states for them, extremes included, are given to
a small mission of a box, from a hundredth of a millimetre to the size of the Earth. Whatever they ask for: no crash, no
hang, no pixel that is not finite, the same bytes on one thread and on two, and a refusal has a place for each fault.

RANDOM_MISSIONS is their number and RANDOM_SEED names the set; mission I alone, with its files kept: RANDOM_ONLY=I. A
mission that needs more than MAX_CPU_S of processor time or MAX_MEMORY is no fault where `validate` has said so."""
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
import tempfile
import time
import unittest

from sandbox import SANITIZED, SONARSIM, box_gltf, numbers_of

MISSIONS = int(os.environ.get("RANDOM_MISSIONS", "15" if SANITIZED else "40"))
SEED = os.environ.get("RANDOM_SEED", "1")
ONLY = os.environ.get("RANDOM_ONLY")
MAX_CPU_S = 300 if SANITIZED else 60 if MISSIONS > 100 else 10
LONGEST_S = max(600, 10 * MAX_CPU_S)
# What takes longer is not rendered again on one thread.
MAX_TWICE_S, MAX_MEMORY = 600 if MISSIONS > 100 else 1, 6 << 30

PLACE = re.compile(r"error: (mission\.json|materials\.csv|scene\.gltf|path\.csv"
                   r"|/[^ ]*\.(json|csv|gltf)|sensor '\w+'|[a-z_]+(\.[a-z_]+)*)\b")
# Sections whose keys are drawn.
SECTIONS = re.compile(r"|water|water\.profile|scene\.water_surface|vehicle(\..*)?|accuracy|output|sensors\.NAME(\..*)?")
# What the small mission sets, or what asks for many missions.
NOT_DRAWN = ("seed", "engine", "variants", "kind", "model", "range_min_m", "range_max_m", "range_bins", "azimuth_bins",
             "folder", "octree_leaf_m", "height_m", "named")


def keys_of(schema):
    """{(section, key): {(kind, model) of its sonar, or None: its schema}} of the JSON Schema of missions."""
    found = {}

    def add(section, path, sonar):
        for name, part in section["properties"].items():
            if path + name == "sensors":
                for rule in part["additionalProperties"]["allOf"]:
                    of_sonar = rule["if"]["properties"]
                    add(rule["then"], "sensors.NAME.", (of_sonar["kind"]["const"], of_sonar["model"].get("const", "paper")))
            elif "properties" in part:
                add(part, f"{path}{name}.", sonar)
            else:
                found.setdefault((path[:-1], name), {})[sonar] = part

    add(schema, "", None)
    return found


def number(draw, key):
    """A number of the key's range: within a factor of ten of the default, or often one of the ends or one at the edge
    of what floats hold."""
    low, high, default = key.get("minimum", key.get("exclusiveMinimum")), key["maximum"], key.get("default")
    kind = draw.random()
    if kind < 0.5:
        value = (default if isinstance(default, (int, float)) and default else draw.uniform(0, 1)) * 10 ** draw.uniform(-1, 1)
    elif kind < 0.75:
        value = draw.choice([low, high])
    elif kind < 0.8:
        value = draw.choice([0.0, 5e-324, 1e-300, 1e-30])
    else:
        largest = max(abs(low), abs(high))
        smallest = low if low > 0 else min(1e-9, largest)
        value = math.exp(draw.uniform(math.log(smallest), math.log(largest)))
        value *= -1 if low < 0 and draw.random() < 0.5 else 1
    value = min(max(value, low), high)
    if "exclusiveMinimum" in key and value <= low:
        value = math.nextafter(low, high)
    return min(max(int(value), int(low)), int(high)) if key["type"] == "integer" else value


def value_of(draw, key):
    """None where the key holds something else than numbers, flags and choices."""
    if "const" in key.get("anyOf", [{}])[0]:    # a word, or a number
        word, other = key["anyOf"]
        return word["const"] if draw.random() < 0.5 else number(draw, {**other, "default": key.get("default")})
    if key.get("type") in ("number", "integer"):
        return number(draw, key)
    if key.get("type") == "array" and key["items"].get("type") == "number":
        return [number(draw, {**key["items"], "default": 1.0}) for _ in range(key["minItems"])]
    if "enum" in key:
        return draw.choice(key["enum"])
    return draw.random() < 0.5 if key.get("type") == "boolean" else None


def sensor(draw, keys, size):
    """A sonar that mostly has something to see, of an image small enough; now and then with a side as long as it may be."""
    kind, model = draw.choice(sorted(keys["sensors.NAME", "kind"]))
    out = {"kind": kind, "model": model, "range_min_m": draw.choice([0, 0.01 * size, 0.5 * size]),
           "range_max_m": min(draw.choice([1, 3, 100]) * size, 1e9)}
    for name in ("range_bins", "azimuth_bins"):
        if (kind, model) in keys["sensors.NAME", name]:
            out[name] = draw.choice([1, 2, draw.randint(1, 64), draw.randint(1, 200)])
    if draw.random() < 0.05:
        out[draw.choice([name for name in ("range_bins", "azimuth_bins") if name in out])] = 8192
    return out


def write_mission(draw, keys, folder):
    """A mission and its files; returns the mission."""
    size = draw.choice([2.0, 2.0, 2.0, 10 ** draw.uniform(-5, 7), 1e-5, 1e7])
    at = [draw.choice([0.0, 0.0, 100.0, 5e6, 9e7]) * draw.choice([-1, 0.1, 1]) for _ in range(3)]
    sensors = {f"s{i}": sensor(draw, keys, size) for i in range(draw.choice([1, 1, 2]))}
    models = {one["model"] for one in sensors.values()}
    mission = {"seed": draw.choice([0, 7, 2**64 - 1]), "name": "random", "sensors": sensors, "output": {"folder": "out"},
               "engine": draw.choice(["auto", "rays", "strips", *(["octree"] if models == {"paper"} else [])]),
               "octree_leaf_m": min(max(size * draw.choice([0.1, 0.3, 5]), 0.001), 1000),
               "scene": {"file": "scene.gltf", "materials": "materials.csv"}, "trajectory": {"file": "path.csv"}}
    if draw.random() < 0.5:
        mission["scene"]["water_surface"] = {"height_m": at[2] + 3 * size}
    else:
        keys = {one: parts for one, parts in keys.items() if one[0] not in ("scene.water_surface", "water.profile")}
    drawn = [one for one in keys if SECTIONS.fullmatch(one[0]) and one[1] not in NOT_DRAWN]
    for path, key in draw.sample(drawn, draw.choice([2, 8, 30])):
        for name, one in sensors.items() if "NAME" in path else [("", None)]:
            part = keys[path, key].get(one and (one["kind"], one["model"]))
            value = value_of(draw, part) if part else None
            if value is not None:
                inner = mission
                for step in filter(None, path.replace("NAME", name).split(".")):
                    inner = inner.setdefault(step, {"named": "summer"} if step == "profile" else {})
                inner[key] = value
    (folder / "mission.json").write_text(json.dumps(mission, indent=1))
    # A closed box around `at`, or one that is flat in one direction; y is up in it.
    document = json.loads(box_gltf(half=[size * draw.choice([1.0, 1.0, 0.3, 1e-3, 0.0]) for _ in range(3)]))
    document["nodes"][0]["translation"] = [at[0], at[2], -at[1]]
    (folder / "scene.gltf").write_text(json.dumps(document))
    reach = size * draw.choice([0.0, 0.3, 1.0, 3.0])
    poses = [(0.5 * i, *(c + draw.uniform(-reach, reach) for c in at),
              *(draw.choice([0.0, 90.0, -90.0, 180.0, 360.0, draw.uniform(-360, 360)]) for _ in range(3)))
             for i in range(draw.randint(1, 6))]
    (folder / "path.csv").write_text("".join(
        ",".join(map(str, row)) + "\n" for row in ["t_s x_m y_m z_m roll_deg pitch_deg yaw_deg".split(), *poses]))
    density, speed = (number(draw, {"type": "number", "minimum": 1e-9, "maximum": 1e9, "default": 2000.0}) for _ in range(2))
    (folder / "materials.csv").write_text(f"material,density_kg_m3,sound_speed_m_s\nConcrete,{density!r},{speed!r}\n")
    return mission


def check_dataset(out):
    def refuse(name):
        raise AssertionError(f"{name} in JSON")

    for path in out.rglob("*.json"):
        json.loads(path.read_text(), parse_constant=refuse)
    assert json.loads((out / "dataset.json").read_text())["complete"] is True, "exit 0, but not complete"
    for path in out.rglob("*.npy"):
        if b"'<f4'" in path.read_bytes()[:128]:
            assert all(map(math.isfinite, numbers_of(path))), f"{path.relative_to(out)} has values that are not finite"


def run(folder, *words, cpu_s=LONGEST_S):
    """The result of a command with little memory, which SIGXCPU ends after `cpu_s`; a hang is a subprocess.TimeoutExpired."""
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (cpu_s, cpu_s + 5))
        if not SANITIZED:
            resource.setrlimit(resource.RLIMIT_AS, (MAX_MEMORY, MAX_MEMORY))
    return subprocess.run([SONARSIM, *words], cwd=folder, text=True, capture_output=True, timeout=LONGEST_S, preexec_fn=limit,
                          check=False)


def is_said_before(folder):
    """Whether `validate` says that the mission takes long, or more memory than there is."""
    done = run(folder, "validate", "mission.json", "--json", "--overwrite")
    if done.returncode != 0:
        return "out of memory" in done.stderr
    found = json.loads(done.stdout)
    seconds = sum(s["seconds_per_ping"] * s["pings"] for s in found.get("sensors", {}).values() if s["seconds_per_ping"] is not None)
    too_large = any(warning["number"] == "W26" for warning in found.get("warnings", []))
    return too_large or seconds > MAX_CPU_S / 3


def check(folder):
    """Renders; returns the exit code, 1 for what is too much for this machine, or raises AssertionError."""
    render, start = ("render", "mission.json"), time.monotonic()
    done = run(folder, *render, "-j2", cpu_s=MAX_CPU_S)
    code, stderr, seconds = done.returncode, done.stderr, time.monotonic() - start
    if code == -signal.SIGXCPU and is_said_before(folder):
        return 1
    assert code in (0, 1, 2), f"exit code {code}: {stderr}"
    errors = [line for line in stderr.splitlines() if line.startswith("error:")]
    if code == 0:
        assert not errors, stderr
        check_dataset(folder / "out")
        if seconds < MAX_TWICE_S:
            (folder / "out").rename(folder / "two_threads")
            done = run(folder, *render, "-j1", cpu_s=MAX_CPU_S)
            assert done.returncode == 0, done.stderr
            sums = [(folder / out / "SHA256SUMS").read_text() for out in ("two_threads", "out")]
            assert sums[0] == sums[1], "one thread makes other files than two"
            done = run(folder, "validate", "mission.json", "--overwrite", "-q")
            assert done.returncode == 0, f"validate: exit code {done.returncode}: {done.stderr}"
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
    return code


class RandomMissions(unittest.TestCase):
    def test_any_values(self):
        listed = subprocess.run([SONARSIM, "keys", "--json"], check=True, capture_output=True)
        keys = keys_of(json.loads(listed.stdout))
        codes = []
        for i in [int(ONLY)] if ONLY else range(MISSIONS):
            folder = pathlib.Path(tempfile.mkdtemp(prefix=f"sonarsim-random-{i}-"))
            mission = write_mission(random.Random(f"{SEED}/{i}"), keys, folder)
            with self.subTest(RANDOM_SEED=SEED, RANDOM_ONLY=i, mission=json.dumps(mission)):
                codes.append(check(folder))
            if ONLY:
                print(f"its files are in {folder}")
            else:
                shutil.rmtree(folder)
        print(f"{codes.count(0)} missions rendered, {codes.count(2)} refused, {codes.count(1)} out of memory")
