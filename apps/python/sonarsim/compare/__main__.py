"""The command `sonarsim compare`."""
import argparse
import json
import pathlib
import sys

from ..command import need, replaced, run


def compare(options):
    from ..recording import open_recording      # pylint: disable=import-outside-toplevel
    from . import comparison, coverage, report    # pylint: disable=import-outside-toplevel
    out = options.out
    if options.pings is not None and options.pings < 1:
        raise ValueError("--pings: must be 1 or more")
    if out and (out / "compare.json").exists():
        raise ValueError(f"{out}: holds a comparison already: name another folder, or remove it")
    real = open_recording(options.real, options.real_sensor, options.pings)
    simulated = (open_recording(one, options.sensor, options.pings) for one in options.simulated)
    if len(options.simulated) > 1:
        covers = coverage.cover_of(real, simulated)
        content, text = coverage.cover_json(real, covers), coverage.cover_text(covers)
    else:
        result = comparison.compare_recordings(real, next(simulated))
        content, text = report.comparison_json(result), report.comparison_text(result)
    if out:
        with replaced(out / "compare.json") as file:
            file.write_text(json.dumps(content, indent=2) + "\n")
    if options.json or not options.quiet:
        print(json.dumps(content) + "\n" if options.json else text, end="")


def main():
    parser = argparse.ArgumentParser(
        "sonarsim compare", description="Compares simulated pings with real ones, figure by figure",
        epilog="example: sonarsim compare real_pings out/survey --sensor fls --pings 100 --out compared")
    add = parser.add_argument
    add("real", help="the real pings: a folder with recording.yaml, or a dataset")
    add("simulated", nargs="+", help="the simulated pings: the same; with several datasets, such as those of variants, "
                                     "the range of each figure is printed, and whether the real one lies in it")
    add("--out", metavar="FOLDER", type=pathlib.Path, help="a folder for compare.json")
    add("--sensor", metavar="NAME", help="the sensor of the simulated dataset, if it has several")
    add("--real-sensor", metavar="NAME", help="the same of the real pings, if these are a dataset")
    add("--pings", metavar="N", type=int, help="reads only the first so many pings of each; default: all")
    add("--json", action="store_true", help="prints compare.json in place of the table")
    add("--quiet", action="store_true", help="prints nothing")
    options = parser.parse_args()
    # Here, so that --help needs no packages.
    need("compare", "numpy", "scipy", "yaml", "PIL")
    return run("compare", compare, options)


if __name__ == "__main__":
    sys.exit(main())
