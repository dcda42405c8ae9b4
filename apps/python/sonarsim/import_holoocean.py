"""`sonarsim import-holoocean`: a mission from the sonars and the pose of the main agent of a HoloOcean scenario.

HoloOcean's frames and units are those of sonarsim. docs/holoocean.md has the tables below for readers.
"""
import argparse
import json
import math
import os
import re
import sys

from .command import replaced, run

NUMBER, NOT_IN_NAMES = (int, float), r"[^A-Za-z0-9_-]"
CALLED = {dict: "an object", list: "a list", str: "text", bool: "true or false", NUMBER: "a number"}
# HoloOcean's kind, which has three forms in 2.4; ours; the keys that it lacks; defaults of RangeMin, RangeMax, Azimuth.
KINDS = (("ImagingSonar", "imaging", {"opening_deg"}, (0.1, 10, 120)),
         ("ProfilingSonar", "profiling", {"opening_deg"}, (0.5, 75, 120)),
         ("SidescanSonar", "sidescan", {"opening_deg", "azimuth_bins", "noise.range_lambda_m"}, (0.5, 35, 170)),
         ("SinglebeamSonar", "echosounder", {"azimuth_deg", "elevation_deg", "azimuth_bins"}, (0.5, 10, 0)))
WATER = {"density_kg_m3": 997, "sound_speed_m_s": 1480}     # the defaults
SONARS = {form + name: kind for name, *kind in KINDS for form in ("", "Raycast", "GPU")}
SONARS["SemanticRaycastSinglebeamSonar"] = SONARS["SinglebeamSonar"]
REMARKS = {"SemanticRaycastSinglebeamSonar": "its labels: output.labels writes them"} | dict.fromkeys(
    ("RaycastSidescanSonar", "GPUSidescanSonar"),
    "it looks to one side: a pair of them is one side-scan sonar of twice the azimuth without their yaw")
PARAMETERS = {       # form, key and limits; without them from 0 on
    "Azimuth": ("number", "azimuth_deg", 1e-3, 360), "Elevation": ("number", "elevation_deg", 1e-3, 180),
    "OpeningAngle": ("number", "opening_deg", 1e-3, 180), "RangeMin": ("number", "range_min_m"),
    "RangeMax": ("number", "range_max_m"), "RangeBins": ("whole", "range_bins", 1, 8192),
    "RangeRes": ("width", "range_bins", 1e-9), "AzimuthBins": ("whole", "azimuth_bins", 1, 8192),
    "AzimuthRes": ("width", "azimuth_bins", 1e-9), "AddSigma": ("number", "noise.add_sigma"),
    "AddCov": ("variance", "noise.add_sigma"), "MultSigma": ("number", "noise.mult_sigma"),
    "MultCov": ("variance", "noise.mult_sigma"), "RangeSigma": ("number", "noise.range_lambda_m"),
    "ScaleNoise": ("flag", "noise.scale_with_range"), "MultiPath": ("multipath", "multipath.method"),
    "ClusterSize": ("whole", "multipath.epsilon_bins", 0, 8192), "AzimuthStreaks": ("streaks", "streaks.mode", -1, 1),
    "WaterDensity": ("number", "water.density_kg_m3", 900, 1300),
    "WaterSpeedSound": ("number", "water.sound_speed_m_s", 1000, 2000)}
EITHER = (("RangeBins", "RangeRes"), ("AzimuthBins", "AzimuthRes"), ("AddSigma", "AddCov"), ("MultSigma", "MultCov"))
# HoloOcean's sonars look along x. These look down in a mission, and TorpedoAUV has sockets that look down.
LOOK_DOWN, SOCKETS_DOWN = ("profiling", "sidescan", "echosounder"), ("SonarSocket", "CameraSocket")
NO_COUNTERPART = {name: why for names, why in (
    ("ElevationBins ElevationRes OpeningAngleBins OpeningAngleRes CentralAngleBins CentralAngleRes AzimuthRayCount "
     "AzimuthRayRes ElevationRayCount ElevationRayRes OpeningAngleRays CentralAngleRays CentralAngleEuclidian "
     "ResolutionX", "sampling follows from accuracy.relative_l1"),
    ("ViewRegion ViewOctree ViewRays ViewPoints ShowWarning", "it only shows something in the game engine"),
    ("InitOctreeRange", "there is no octree to prepare"), ("ShadowEpsilon", "shadows are exact"),
    ("UseApprox", "angles are exact"), ("UseTags", "output.labels writes labels"),
    ("IgnorePlants", "leave the plants out of the scene")) for name in names.split()}


def say(what):
    print(f"sonarsim import-holoocean: {what}", file=sys.stderr)


def wrong(what):
    sys.exit(say(what) or 2)


def take(where, items, key, kind, default=None):
    """The value of a key of this kind. `where` is the path of the object in the scenario."""
    value = items.get(key, default)
    if value is not default and (not isinstance(value, kind) or kind is NUMBER and isinstance(value, bool)):
        wrong(f"{where}{key} must be {CALLED[kind]}")
    return value


def number(where, items, key, low=0, high=1e8):
    value = take(where, items, key, NUMBER, math.nan)
    return value if low <= value <= high else wrong(f"{where}{key} must be from {low:g} to {high:g}, not {value}")


def vector(where, items, key, limit=1e8):
    values = [number(where, {key: one}, key, -limit, limit) for one in take(where, items, key, list, [0, 0, 0])]
    return values if len(values) == 3 else wrong(f"{where}{key} must be a list of 3 numbers")


def turned(vector, rpy):
    x, y, z = vector
    (r, p, h), (R, P, H) = zip(*((math.cos(one), math.sin(one)) for one in map(math.radians, rpy)))
    y, z = y * r - z * R, y * R + z * r
    x, z = x * p + z * P, z * p - x * P
    return x * h - y * H, x * H + y * h, z


def mounted(rpy, default, socket):
    """Roll, pitch and yaw of a mount on top of the default one, in place of `rpy` relative to the socket. Degrees."""
    bow, port, up = (turned(turned(turned(axis, [0, -default, 0]), rpy), [0, socket, 0])
                     for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
    level = math.hypot(bow[0], bow[1])
    is_upright = level < 1e-9
    yaw = math.atan2(-port[0], port[1]) if is_upright else math.atan2(bow[1], bow[0])
    turns = 0 if is_upright else math.atan2(port[2], up[2]), math.atan2(-bow[2], level), yaw
    return [round(math.degrees(one), 6) + 0.0 for one in turns]


def value_of(where, items, name, defaults):
    form, key, *limits = PARAMETERS[name]
    value = (take(where, items, name, bool, False) if form in ("flag", "multipath") else
             number(where, items, name, *limits))
    if form in ("whole", "streaks") and value != math.floor(value):
        wrong(f"{where}{name} must be a whole number, not {value}")
    if form == "width":
        low, high, azimuth = (number(where, {end: default} | items, end)
                              for end, default in zip(("RangeMin", "RangeMax", "Azimuth"), defaults))
        if low >= high:
            wrong(f"{where}RangeMax must be above RangeMin")
        value = math.floor((high - low if key == "range_bins" else azimuth) / value + 0.5)
        value = number(where, {f"bins by {name}": value}, f"bins by {name}", 1, 8192)
    return {"streaks": ("none", "add", "reduce")[int(value) % 3], "multipath": "cluster" if value else "none",
            "variance": math.sqrt(abs(value)), "whole": int(value)}.get(form, value)


def sonar_of(where, sensor, kind, every, agent):
    """The section of a sonar, its keys of the water, and remarks on what has no counterpart."""
    own, lacks, defaults = SONARS[kind]
    place, rpy = vector(where, sensor, "location"), vector(where, sensor, "rotation", 360)
    default = 90 * (own in LOOK_DOWN)
    socket = 90 * (agent == "TorpedoAUV" and sensor.get("socket") in SOCKETS_DOWN)
    mount = {"translation_m": [round(one, 6) for one in turned(place, [0, socket, 0])] if socket else place,
             "rpy_deg": mounted(rpy, default, socket) if default or socket else rpy}
    sonar = {"kind": own, "mount": mount, "every": every} | ({"azimuth_deg": 85} if kind == "GPUSidescanSonar" else {})
    remarks = [f"{kind}: {REMARKS[kind]}"] if kind in REMARKS else []
    given, inside = take(where, sensor, "configuration", dict, {}), where + "configuration."
    for one, other in EITHER:
        if one in given and other in given:
            wrong(f"{inside}{one} and {other} exclude each other")
    if kind == "SidescanSonar" and not {"RangeBins", "RangeRes"} & set(given):
        given = {"RangeRes": 0.05} | given
    for name in given:
        key = PARAMETERS.get(name, ("", ""))[1]
        if key and key not in lacks:
            section, _, inner = key.rpartition(".")
            (sonar.setdefault(section, {}) if section else sonar)[inner] = value_of(inside, given, name, defaults)
        else:
            why = f"a sonar of kind {own} has no {key}" if key else NO_COUNTERPART.get(name, "it is not known")
            remarks.append(f"'{' '.join(name.split())[:60]}' has no counterpart: {why}")
    if kind == "SidescanSonar":     # its bins are those of both sides
        sonar["range_bins"] = max(sonar["range_bins"] // 2, 1)
    if "add_sigma" in sonar.get("noise", {}):       # HoloOcean's noise grows with range only if ScaleNoise is set
        sonar["noise"].setdefault("scale_with_range", False)
    if sonar.get("range_min_m", defaults[0]) >= sonar.get("range_max_m", defaults[1]):
        wrong(f"{inside}RangeMax must be above RangeMin")
    remarks += ["where its socket sits on the agent is not in the scenario: check mount"] * ("socket" in sensor)
    return sonar, sonar.pop("water", {}), remarks


def sensors_of(where, agent, ticks):
    """The sections of all sonars, their water and the rate of the fastest."""
    sonars, sections, waters = [], {}, []
    for k, sensor in enumerate(take(where, agent, "sensors", list, [])):
        here = f"{where}sensors[{k}]."
        kind = take(here, sensor, "sensor_type", str, "") if isinstance(sensor, dict) else ""
        if kind in SONARS:
            sonars.append((here, sensor, kind, number(here, {"Hz": ticks} | sensor, "Hz", 1e-6, ticks)))
        else:
            known = f"; it has {', '.join(SONARS)}" if "onar" in kind else ""
            say(f"{here}sensor_type '{kind}' is left out: sonarsim does not have it{known}")
    fastest = max((rate for *_, rate in sonars), default=0) or wrong(f"{where}sensors: no sonar of {', '.join(SONARS)}")
    for here, sensor, kind, rate in sonars:
        base = re.sub(NOT_IN_NAMES, "_", take(here, sensor, "sensor_name", str, kind))[:60] or "sonar"
        name = next(one for one in (base, *(f"{base}_{k}" for k in range(2, 10**4))) if one not in sections)
        every = math.floor(fastest / rate + 0.5)
        sections[name], own, remarks = sonar_of(here, sensor, kind, every, agent.get("agent_type"))
        waters.append((here, own, remarks))
        if abs(fastest / every - rate) > 0.01 * rate:
            remarks.append(f"{rate:.4g} Hz become {fastest / every:.4g} Hz: a sonar pings at every n-th pose, of which "
                           f"there are {fastest:.4g} in a second")
        sections[name]["#"] = remarks
    water = {key: value for _, own, _ in reversed(waters) for key, value in own.items()}
    for here, own, remarks in waters:
        remarks += [f"another water than the mission, which has one: {key} is {value}" for key, value in water.items()
                    if own.get(key, WATER[key]) != value]
        for remark in remarks:
            say(f"{here[:-1]}: {remark}")
    return sections, water, fastest


def mission_of(top, arguments):
    agents = [one for one in take("", top, "agents", list, []) if isinstance(one, dict)]
    wanted, names = take("", top, "main_agent", str), [one.get("agent_name") for one in agents]
    if not agents or wanted and wanted not in names:
        wrong(f"no agent is called '{wanted}'" if agents else "a scenario needs a list of agents")
    agent, where = (agents[k := names.index(wanted) if wanted else 0], f"agents[{k}].")
    sensors, water, rate = sensors_of(where, agent, number("", {"ticks_per_sec": 30} | top, "ticks_per_sec", 1e-6))
    start, turn = vector(where, agent, "location"), vector(where, agent, "rotation", 360)
    _, pitch, yaw = map(math.radians, turn)
    bow = math.cos(yaw) * math.cos(pitch), math.sin(yaw) * math.cos(pitch), -math.sin(pitch)
    end = [round(at + 10 * step, 6) for at, step in zip(start, bow)]
    remarks = [f"'{' '.join(name.split())}' has no counterpart: there is no octree to prepare"
               for name in top if name.startswith(("octree_", "env_"))]
    remarks += [f"{where}{name} has no counterpart: `vary` draws poses"
                for name in ("location_randomization", "rotation_randomization") if name in agent]
    remarks += ["other agents are left out: a mission has one vehicle"] * (len(agents) > 1)
    remarks += ["a scenario says where the agent starts, not where it goes: the mission goes 10 m ahead; write a "
                "trajectory of your own", "the world is a level of the game engine: export it, or name another scene"]
    say("\nsonarsim import-holoocean: ".join(remarks))
    def beside(path):
        is_given = path in (arguments.scene, arguments.materials) and arguments.out and not os.path.isabs(path)
        return os.path.relpath(path, os.path.dirname(arguments.out) or ".") if is_given else path
    named = {"name": re.sub(NOT_IN_NAMES, "_", take("", top, "name", str))[:60] or "sonar"} if "name" in top else {}
    return named | {"#": remarks, "water": water,
            "scene": {"file": beside(arguments.scene or "scene.glb"), "materials": beside(arguments.materials or "materials.csv")},
            "trajectory": {"waypoints": [{"position_m": at, "rpy_deg": turn} for at in (start, end)], "rate_hz": rate},
            "sensors": sensors}


def yaml_lines(items, indent=""):
    for key, value in items.items():
        if key == "#":
            yield from (f"{indent}# {remark}" for remark in value)
        elif isinstance(value, dict) and value:
            yield f"{indent}{key}:"
            yield from yaml_lines(value, indent + "  ")
        else:
            yield f"{indent}{key}: {json.dumps(value)}"     # JSON is YAML


def convert(arguments):
    try:
        with open(arguments.scenario, encoding="utf-8") as file:
            top = json.load(file)
    except (ValueError, RecursionError) as fault:
        raise ValueError(f"{arguments.scenario} is not JSON: {fault}") from fault
    text = "\n".join([*yaml_lines(mission_of(top if isinstance(top, dict) else {}, arguments)), ""])
    if not arguments.out:
        print(text, end="")
    elif os.path.exists(arguments.out):
        raise ValueError(f"{arguments.out} is there already: name another file, or remove it")
    else:
        with replaced(arguments.out) as part:
            part.write_text(text, "utf-8")


def main():
    parser = argparse.ArgumentParser("sonarsim import-holoocean", description=__doc__.splitlines()[0].split(": ")[1])
    parser.add_argument("scenario", help="the scenario, a JSON file")
    parser.add_argument("--out", metavar="FILE", help="the mission, a new file (default: standard output)")
    parser.add_argument("--scene", metavar="FILE", help="the scene of the mission")
    parser.add_argument("--materials", metavar="FILE", help="a CSV; HoloOcean's own is one")
    return run("import-holoocean", convert, parser.parse_args())


if __name__ == "__main__":
    sys.exit(main())
