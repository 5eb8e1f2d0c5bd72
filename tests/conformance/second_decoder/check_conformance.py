#!/usr/bin/env python3
"""Decode every stream of a conformance folder and compare with what is expected."""

import argparse
import math
import os
import sys
import time

from answers import Broken
from decoder import decode
from files import FileProblem, read_base, read_bytes, read_json
from float32 import to_f32
from surface import SurfaceLevels, reconstruct

POSITION_TOLERANCE = 1e-5
F32_ROUNDING = 2.0**-20
NORMAL_TOLERANCE = 1e-3
CHANNELS = ("normal", "tangent1", "tangent2")


class Worst:
    """The largest differences met, relative to the diagonal (positions) or absolute (normals)."""

    def __init__(self):
        self.position = 0.0
        self.normal = 0.0
        self.normals_compared = 0
        self.normals_open = 0

    def include(self, other):
        self.position = max(self.position, other.position)
        self.normal = max(self.normal, other.normal)
        self.normals_compared += other.normals_compared
        self.normals_open += other.normals_open


def diagonal(points):
    return math.dist([min(axis) for axis in zip(*points)], [max(axis) for axis in zip(*points)])


def compare_base(decoded, expected):
    """Complaints about the base mesh and its tags."""
    if (decoded.forest is None) != (expected is None):
        return [f"base is {'absent' if decoded.forest is None else 'there'}, expected otherwise"]
    if expected is None:
        return []
    complaints = []
    points = [tuple(map(to_f32, p)) for p in expected["positions"]]
    if len(points) != len(decoded.positions):
        complaints.append(f"{len(decoded.positions)} base vertices, expected {len(points)}")
    elif points != decoded.positions:
        wrong = [v for v, pair in enumerate(zip(points, decoded.positions)) if pair[0] != pair[1]]
        complaints.append(f"base positions: {len(wrong)} differ, first at vertex {wrong[0]}: "
                          f"{decoded.positions[wrong[0]]}, expected {points[wrong[0]]}")
    if [tuple(t) for t in expected["triangles"]] != [tuple(t) for t in decoded.forest.triangles]:
        complaints.append("base triangles differ")
    for name, ours in ("creases", decoded.creases), ("corners", decoded.corners):
        if set(expected[name]) != set(ours):
            complaints.append(f"{name}: {sorted(ours)}, expected {sorted(expected[name])}")
    return complaints


def compare_details(decoded, expected):
    ours = decoded.details if decoded.forest is not None else []
    if len(ours) != len(expected):
        return [f"{len(ours)} levels of details, expected {len(expected)}"]
    complaints = []
    for level, (values, wanted) in enumerate(zip(ours, expected)):
        for channel, mine in zip(CHANNELS, values):
            theirs = wanted[channel]
            longest = range(max(len(mine), len(theirs)))
            wrong = [i for i in longest if mine[i:i + 1] != theirs[i:i + 1]]
            if wrong:
                i = wrong[0]
                complaints.append(f"details: level {level}, {channel}: {len(wrong)} differ, first "
                                  f"at cell {i}: {mine[i:i + 1]}, expected {theirs[i:i + 1]}")
    return complaints


def compare_surface(decoded, expected, levels_cache, worst):
    """Complaints about positions and normals."""
    wanted = expected["positions"]
    if wanted is None or decoded.forest is None:
        return [] if wanted is None and decoded.forest is None else ["positions: one side has none"]
    normals = expected.get("normals")
    positions, our_normals = reconstruct(decoded, levels_cache, normals is not None)
    if len(positions) != len(wanted):
        return [f"{len(positions)} positions, expected {len(wanted)}"]
    complaints = compare_positions(positions, [tuple(map(to_f32, p)) for p in wanted], worst)
    if normals is not None:
        complaints += compare_normals(our_normals, normals, worst)
    return complaints


def compare_positions(positions, wanted, worst):
    """Against the tolerance, and the rounding of an f32 where the coordinates are large."""
    size = diagonal(wanted)
    rounding = max(abs(x) for point in wanted for x in point) * F32_ROUNDING
    allowed = POSITION_TOLERANCE * size + rounding
    errors = [math.dist(a, b) for a, b in zip(positions, wanted)]
    if size > rounding:
        worst.position = max(worst.position, max(errors) / size)
    bad = [v for v, error in enumerate(errors) if not error <= allowed]
    if not bad:
        return []
    return [f"positions: {len(bad)} of {len(errors)} differ, first at vertex {bad[0]}, "
            f"at most by {max(errors):.2g}, allowed {allowed:.2g}"]


def compare_normals(ours, wanted, worst):
    if len(ours) != len(wanted):
        return [f"{len(ours)} normals, expected {len(wanted)}"]
    bad = []
    for vertex, (mine, theirs) in enumerate(zip(ours, wanted)):
        if mine is None or theirs is None:
            worst.normals_open += theirs is not None
            continue
        error = math.dist(mine, theirs)
        worst.normals_compared += 1
        worst.normal = max(worst.normal, error)
        if not error <= NORMAL_TOLERANCE:
            bad.append(vertex)
    return [f"normals: {len(bad)} differ, first at vertex {bad[0]}"] if bad else []


class Folder:
    """A conformance folder."""

    def __init__(self, path):
        self.path = path
        self.index = read_json(os.path.join(path, "index.json"))
        if not isinstance(self.index, dict) or not self.index.get("streams"):
            raise FileProblem(f"{path}/index.json: lists no streams; give a conformance folder")

    def place(self, name):
        return os.path.join(self.path, name)

    def base_of(self, entry):
        return read_base(self.place(entry["base"])) if entry["base"] else None

    def check_stream(self, entry, worst):
        """Complaints about all prefixes of one stream."""
        data = read_bytes(self.place(entry["file"]))
        base = self.base_of(entry)
        cache = SurfaceLevels()
        complaints = [] if entry["prefixes"] else ["lists no prefixes"]
        for prefix in entry["prefixes"]:
            size = prefix["byteLength"]
            expected = read_json(self.place(prefix["expected"]))
            try:
                decoded = decode(data[:size], base, entry["levels"])
                found = compare_prefix(decoded, expected, cache, worst)
            except Broken as complaint:
                found = [f"called broken: {complaint}"]
            complaints += [f"{size} bytes: {text}" for text in found]
        return complaints

    def check_broken(self, entry):
        """(complaints, what the decoder said) about one broken stream."""
        data = read_bytes(self.place(entry["file"]))
        try:
            decoded = decode(data, self.base_of(entry), entry["levels"])
        except Broken as complaint:
            return [], str(complaint)
        except FileProblem as complaint:
            return [], str(complaint)
        return [f"answered \"{decoded.status}\" instead of broken"], ""


def compare_prefix(decoded, expected, cache, worst):
    complaints = []
    if decoded.status != expected["status"]:
        complaints.append(f"status is {decoded.status}, expected {expected['status']}")
    complaints += compare_base(decoded, expected["base"])
    complaints += compare_details(decoded, expected["details"])
    return complaints + compare_surface(decoded, expected, cache, worst)


def report(name, complaints, text):
    print(f"{'agrees   ' if not complaints else 'DISAGREES'}  {name}: {text}")
    for complaint in complaints:
        print(f"    {complaint}")


def check_all(folder, names):
    """The number of streams and broken entries that disagree."""
    def wanted(kind):
        entries = folder.index.get(kind, [])
        return [entry for entry in entries if not names or entry["name"] in names]

    streams, broken = wanted("streams"), wanted("broken")
    known = {entry["name"] for entry in streams + broken}
    for name in names:
        if name not in known:
            raise FileProblem(f"{folder.path}/index.json: lists no {name}; see the names there")
    total, bad, prefixes = Worst(), 0, 0
    for entry in streams:
        worst, start = Worst(), time.monotonic()
        complaints = folder.check_stream(entry, worst)
        prefixes += len(entry["prefixes"])
        report(entry["name"], complaints, f"{len(entry['prefixes'])} prefixes, positions within "
               f"{worst.position:.1e}, {worst.normals_compared} normals within {worst.normal:.1e}, "
               f"{time.monotonic() - start:.1f} s")
        total.include(worst)
        bad += bool(complaints)
    for entry in broken:
        complaints, said = folder.check_broken(entry)
        report(entry["name"], complaints, f"broken ({entry['rule']}): {said}")
        bad += bool(complaints)
    print(f"{len(streams)} streams, {prefixes} prefixes, {len(broken)} broken streams: "
          f"{bad} disagree; worst position error {total.position:.2e} of the diagonal, "
          f"{total.normals_compared} normals, worst error {total.normal:.1e}, "
          f"{total.normals_open} more where tangents vanish")
    return bad


def main(arguments):
    parser = argparse.ArgumentParser(
        description="Decode every prefix of every stream that CONFORMANCE_FOLDER/index.json lists "
                    "and compare with what is expected; every broken stream must be called broken.",
        epilog="The exit code is 0 if everything agrees, else 1.")
    parser.add_argument("folder", metavar="CONFORMANCE_FOLDER")
    parser.add_argument("names", metavar="NAME", nargs="*",
                        help="check these streams and broken streams only (default: all)")
    options = parser.parse_args(arguments)
    try:
        return 1 if check_all(Folder(options.folder), options.names) else 0
    except FileProblem as problem:
        print(problem, file=sys.stderr)
    except (KeyError, TypeError) as error:
        print(f"{options.folder}: an entry of the index or an expected result lacks {error}; "
              "make the folder anew", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
