"""A.6.1: crease edges and corner vertices."""

from answers import Broken
from range_decoder import contexts


def situation(crease_edges, edges_left):
    if crease_edges == 0:
        return 0
    if crease_edges > 1:
        return 2
    if edges_left > 3:
        return 1
    return 4 if edges_left == 1 else 3


def decode_sharp_tags(decoder, forest):
    """(crease edges, corner vertices) as lists of numbers."""
    crease = contexts(5, 5)
    corner = contexts(5)
    at = [0] * forest.vertex_count
    left = [0] * forest.vertex_count
    interior = [e for e in range(len(forest.vertices)) if not forest.is_boundary(e)]
    for edge in interior:
        for v in forest.vertices[edge]:
            left[v] += 1
    creases = []
    for edge in interior:
        a, b = forest.vertices[edge]
        low, high = sorted((situation(at[a], left[a]), situation(at[b], left[b])))
        if decoder.bit(crease[low][high]):
            creases.append(edge)
            at[a] += 1
            at[b] += 1
        left[a] -= 1
        left[b] -= 1
    corners = [v for v in range(forest.vertex_count) if decoder.bit(corner[min(at[v], 4)])]
    if not creases and not corners:
        raise Broken("sharp tags: announced by the header, but there is none")
    return creases, corners
