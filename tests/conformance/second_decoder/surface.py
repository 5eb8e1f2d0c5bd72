"""B.1: the limit surface at the finest level from what was decoded."""

import filter_local
import filter_quadrature_mirror
from local_frames import Dequantisation
from limit_normals import limit_normals
from loop_scheme import limit_positions, subdivide
from surface_levels import base_level

FILTERS = {0: filter_quadrature_mirror, 1: filter_local}


class SurfaceLevels:
    """Builds level 0 of a base, and keeps the last one: prefixes of a stream share it."""

    def __init__(self):
        self.key = None
        self.base = None

    def of(self, decoded):
        key = (decoded.forest.triangles, decoded.creases, decoded.corners)
        if key != self.key:
            self.key = key
            self.base = base_level(decoded.forest, decoded.creases, decoded.corners)
        return self.base


def finest_points(decoded, level):
    """(finest level, its control points p^J), by equation (1)."""
    points = decoded.positions
    header = decoded.header
    lengths = Dequantisation(header, decoded.forest.triangles, points) if header else None
    for number in range(decoded.levels):
        refined = subdivide(level, points)
        if lengths:
            moves = lengths.moves(level, number, refined, decoded.details[number])
            refined = FILTERS[header.transform].apply_details(level, points, refined, moves)
        points, level = refined, level.next
    return level, points


def reconstruct(decoded, levels_cache=None, with_normals=False):
    """(limit positions, limit normals or None) at level J; the base must be there."""
    base = (levels_cache or SurfaceLevels()).of(decoded)
    level, points = finest_points(decoded, base)
    normals = limit_normals(level, points) if with_normals else None
    return limit_positions(level, points), normals
