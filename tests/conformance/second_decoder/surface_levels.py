"""B.2: the triangles, edges and fans of a level and of the next one."""

from dataclasses import dataclass
from functools import cached_property


@dataclass(frozen=True)
class Fan:
    """The edges at a vertex, counter-clockwise, and their other ends.

    On a boundary the first and the last edge are boundary edges; else the fan is a cycle.
    """

    edges: tuple
    neighbours: tuple
    closed: bool


class SurfaceLevel:
    """One level of the subdivided base mesh.

    triangles[f]        three vertices
    triangle_edges[f]   the edges by local edge
    ends[e]             (end 0, end 1), for the numbering of the next level
    direction[e]        (a, b): the edge runs from a to b like the base edge it descends from
    cells[e]            index of the edge's cell in the details of this level (A.4)
    crease[e], corner   tagged edges (or halves of tagged edges); the set of tagged vertices
    left[e], right[e]   (face, local edge) of the triangle on that side, or None
    """

    def __init__(self, vertex_count, triangles, triangle_edges, ends, direction, cells, crease,
                 corner_tags):
        self.vertex_count = vertex_count
        self.triangles = triangles
        self.triangle_edges = triangle_edges
        self.ends = ends
        self.direction = direction
        self.cells = cells
        self.crease = crease
        self.corner_tags = corner_tags
        self._find_sides()
        self.boundary = [left is None or right is None
                         for left, right in zip(self.left, self.right)]
        self.sharp = [a or b for a, b in zip(self.boundary, self.crease)]
        self._find_fans()
        self._find_rules()

    def _find_sides(self):
        self.left = [None] * len(self.ends)
        self.right = [None] * len(self.ends)
        for face, (corners, edges) in enumerate(zip(self.triangles, self.triangle_edges)):
            for local in range(3):
                edge = edges[local]
                forward = corners[local] == self.direction[edge][0]
                (self.left if forward else self.right)[edge] = (face, local)

    def _find_fans(self):
        after = [{} for _ in range(self.vertex_count)]
        for corners, edges in zip(self.triangles, self.triangle_edges):
            for k in range(3):
                after[corners[k]][edges[k]] = edges[k - 1]
        self.fans = [self._fan(vertex, turn) for vertex, turn in enumerate(after)]

    def _fan(self, vertex, turn):
        starts = set(turn) - set(turn.values())
        closed = not starts
        first = next(iter(turn if closed else starts))
        edges = [first]
        while (edge := turn.get(edges[-1])) is not None and edge != first:
            edges.append(edge)
        return Fan(tuple(edges), tuple(self.other_end(e, vertex) for e in edges),
                   closed)

    def _find_rules(self):
        """Per vertex: is it a corner, and the sharp edges at it (B.3)."""
        self.sharp_edges = [tuple(e for e in fan.edges if self.sharp[e]) for fan in self.fans]
        self.is_corner = [vertex in self.corner_tags or len(sharp) > 2
                          or not fan.closed and len(fan.edges) == 2
                          for vertex, (fan, sharp) in enumerate(zip(self.fans, self.sharp_edges))]

    def other_end(self, edge, vertex):
        a, b = self.ends[edge]
        return b if a == vertex else a

    def is_smooth(self, vertex):
        """Interior with fewer than two sharp edges (smooth, dart), and no corner."""
        return (self.fans[vertex].closed and len(self.sharp_edges[vertex]) < 2
                and not self.is_corner[vertex])

    def curve_neighbours(self, vertex):
        """The two neighbours along the boundary or crease through the vertex."""
        first, last = self.sharp_edges[vertex]
        return self.other_end(first, vertex), self.other_end(last, vertex)

    def opposite(self, side):
        """The vertex opposite the edge in a triangle given as left or right."""
        face, local = side
        return self.triangles[face][(local + 2) % 3]

    def side_edges(self, side):
        """The next and the previous local edge of a triangle given as left or right."""
        face, local = side
        edges = self.triangle_edges[face]
        return edges[(local + 1) % 3], edges[(local + 2) % 3]

    @cached_property
    def next(self):
        """The level that quadrisection makes of this one."""
        return Quadrisection(self).next_level()


class Quadrisection:
    """Makes a level of the level before it."""

    def __init__(self, level):
        self.level = level
        faces, edges = len(level.triangles), len(level.ends)
        self.first_half = 3 * faces
        count = 3 * faces + 2 * edges
        self.ends = [None] * count
        self.direction = [None] * count
        self.cells = [0] * count
        self.crease = [False] * count

    def odd(self, edge):
        return self.level.vertex_count + edge

    def half(self, edge, vertex):
        """The half of an edge at one of its ends."""
        return self.first_half + 2 * edge + (0 if self.level.ends[edge][0] == vertex else 1)

    def next_level(self):
        level = self.level
        for edge in range(len(level.ends)):
            self._split(edge)
        triangles, triangle_edges = [], []
        for face in range(len(level.triangles)):
            corners, edges = self._children(face)
            triangles += corners
            triangle_edges += edges
        return SurfaceLevel(level.vertex_count + len(level.ends), triangles, triangle_edges,
                            self.ends, self.direction, self.cells, self.crease, level.corner_tags)

    def _split(self, edge):
        """The children of an edge: two halves and the parallel inner edge of each triangle."""
        level, middle = self.level, self.odd(edge)
        tail, head = level.direction[edge]
        cell = 4 * level.cells[edge]
        for vertex, place in (tail, 0), (head, 3):
            half = self.half(edge, vertex)
            self.ends[half] = (middle, vertex)
            self.direction[half] = (tail, middle) if vertex == tail else (middle, head)
            self.cells[half] = cell + place
            self.crease[half] = level.crease[edge]
        for side, place in (level.left[edge], 2), (level.right[edge], 1):
            if side is not None:
                face, local = side
                inner = 3 * face + (local + 2) % 3
                near_head, near_tail = map(self.odd, level.side_edges(side))
                self.ends[inner] = (near_tail, near_head)
                if place == 1:
                    near_head, near_tail = near_tail, near_head
                self.direction[inner] = (near_tail, near_head)
                self.cells[inner] = cell + place

    def _children(self, face):
        v0, v1, v2 = self.level.triangles[face]
        e0, e1, e2 = self.level.triangle_edges[face]
        o0, o1, o2 = self.odd(e0), self.odd(e1), self.odd(e2)
        i0, i1, i2 = 3 * face, 3 * face + 1, 3 * face + 2
        half = self.half
        corners = [(v0, o0, o2), (o0, v1, o1), (o2, o1, v2), (o1, o2, o0)]
        edges = [(half(e0, v0), i0, half(e2, v0)),
                 (half(e0, v1), half(e1, v1), i1),
                 (i2, half(e1, v2), half(e2, v2)),
                 (i2, i0, i1)]
        return corners, edges


def base_level(forest, creases, corners):
    """Level 0 of a base mesh with its sharp tags."""
    edge_count = len(forest.vertices)
    crease = [False] * edge_count
    for edge in creases:
        crease[edge] = True
    return SurfaceLevel(forest.vertex_count, forest.triangles, forest.face_edges, forest.vertices,
                        forest.vertices, list(range(edge_count)), crease, set(corners))
