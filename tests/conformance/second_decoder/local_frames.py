"""B.5 and B.6: a detail's move as a vector."""

import math
from itertools import chain

from vectors import cross, minus, normalised, plus, square, weighted_sum

ROUNDING = 2.0**-44  # of the coordinates: vectors as short as this are rounding errors


class Dequantisation:
    """Lengths of details: what the header says and the mean area of the base triangles."""

    def __init__(self, header, triangles, positions):
        self.finest_step = header.finest_step
        self.tangent_ratio = 2.0**header.tangent_ratio_log2
        self.levels = header.levels
        areas = [flat_area(*(positions[v] for v in triangle)) for triangle in triangles]
        self.base_area = sum(areas) / len(areas)

    def moves(self, level, number, refined, values):
        """{edge: move} of the edges of level `number` whose detail is not zero.

        `refined` are the points P p^j, `values` the integers of the three channels.
        """
        normals, tangents1, tangents2 = values
        moves = {}
        for edge, cell in enumerate(level.cells):
            detail = normals[cell], tangents1[cell], tangents2[cell]
            if any(detail):
                moves[edge] = self._move(level, number, refined, edge, detail)
        return moves

    def _move(self, level, number, refined, edge, detail):
        along, across = directions(level, refined, edge)
        product = math.sqrt(square(cross(along, across)))
        area = product / (2 if level.boundary[edge] else 12)
        weight = area_weight(area, self.base_area / 4**number)
        unit = self.finest_step / (2 * 2.0**(self.levels - 1 - number) * weight)
        normal, tangent1, tangent2 = frame(along, across)
        return weighted_sum([(detail[0] * unit, normal),
                             (detail[1] * unit * self.tangent_ratio, tangent1),
                             (detail[2] * unit * self.tangent_ratio, tangent2)])


def flat_area(a, b, c):
    return math.sqrt(square(cross(minus(b, a), minus(c, a)))) / 2


def area_weight(area, usual):
    """w of B.6."""
    if math.isnan(area) or math.isnan(usual) or area == usual and usual in (0, math.inf):
        return 1.0
    if usual == 0:
        return 16.0
    return min(math.sqrt(0.8 * area / usual + 0.2), 16.0)


def directions(level, refined, edge):
    """(along, across) of an edge."""
    a, b = level.direction[edge]
    x_a, x_b = refined[a], refined[b]
    if level.boundary[edge]:
        x_la, x_lb = side_points(level, refined, level.left[edge], True)
        along = minus(x_b, x_a)
        across = plus(minus(x_la, x_a), minus(x_lb, x_b))
        return without_rounding((along, across), (x_a, x_b, x_la, x_lb))
    x_la, x_lb = side_points(level, refined, level.left[edge], True)
    x_ra, x_rb = side_points(level, refined, level.right[edge], False)
    along = weighted_sum([(2, x_b), (-2, x_a), (1, x_lb), (-1, x_la), (1, x_rb), (-1, x_ra)])
    across = plus(minus(x_la, x_ra), minus(x_lb, x_rb))
    return without_rounding((along, across), (x_a, x_b, x_la, x_lb, x_ra, x_rb))


def without_rounding(vectors, points):
    """The vectors, and zero in place of those that are only rounding errors of the points.

    The formulas are meant in exact arithmetic, where such vectors vanish; next to a vertex of
    valence 2 they often do.
    """
    noise = ROUNDING * max(map(abs, chain(*points)))
    return [(0.0, 0.0, 0.0) if max(map(abs, v)) <= noise else v for v in vectors]


def side_points(level, refined, side, is_left):
    """The odd vertices of the two other edges of a triangle, at a and at b."""
    after, before = level.side_edges(side)
    at_a, at_b = (before, after) if is_left else (after, before)
    return refined[level.vertex_count + at_a], refined[level.vertex_count + at_b]


def in_range(number):
    return 1e-60 < number < 1e200


def frame(along, across):
    """(normal, tangent1, tangent2)."""
    tangent1 = normalised(along) if in_range(square(along)) else (1.0, 0.0, 0.0)
    size = square(across)
    if not in_range(size) or not square(cross(tangent1, across)) > 1e-12 * size:
        axis = min(range(3), key=lambda k: abs(tangent1[k]))
        across = tuple(float(k == axis) for k in range(3))
    normal = normalised(cross(tangent1, across))
    return normal, tangent1, cross(normal, tangent1)
