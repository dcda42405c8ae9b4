#!/usr/bin/python3
"""./scripts/four_sonars.py [folder of datasets] [picture]: makes docs/four_sonars.png.

The datasets (default: out/) are those of the missions tank_imaging, seafloor_sidescan,
seafloor_bathymetry and survey, as `./scripts/render.sh configs/NAME.yaml` writes them. Needs
Debian's python3-pil and fonts-dejavu-core.
"""
import pathlib
import sys

from PIL import Image, ImageDraw, ImageFont

ROOT = pathlib.Path(__file__).resolve().parent.parent
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
ROW = 400  # height of the first row of pictures, pixels
GAP = 8
CAPTION = 24
BACKGROUND = (16, 16, 20)


def scaled(picture: Image.Image, height: int) -> Image.Image:
    width = round(picture.width * height / picture.height)
    return picture.convert("RGB").resize((width, height), Image.LANCZOS)


def captioned(picture: Image.Image, text: str) -> Image.Image:
    out = Image.new("RGB", (picture.width, picture.height + CAPTION), BACKGROUND)
    out.paste(picture, (0, CAPTION))
    ImageDraw.Draw(out).text((4, 3), text, fill=(235, 235, 235), font=ImageFont.truetype(FONT, 14))
    return out


def palette(picture: Image.Image, greys: int = 32, colours: int = 128) -> Image.Image:
    """An image with a palette of even greys and of the picture's own colours."""
    steps = [255 * i // (greys - 1) for i in range(greys)]
    values = [step for step in steps for _ in range(3)]
    values += picture.quantize(colours).getpalette()[:3 * colours]
    out = Image.new("P", (1, 1))
    out.putpalette(values)
    return out


def main() -> int:
    datasets = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "out"
    target = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else ROOT / "docs" / "four_sonars.png"

    fan = Image.open(datasets / "tank_imaging/fls/fan/000034.png")
    fan = fan.point(lambda grey: min(255, 1.7 * grey))  # for small pictures on bright pages
    waterfall = Image.open(datasets / "seafloor_sidescan/sss/waterfall_view.png")
    waterfall = waterfall.crop((0, 270, waterfall.width, 1370))  # the pings that pass the wreck
    bathymetry = Image.open(datasets / "seafloor_bathymetry/mbes/bathymetry.png")
    first = [captioned(scaled(fan, ROW), "imaging: walls and objects of a tank"),
             captioned(scaled(waterfall, ROW), "side-scan: a wreck and its shadow"),
             captioned(scaled(bathymetry, ROW), "profiling: soundings as a map")]

    width = sum(picture.width for picture in first) + GAP * (len(first) - 1)
    echogram = Image.open(datasets / "survey/sounder/echogram_view.png")
    echogram = echogram.crop((0, 200, echogram.width, 360))  # the depths around the bottom
    last = captioned(scaled(echogram, round(echogram.height * width / echogram.width)),
                     "echosounder: two boulders under the vehicle")

    picture = Image.new("RGB", (width, ROW + CAPTION + GAP + last.height), BACKGROUND)
    left = 0
    for one in first:
        picture.paste(one, (left, 0))
        left += one.width + GAP
    picture.paste(last, (0, ROW + CAPTION + GAP))
    # Noise does not compress; a palette with greys of its own keeps the file small and the fan grey.
    picture.quantize(palette=palette(picture), dither=Image.Dither.NONE).save(target, optimize=True)
    print(f"{target}: {picture.width} x {picture.height}, {target.stat().st_size // 1000} kB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
