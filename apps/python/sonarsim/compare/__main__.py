"""The command `sonarsim compare`."""
import argparse
import json
import os
import pathlib
import sys
import tempfile

DESCRIPTION = "Compares simulated pings with real ones, figure by figure"
EXAMPLES = """examples:
  sonarsim compare real_pings out/tank_calibrated --out compared
  sonarsim compare real_pings out/survey --sensor fls --pings 100"""


def arguments():
    parser = argparse.ArgumentParser("sonarsim compare", description=DESCRIPTION, epilog=EXAMPLES,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
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
    if not text.isdecimal() or not 1 <= int(text) <= 1 << 20:
        raise argparse.ArgumentTypeError(f"{text!r} is no number from 1 to {1 << 20}")
    return int(text)


def run(options):
    # Imported here, so that --help needs no packages.
    from ..recording import RecordingError, open_recording
    from . import report
    from .comparison import compare_recordings
    if options.out and (options.out / "compare.json").exists():
        raise RecordingError(f"{options.out}: holds a comparison already: name another folder, or remove it")
    real = open_recording(options.real, options.real_sensor, options.pings)
    comparison = compare_recordings(real, open_recording(options.simulated, options.sensor, options.pings))
    content = report.comparison_json(comparison)
    if options.out:
        options.out.mkdir(parents=True, exist_ok=True)
        write(options.out / "compare.svg", lambda path: report.plot(comparison, path))
        write(options.out / "compare.json", lambda path: path.write_text(json.dumps(content, indent=2) + "\n"))
    if options.json:
        print(json.dumps(content))
    elif not options.quiet:
        print(report.comparison_text(comparison), end="")


def write(path, make):
    """Makes a file under a temporary name, so that no half of it is left."""
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    os.close(handle)
    try:
        make(pathlib.Path(name))
        os.chmod(name, 0o666 & ~current_umask())
        os.replace(name, path)
    finally:
        pathlib.Path(name).unlink(missing_ok=True)


def current_umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask


def main():
    options = arguments()
    try:
        run(options)
    except ImportError as fault:
        return fail(f"needs the package {fault.name}: apt install python3-numpy python3-scipy python3-matplotlib "
                    "python3-yaml python3-pil")
    except ValueError as fault:
        return fail(fault)
    except OSError as fault:
        return fail(f"{fault.filename or options.out}: {fault.strerror or fault}")
    except MemoryError:
        return fail("the recordings do not fit into memory; take fewer pings with --pings")
    return 0


def fail(text):
    print(f"sonarsim compare: {text}", file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
