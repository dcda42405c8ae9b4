#!/usr/bin/python3
"""Draws the backscattering strength of sea beds by the grazing angle at 30, 100 and 400 kHz, beside
the published table of the model that they follow.

    plot_scattering.py SONARSIM MATERIALS.csv PICTURE.svg

SONARSIM is the program, whose command `materials` gives the numbers. Needs matplotlib (Debian's
python3-matplotlib). docs/calibrated.md has the picture of scenes/materials.csv."""
import json
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402: the backend is chosen before

COLOURS = {"rock": "#5b5b5b", "gravel": "#a0522d", "sand": "#e0a000", "silt": "#2e8b57", "mud": "#1f77b4"}
SHOWN = [*range(4, 74, 3), *range(75, 90, 2)]  # dense where the curves are steep
# APL-UW TR 9407 (1994), section IV, table 3: rock, cobble or gravel or pebble, medium sand, silt.
ANGLES = [5, 7, 10, 20, 40, 60, 70, 80, 85, 88, 90]
PUBLISHED = {
    30: {"rock": [-28.4, -25.2, -21.7, -15.4, -10.0, -9.1, -8.3, -7.3, -6.8, -6.6, -6.6],
         "gravel": [-32.6, -29.2, -25.7, -19.3, -14.9, -13.1, -11.5, -9.2, -8.2, -7.9, -7.8],
         "sand": [-42.1, -39.0, -35.4, -28.3, -23.5, -21.2, -17.7, -10.8, -5.5, -3.4, -3.1],
         "silt": [-41.3, -38.3, -35.7, -31.8, -28.8, -27.4, -27.0, -26.3, -23.9, -13.1, -3.6]},
    100: {"sand": [-36.6, -33.3, -29.8, -24.2, -21.7, -19.5, -16.4, -12.2, -10.4, -9.8, -9.7]}}


def strengths(program, materials, khz):
    """The grazing angles in degrees and the strengths in dB by material."""
    done = subprocess.run([program, "inspect", materials, "--frequency-khz", str(khz), "--json"],
                          check=True, capture_output=True, text=True)
    reported = json.loads(done.stdout)
    return reported["grazing_deg"], reported["strength_db"]


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    program, materials, picture = sys.argv[1:]
    plt.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "sonarsim", "font.size": 9})
    figure, panels = plt.subplots(1, 3, figsize=(9.5, 3.6), sharey=True, layout="constrained")
    for axes, khz in zip(panels, (30, 100, 400)):
        angles, by_material = strengths(program, materials, khz)
        for name, colour in COLOURS.items():
            axes.plot([angles[k] for k in SHOWN], [by_material[name][k] for k in SHOWN], color=colour,
                      label=name, linewidth=1.3)
            if name in PUBLISHED.get(khz, {}):
                axes.plot(ANGLES, PUBLISHED[khz][name], "o", color=colour, markersize=3)
        axes.set(title=f"{khz} kHz", xlabel="grazing angle, degrees", xlim=(0, 90), ylim=(-45, 0))
        axes.grid(color="#e1e1e1")
    panels[0].set_ylabel("backscattering strength, dB")
    panels[2].legend(loc="lower right", frameon=False)
    figure.savefig(picture, metadata={"Date": None})


if __name__ == "__main__":
    main()
