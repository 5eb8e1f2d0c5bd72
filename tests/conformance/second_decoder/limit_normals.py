"""B.8: normals of the limit surface."""

import math

from vectors import cross, length, normalised, plus, weighted_sum

VANISHING = 1e-9  # of the coordinates: tangents as short as this are taken for rounding


def limit_normals(level, points):
    """One normal per vertex; None where the tangents vanish."""
    return [limit_normal(level, points, v) for v in range(level.vertex_count)]


def limit_normal(level, points, vertex):
    fan = level.fans[vertex]
    ring = [points[q] for q in fan.neighbours]
    centre = points[vertex]
    reach = max(abs(x) for point in (centre, *ring) for x in point)
    shortest = VANISHING * reach
    if not fan.closed:
        return unit(sector_product(centre, ring, shortest))
    if level.is_corner[vertex] or level.is_smooth(vertex):
        return unit(product(*interior_tangents(ring), shortest))
    return unit(crease_product(level, vertex, centre, ring, shortest))


def unit(vector):
    return normalised(vector) if vector and any(vector) else None


def product(t1, t2, shortest):
    """t1 x t2, or None where it vanishes."""
    vector = cross(t1, t2)
    if min(length(t1), length(t2)) <= shortest or length(vector) <= shortest * length(t1):
        return None
    return vector


def interior_tangents(ring):
    """(t1, t2) of a smooth vertex."""
    angles = [2 * math.pi * k / len(ring) for k in range(len(ring))]
    return (weighted_sum((math.cos(a), q) for a, q in zip(angles, ring)),
            weighted_sum((math.sin(a), q) for a, q in zip(angles, ring)))


def crease_product(level, vertex, centre, ring, shortest):
    """The sum over the two sectors of an interior crease vertex."""
    edges = level.fans[vertex].edges
    first, last = (k for k, edge in enumerate(edges) if level.sharp[edge])
    one = sector_product(centre, ring[first:last + 1], shortest)
    other = sector_product(centre, ring[last:] + ring[:first + 1], shortest)
    return plus(one, other) if one and other else None


def sector_product(centre, ring, shortest):
    """t1 x t2 of a sector, whose neighbours `ring` run from one sharp edge to the next."""
    along = weighted_sum([(1, ring[0]), (-1, ring[-1])])
    return product(along, inward_tangent(centre, ring), shortest)


def inward_tangent(centre, ring):
    m = len(ring) - 2
    if m == 0:
        return weighted_sum([(1, ring[0]), (1, ring[1]), (-2, centre)])
    if m == 1:
        return weighted_sum([(1, ring[1]), (-1, centre)])
    if m == 2:
        factor = 1 / math.sqrt(3)
        return weighted_sum([(factor, ring[1]), (factor, ring[2]), (-factor, centre),
                             (-factor / 2, ring[0]), (-factor / 2, ring[3])])
    h = math.pi / (m + 1)
    terms = [(2 * (1 - math.cos(h)) * math.sin(k * h), ring[k]) for k in range(1, m + 1)]
    return weighted_sum(terms + [(-math.sin(h), ring[0]), (-math.sin(h), ring[-1])])
