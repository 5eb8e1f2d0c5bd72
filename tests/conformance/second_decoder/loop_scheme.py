"""B.3 and B.7: Loop subdivision and limit positions."""

import math
from functools import cache

from vectors import weighted_sum


@cache
def neighbour_weight(n):
    """b(n) of B.3."""
    return (5 / 8 - (3 / 8 + math.cos(2 * math.pi / n) / 4) ** 2) / n


def subdivide(level, points):
    """P applied to the control points of a level."""
    even = [even_point(level, points, v) for v in range(level.vertex_count)]
    return even + [odd_point(level, points, e) for e in range(len(level.ends))]


def even_point(level, points, vertex):
    if level.is_corner[vertex]:
        return points[vertex]
    if level.is_smooth(vertex):
        fan = level.fans[vertex]
        return around_vertex(points, vertex, fan, neighbour_weight(len(fan.neighbours)))
    return along_curve(level, points, vertex, 1 / 8)


def odd_point(level, points, edge):
    (ax, ay, az), (bx, by, bz) = (points[v] for v in level.ends[edge])
    if level.sharp[edge]:
        return (ax + bx) / 2, (ay + by) / 2, (az + bz) / 2
    cx, cy, cz = points[level.opposite(level.left[edge])]
    dx, dy, dz = points[level.opposite(level.right[edge])]
    return ((3 * (ax + bx) + cx + dx) / 8, (3 * (ay + by) + cy + dy) / 8,
            (3 * (az + bz) + cz + dz) / 8)


def around_vertex(points, vertex, fan, weight):
    """1 - n * weight of the vertex, weight of each neighbour."""
    x = y = z = 0.0
    for neighbour in fan.neighbours:
        a, b, c = points[neighbour]
        x += a
        y += b
        z += c
    rest = 1 - len(fan.neighbours) * weight
    a, b, c = points[vertex]
    return rest * a + weight * x, rest * b + weight * y, rest * c + weight * z


def along_curve(level, points, vertex, weight):
    """1 - 2 * weight of the vertex, weight of its neighbours along the curve."""
    before, after = level.curve_neighbours(vertex)
    return weighted_sum([(1 - 2 * weight, points[vertex]), (weight, points[before]),
                         (weight, points[after])])


def limit_positions(level, points):
    return [limit_position(level, points, v) for v in range(level.vertex_count)]


def limit_position(level, points, vertex):
    if level.is_corner[vertex]:
        return points[vertex]
    if level.is_smooth(vertex):
        fan = level.fans[vertex]
        n = len(fan.neighbours)
        return around_vertex(points, vertex, fan, 1 / (3 / (8 * neighbour_weight(n)) + n))
    return along_curve(level, points, vertex, 1 / 6)
