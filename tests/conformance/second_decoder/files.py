"""Reading streams and bases, and the JSON form of a result."""

import json
import math

from float32 import shortest, to_f32


class FileProblem(Exception):
    """A file cannot be used; the message is one line for the user."""


def read_bytes(path):
    try:
        with open(path, "rb") as file:
            return file.read()
    except OSError as error:
        raise FileProblem(f"{path}: cannot be read ({error.strerror}); check the path") from None


def read_json(path):
    try:
        return json.loads(read_bytes(path).decode("utf-8"))
    except UnicodeDecodeError:
        raise FileProblem(f"{path}: is not UTF-8 text; give a JSON file") from None
    except json.JSONDecodeError as error:
        raise FileProblem(f"{path}: line {error.lineno}, column {error.colno}: {error.msg}; "
                          "give a JSON file") from None


def read_base(path):
    """(positions, triangles) of a .base.json file, the coordinates as f32."""
    content = read_json(path)
    try:
        positions = [tuple(to_f32(float(x)) for x in point) for point in content["positions"]]
        triangles = [tuple(triangle) for triangle in content["triangles"]]
    except (KeyError, TypeError, ValueError):
        raise FileProblem(f'{path}: a base needs "positions" and "triangles", each a list of '
                          "three numbers; correct the file") from None
    check_entries(path, "positions", positions, lambda x: math.isfinite(x))
    check_entries(path, "triangles", triangles, lambda v: isinstance(v, int) and v >= 0)
    return positions, triangles


def check_entries(path, name, entries, allowed):
    for number, entry in enumerate(entries):
        if len(entry) != 3 or not all(map(allowed, entry)):
            raise FileProblem(f"{path}: {name}[{number}]: three numbers are needed, not "
                              f"{list(entry)}; correct the file")


def result_as_json(decoded, positions, normals):
    """The result as a JSON object, in the form of the conformance folder."""
    base = None
    if decoded.forest is not None:
        base = {"positions": [[shortest(x) for x in p] for p in decoded.positions],
                "triangles": [list(t) for t in decoded.forest.triangles],
                "creases": decoded.creases, "corners": decoded.corners}
    details = [dict(zip(("normal", "tangent1", "tangent2"), values))
               for values in decoded.details]
    return {"status": decoded.status, "base": base, "details": details,
            "positions": positions, "normals": normals}
