"""A.4: base edges, images of cells, and the neighbours of a cell."""

from functools import cache

from answers import Broken


def check_corners(triangles, vertex_count):
    """Every corner names a vertex, no triangle names one twice, no vertex is left over."""
    seen = set()
    for triangle in triangles:
        if len(set(triangle)) != 3 or not all(0 <= v < vertex_count for v in triangle):
            raise Broken(f"base: {triangle} is no triangle of {vertex_count} vertices")
        seen.update(triangle)
    if len(seen) != vertex_count:
        raise Broken("base: a vertex belongs to no triangle")


class EdgeForest:
    """The base edges in order of first appearance.

    vertices[e]    the vertices that edge e runs from and to in its side 0
    side0, side1   (face, local edge) of either side; side1 is None on a boundary
    face_edges[f]  the edges of face f by local edge
    """

    def __init__(self, triangles, vertex_count):
        check_corners(triangles, vertex_count)
        self.triangles = triangles
        self.vertex_count = vertex_count
        self.vertices = []
        self.side0 = []
        self.side1 = []
        self.face_edges = []
        self._number_edges()
        self._check_fans()

    def _number_edges(self):
        number = {}
        for face, triangle in enumerate(self.triangles):
            edges = []
            for local in range(3):
                start, end = triangle[local], triangle[(local + 1) % 3]
                if (start, end) in number:
                    raise Broken(f"base: two triangles run from vertex {start} to {end}")
                edge = number.get((end, start))
                if edge is None:
                    edge = len(self.vertices)
                    self.vertices.append((start, end))
                    self.side0.append((face, local))
                    self.side1.append(None)
                else:
                    self.side1[edge] = (face, local)
                number[start, end] = edge
                edges.append(edge)
            self.face_edges.append(tuple(edges))

    def _check_fans(self):
        """The triangles at a vertex form one fan (A.13, rule 5)."""
        after = [{} for _ in range(self.vertex_count)]
        for a, b, c in self.triangles:
            after[a][b], after[b][c], after[c][a] = c, a, b
        for vertex, turn in enumerate(after):
            starts = set(turn) - set(turn.values())
            spoke = first = starts.pop() if starts else next(iter(turn))
            met = 0
            while spoke in turn and (met == 0 or spoke != first):
                spoke = turn[spoke]
                met += 1
            if met != len(turn):
                raise Broken(f"base: vertex {vertex} is in more than one fan of triangles")

    def is_boundary(self, edge):
        return self.side1[edge] is None

    def face_neighbours(self, level, cell):
        """The cells of the other edges of the cell's triangles, one entry per triangle and edge."""
        edge, morton = cell >> 2 * level, cell & ((1 << 2 * level) - 1)
        neighbours = []
        for side, turn, if_side0, otherwise in face_pattern(level, morton):
            here = self.side1[edge] if side else self.side0[edge]
            if here is None:
                continue
            face, local = here
            other = self.face_edges[face][(local + turn) % 3]
            place = if_side0 if self.side0[other][0] == face else otherwise
            neighbours.append(other << 2 * level | place)
        return neighbours

    def ring_neighbours(self, level, cell):
        """(neighbours, those of them that are collinear) in the image of the cell."""
        first = cell >> 2 * level << 2 * level
        ring, collinear = ring_pattern(level, cell - first)
        return [first + place for place in ring], [first + place for place in collinear]


def spread(number):
    """The bits of `number` at the even places."""
    result = 0
    for k in range(number.bit_length()):
        result |= (number >> k & 1) << 2 * k
    return result


def gather(number):
    """The bits at the even places of `number`, the opposite of `spread`."""
    result = 0
    for k in range((number.bit_length() + 1) // 2):
        result |= (number >> 2 * k & 1) << k
    return result


def morton_of(p, q):
    return 2 * spread(p) + spread(q)


@cache
def ring_pattern(level, morton):
    """The ring neighbours, as morton numbers, and the collinear ones among them."""
    n = 1 << level
    p, q = gather(morton >> 1), gather(morton)
    ring, collinear = [], []
    for dp in (-1, 0, 1):
        for dq in (-1, 0, 1):
            if (dp or dq) and 0 <= p + dp < n and 0 <= q + dq < n:
                place = morton_of(p + dp, q + dq)
                ring.append(place)
                if dp == dq:
                    collinear.append(place)
    return tuple(ring), tuple(collinear)


@cache
def face_pattern(level, morton):
    """Tuples (side S, j, morton if the other edge's side 0 is S, morton otherwise)."""
    n = 1 << level
    p, q = gather(morton >> 1), gather(morton)
    row = abs(p - q)
    pattern = []
    for side in (0, 1):
        if p < q and side == 0 or p > q and side == 1:
            continue
        place = n - 1 - row - min(p, q) if side else min(p, q)
        rest = n - 1 - row - place
        corners = [((rest, place, row), 0)]
        if row > 0:
            corners.append(((rest, place, row - 1), 1))
        for t, d in corners:
            for j in (1, 2):
                other_row, other_place = t[(j + 2) % 3] + d, t[(j + 1) % 3]
                back = n - 1 - other_row - other_place
                pattern.append((side, j, morton_of(other_place + other_row, other_place),
                                morton_of(back, back + other_row)))
    return tuple(pattern)
