"""Bytes and errors of conversions against results.csv, so that no change of rate goes unseen.

Usage: check_results.py ZEROTREE FOLDER SAMPLE...            compares, 1 if a row differs
       check_results.py --write ZEROTREE FOLDER SAMPLE...    writes the samples' rows anew
FOLDER holds the samples. A sample that is not there is skipped and named; if none is, the exit code
is 77.
"""

import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path

RESULTS = Path(__file__).with_name("results.csv")
UNIT = 1e-4  # of the bounding box diagonal
SKIPPED = 77
# The library that measures distances chooses its instructions by the machine, and the step and the
# cut follow the distance measured, so the last bits of both may differ from machine to machine.
BYTES_TOLERANCE = 0.001
ERROR_TOLERANCE = 0.005
LEAST_ERROR = 0.05  # in UNIT: smaller errors are rounding, and all alike
SETTINGS = {
    "stream": ["--stream", "out.zt"],
    "glb": ["-o", "out.glb"],
    "glb to 1e-4, compressed base": ["-o", "out.glb", "--max-error", "1e-4", "--compress-base"],
}
# Scans of the tests themselves are too coarse for a small error.
SETTINGS_OF_TINY = {
    "stream": SETTINGS["stream"],
    "glb": SETTINGS["glb"],
    "glb to 2e-3, compressed base": ["-o", "out.glb", "--max-error", "2e-3", "--compress-base"],
}
TINY_VERTICES = 10_000


def convert(zerotree, mesh, options):
    with tempfile.TemporaryDirectory() as folder:
        command = [Path(zerotree).resolve(), "convert", mesh.resolve(), *options, "--report",
                   "report.json"]
        done = subprocess.run([str(c) for c in command], cwd=folder, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"results: {' '.join(map(str, command))}\n{done.stderr or done.stdout}")
        return json.loads((Path(folder) / "report.json").read_text())


def rows_of(zerotree, mesh):
    """(sample, setting, bytes, error in UNIT): a stream's prefixes, and each whole file."""
    streamed = convert(zerotree, mesh, SETTINGS["stream"])
    yield from ((mesh.name, f"stream, {p['bitsPerVertex']:.4g} bits/vertex", p["bytes"],
                 p["error"] / UNIT) for p in streamed["stream"]["prefixes"])
    tiny = streamed["input"]["vertices"] < TINY_VERTICES
    for setting, options in (SETTINGS_OF_TINY if tiny else SETTINGS).items():
        if setting == "stream":
            continue
        report = convert(zerotree, mesh, options)
        error = report["payload"]["prefixes"][-1]["error"] / UNIT
        yield mesh.name, setting, report["file"]["bytes"], error


def read_results():
    with open(RESULTS, newline="") as file:
        return [(r["sample"], r["setting"], int(r["bytes"]), float(r["error_1e-4"]))
                for r in csv.DictReader(file)]


def write_results(rows):
    with open(RESULTS, "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["sample", "setting", "bytes", "error_1e-4"])
        table.writerows((*row[:3], f"{row[3]:.4g}") for row in rows)


def near(a, b, tolerance):
    return abs(a - b) <= tolerance * max(a, b)


def same_error(a, b):
    return near(a, b, ERROR_TOLERANCE) or max(a, b) < LEAST_ERROR


def differences(sample, measured):
    expected = {row[1]: row[2:] for row in read_results() if row[0] == sample}
    found = {row[1]: row[2:] for row in measured}
    for setting in sorted(expected.keys() | found.keys()):
        old, new = expected.get(setting), found.get(setting)
        if old is None or new is None:
            yield f"{sample}, {setting}: {'gone' if new is None else 'not in results.csv'}"
        elif not (near(old[0], new[0], BYTES_TOLERANCE) and same_error(old[1], new[1])):
            yield (f"{sample}, {setting}: {new[0]} bytes, error {new[1]:.4g};"
                   f" results.csv has {old[0]} bytes, error {old[1]:.4g}")


def main(arguments):
    write = arguments[0] == "--write"
    zerotree, folder, *samples = arguments[1:] if write else arguments
    meshes = [Path(folder) / name for name in samples]
    missing = [str(m) for m in meshes if not m.is_file()]
    for mesh in missing:
        print(f"SKIPPED: {mesh} is missing")
    measured = {m.name: list(rows_of(zerotree, m)) for m in meshes if m.is_file()}
    if write:
        kept = [row for row in read_results() if row[0] not in measured] if RESULTS.exists() else []
        write_results(sorted(kept, key=lambda row: row[0])
                      + [row for rows in measured.values() for row in rows])
        return 0
    changed = [line for sample, rows in measured.items() for line in differences(sample, rows)]
    if changed:
        print("\n".join(changed))
        print("If the change is wanted, write the rows anew: tests/results/write_results.sh")
        return 1
    return 0 if measured else SKIPPED


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
