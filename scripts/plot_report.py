#!/usr/bin/python3
"""Draws the plots of a report of `sonarsim report`, per sonar: error against time per ping.

    plot_report.py report.json FOLDER [--format svg|png]

writes FOLDER/error_SENSOR.svg. The same report gives the same bytes with one version of matplotlib (Debian's python3-matplotlib). Exit code 2 when the report cannot be
read."""
import argparse
import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402: the backend is chosen before

COLOURS = {"strips": "#c22f6d", "rays": "#1f77b4", "octree": "#e67814"}
LEGEND = {"rays": "rays by relative_l1", "strips": "strips by relative_l1", "octree": "octree by leaf_m"}


def plain_number(value, _position=None):
    return f"{value:g}"


def new_plot(title, x_label, y_label):
    figure, axes = plt.subplots(figsize=(9, 6), layout="constrained")
    axes.set(title=title, xlabel=x_label, ylabel=y_label, xscale="log", yscale="log")
    axes.grid(color="#e1e1e1")
    axes.set_axisbelow(True)
    return figure, axes


def label_ticks(axes):
    """1, 2 and 5 of every decade, or 1 alone where there are many decades."""
    for axis in (axes.xaxis, axes.yaxis):
        low, high = axis.get_view_interval()
        digits = (1.0, 2.0, 5.0) if high < 1e4 * low else (1.0,)
        axis.set_major_locator(matplotlib.ticker.LogLocator(subs=digits, numticks=50))
        axis.set_major_formatter(plain_number)
        axis.set_minor_locator(matplotlib.ticker.NullLocator())


def error_plot(report, sensor):
    """Relative L1 against ms per ping: a dot per setting, a ring around the mission's own, a line
    through those that no other setting beats in both."""
    # A logarithmic axis cannot show an error of 0.
    settings = [row for row in report["rows"]
                if row["sensor"] == sensor and row["relative_l1"] > 0 and row["ms_per_ping"] > 0]
    figure, axes = new_plot(f"{report['mission']}, {sensor}",
                            "ms per ping, one thread, noise on", "relative L1")
    front = sorted((s["ms_per_ping"], s["relative_l1"]) for s in settings if s["on_front"])
    axes.plot(*zip(*front) if front else ([], []), color="#969696", zorder=1,
              label="no setting is both faster and more accurate")
    for engine in dict.fromkeys(s["engine"] for s in settings):
        own = [s for s in settings if s["engine"] == engine]
        colour = COLOURS.get(engine)
        dots = axes.scatter([s["ms_per_ping"] for s in own], [s["relative_l1"] for s in own],
                            s=36, color=colour, label=LEGEND.get(engine, engine), zorder=2)
        for s in own:
            axes.annotate(s["setting"].split("=")[-1], (s["ms_per_ping"], s["relative_l1"]),
                          xytext=(7, 4), textcoords="offset points", fontsize=9,
                          color=dots.get_facecolor()[0])
    current = [s for s in settings if s["current"]]
    axes.scatter([s["ms_per_ping"] for s in current], [s["relative_l1"] for s in current], s=170,
                 facecolors="none", edgecolors="#1e1e1e", label="the mission's own setting")
    return figure, axes


def save(plot, path):
    figure, axes = plot
    label_ticks(axes)
    axes.legend(fontsize=9)
    # matplotlib stamps an SVG with the time unless asked not to; a PNG has no such entry.
    figure.savefig(path, dpi=100, metadata={"Date": None} if path.suffix == ".svg" else None)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("report", type=pathlib.Path, help="report.json")
    parser.add_argument("folder", type=pathlib.Path, help="where the plots go")
    parser.add_argument("--format", choices=["svg", "png"], default="svg")
    arguments = parser.parse_args()
    try:
        report = json.loads(arguments.report.read_text())
        sensors = [reference["sensor"] for reference in report["reference"]]
    except (OSError, ValueError, KeyError, TypeError) as error:
        print(f"{arguments.report}: not a report of `sonarsim report`: {error!r}", file=sys.stderr)
        return 2
    # Text stays text, and the identifiers in an SVG are the same every time.
    matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "sonarsim",
                                "font.family": "sans-serif"})
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for sensor in sensors:
        save(error_plot(report, sensor), arguments.folder / f"error_{sensor}.{arguments.format}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
