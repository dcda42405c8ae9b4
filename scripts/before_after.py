#!/usr/bin/python3
"""./scripts/before_after.py PROGRAM FOLDER [mission ...]: makes docs/before_after_MISSION.jpg.

Renders five missions, or the named ones, twice into the folder: with the echo of surfaces alone, and with all that
presets and keys set. Existing datasets are used again. Greys are the square roots of the pictures' greys, so that
the water's echo is visible. Needs Debian's python3-pil and fonts-dejavu-core.
"""
import pathlib
import subprocess
import sys

from PIL import Image, ImageDraw, ImageFont

ROOT = pathlib.Path(__file__).resolve().parent.parent
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
GAP = 6
CAPTION = 20
WIDTH = 420

# Settings of every sensor that turn off what an instrument adds to the echo of surfaces.
INSTRUMENT_OFF = ("instrument.receiver.samples=1", "instrument.receiver.ring_down_db=0", "instrument.receiver.offset=0",
                  "instrument.below_bottom=false", "multipath.method=none")
FAN_OFF = "sensors.fls.instrument.beam.elements={gain_error_db: 0, phase_error_deg: 0}"
# Settings that make a mission shorter.
FEWER = {"seafloor_sidescan_calibrated": ["trajectory.rate_hz=10"]}
# Mission, sensor, its picture, further settings that turn something off before, the part of the picture to show
# (left, top, right, bottom as shares of width and height) and the factor that stretches the height.
SCENES = (
    ("tank_calibrated", "fls", "fan/000045.png", (FAN_OFF,), (0, 0, 1, 1), 1),
    ("seafloor_sidescan_calibrated", "sss", "waterfall_view.png", (), (0, 0.2, 1, 0.8), 1),
    ("scattering_layer", "sounder", "echogram_view.png", ("water.layers=[]",), (0, 0, 1, 1), 1),
    ("fish_and_bubbles", "fls", "fan/000012.png", ("scene.particles=[]", FAN_OFF), (0, 0, 1, 1), 1),
    ("windy_sidescan", "sss", "waterfall_view.png", ("scene.water_surface.scatters=false",), (0.25, 0.1, 0.75, 1), 2),
)


def rendered(program: str, mission: str, settings: list[str], folder: pathlib.Path) -> None:
    if (folder / "SHA256SUMS").exists():
        return
    command = [program, "render", f"configs/{mission}.yaml", "--out", folder, "--overwrite"]
    for setting in ["output.labels=[]", *FEWER.get(mission, []), *settings]:
        command += ["--set", setting]
    subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)


def shown(picture: pathlib.Path, part: tuple, stretch: float, caption: str) -> Image.Image:
    image = Image.open(picture).convert("L")
    left, top, right, bottom = part
    image = image.crop((round(left * image.width), round(top * image.height), round(right * image.width),
                        round(bottom * image.height)))
    image = image.resize((WIDTH, round(stretch * image.height * WIDTH / image.width)), Image.LANCZOS)
    image = image.point([round(255 * (grey / 255) ** 0.5) for grey in range(256)])
    out = Image.new("L", (WIDTH, image.height + CAPTION), 16)
    out.paste(image, (0, CAPTION))
    ImageDraw.Draw(out).text((3, 2), caption, fill=235, font=ImageFont.truetype(FONT, 13))
    return out


def main() -> int:
    program = str(pathlib.Path(sys.argv[1]).resolve())
    folder = pathlib.Path(sys.argv[2]).resolve()
    wanted = sys.argv[3:] or [scene[0] for scene in SCENES]
    for mission, sensor, picture, off, part, stretch in SCENES:
        if mission not in wanted:
            continue
        settings = ["water.content=none", *(f"sensors.{sensor}.{key}" for key in INSTRUMENT_OFF), *off]
        rendered(program, mission, settings, folder / "before" / mission)
        rendered(program, mission, [], folder / "after" / mission)
        pair = [shown(folder / when / mission / sensor / picture, part, stretch, f"{mission}: {when}")
                for when in ("before", "after")]
        both = Image.new("L", (2 * WIDTH + GAP, pair[0].height), 16)
        both.paste(pair[0], (0, 0))
        both.paste(pair[1], (WIDTH + GAP, 0))
        target = ROOT / "docs" / f"before_after_{mission}.jpg"
        both.save(target, quality=72, optimize=True)
        print(f"{target.name}: {both.width} x {both.height}, {target.stat().st_size // 1000} kB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
