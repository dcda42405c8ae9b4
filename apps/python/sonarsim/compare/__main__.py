"""The command `sonarsim compare`."""
import argparse
import json
import os
import pathlib
import sys
import tempfile

from ..need import need

DESCRIPTION = "Compares simulated pings with real ones, figure by figure"
EXAMPLE = "example: sonarsim compare real_pings out/survey --sensor fls --pings 100 --out compared"


def arguments():
    parser = argparse.ArgumentParser("sonarsim compare", description=DESCRIPTION, epilog=EXAMPLE)
    parser.add_argument("real", help="the real pings: a folder with recording.yaml, or a dataset")
    parser.add_argument("simulated", help="the simulated pings: the same")
    parser.add_argument("--out", metavar="FOLDER", type=pathlib.Path, help="a folder for compare.json and compare.svg")
    parser.add_argument("--sensor", metavar="NAME", help="the sensor of the simulated dataset, if it has several")
    parser.add_argument("--real-sensor", metavar="NAME", help="the same of the real pings, if these are a dataset")
    parser.add_argument("--pings", metavar="N", type=number_of_pings,
                        help="reads only the first so many pings of each; default: all")
    parser.add_argument("--json", action="store_true", help="prints compare.json in place of the table")
    parser.add_argument("--quiet", action="store_true", help="prints nothing")
    return parser.parse_args()


def number_of_pings(text):
    if not text.isdecimal() or not 0 < int(text) <= 1 << 20:
        raise argparse.ArgumentTypeError(f"{text!r} is no number from 1 to {1 << 20}")
    return int(text)


def main():
    options = arguments()
    # Imported here, so that --help needs no packages.
    need("numpy", "scipy", "yaml", "PIL", *["matplotlib"] * bool(options.out))
    from ..recording import RecordingError, open_recording
    from . import report
    from .comparison import compare_recordings
    try:
        if options.out and (options.out / "compare.json").exists():
            raise RecordingError(f"{options.out}: holds a comparison already: name another folder, or remove it")
        comparison = compare_recordings(open_recording(options.real, options.real_sensor, options.pings),
                                        open_recording(options.simulated, options.sensor, options.pings))
        content = report.comparison_json(comparison)
        if options.out:
            options.out.mkdir(parents=True, exist_ok=True)
            # Made beside it and renamed, so that no half of a file is left.
            with tempfile.TemporaryDirectory(dir=options.out, prefix=".compare") as folder:
                made = pathlib.Path(folder)
                report.plot(comparison, made / "compare.svg")
                (made / "compare.json").write_text(json.dumps(content, indent=2) + "\n")
                for name in ("compare.svg", "compare.json"):
                    os.replace(made / name, options.out / name)
        if options.json or not options.quiet:
            print(json.dumps(content) + "\n" if options.json else report.comparison_text(comparison), end="")
    except RecordingError as fault:
        return fail(fault)
    except OSError as fault:
        return fail(f"{fault.filename or options.out or 'output'}: {fault.strerror or fault}")
    except MemoryError:
        return fail("the recordings do not fit into memory; take fewer pings with --pings")
    return 0


def fail(text):
    print(f"sonarsim compare: {text}", file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
