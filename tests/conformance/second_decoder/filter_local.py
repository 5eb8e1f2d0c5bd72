"""B.4.2, transform 1: the local filter."""

from loop_scheme import subdivide
from vectors import minus, plus_scaled


def apply_details(level, points, refined, moves):
    """P (p - lift), then the dips and the details; `moves` are the details as vectors by edge."""
    if not moves:
        return refined
    lift, dip = {}, {}
    zero = (0.0, 0.0, 0.0)
    for edge, move in moves.items():
        for vertex in level.ends[edge]:
            dip_weight, lift_weight = weights(level, edge, vertex)
            if lift_weight:
                lift[vertex] = plus_scaled(lift.get(vertex, zero), lift_weight, move)
                dip[vertex] = plus_scaled(dip.get(vertex, zero), dip_weight, move)
    lowered = list(points)
    for vertex, vector in lift.items():
        lowered[vertex] = minus(points[vertex], vector)
    result = subdivide(level, lowered)
    for vertex, vector in dip.items():
        result[vertex] = minus(result[vertex], vector)
    for edge, move in moves.items():
        odd = level.vertex_count + edge
        result[odd] = plus_scaled(result[odd], 1, move)
    return result


def weights(level, edge, vertex):
    """(dip D, lift L) of an edge at one of its ends."""
    if level.is_corner[vertex]:
        return 0, 0
    if level.is_smooth(vertex):
        valence = len(level.fans[vertex].edges)
        return 0.30 * 6 / valence, 0.05 * 6 / valence
    return (0.30, 0.10) if level.sharp[edge] else (0, 0)
