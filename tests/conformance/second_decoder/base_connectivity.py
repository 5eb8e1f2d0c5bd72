"""A.10 to A.13: the triangles of an embedded base, grown from gate to gate."""

from dataclasses import dataclass

from answers import Broken
from range_decoder import contexts


@dataclass(eq=False)
class Node:
    """A place on the border of the region; nodes are compared by identity."""

    vertex: int
    previous: "Node" = None
    next: "Node" = None
    alive: bool = True
    open: bool = True


def link(first, second):
    first.next = second
    second.previous = first


class RegionGrowing:
    """The state of A.11 and the steps of A.12."""

    def __init__(self, decoder, vertex_count, face_count):
        self.decoder = decoder
        self.vertex_count = vertex_count
        self.face_count = face_count
        self.triangles = []
        self.degree = []
        self.nodes = []
        self.queue = [[] for _ in range(16)]
        self.focus = None
        self.left = contexts(9, 3)
        self.last = contexts(2)
        self.fresh = contexts(3)
        self.right = contexts(3)
        self.boundary = contexts(4)
        self.near = contexts()
        self.backward = contexts()
        self.distance = contexts(8)

    def run(self):
        self.has_boundary = self.decoder.raw()
        while len(self.triangles) < self.face_count:
            self.seed()
            while len(self.triangles) < self.face_count:
                gate = self.next_gate()
                if gate is None:
                    break
                self.act(gate)
        if len(self.degree) != self.vertex_count:
            raise Broken("triangles: fewer vertices than the header says")
        return self.triangles

    def new_vertex(self):
        self.degree.append(0)
        return len(self.degree) - 1

    def new_node(self, vertex):
        node = Node(vertex)
        self.nodes.append(node)
        return node

    def bucket(self, node):
        return min(self.degree[node.vertex], 15)

    def push(self, *nodes):
        for node in nodes:
            self.queue[self.bucket(node)].append(node)

    def seed(self):
        if self.vertex_count - len(self.degree) < 3:
            raise Broken("triangles: more vertices than the header says")
        x, y, z = (self.new_vertex() for _ in range(3))
        self.triangles.append((x, y, z))
        i, j, k = self.new_node(x), self.new_node(y), self.new_node(z)
        link(i, k)
        link(k, j)
        link(j, i)
        self.degree[x] = self.degree[y] = self.degree[z] = 2
        self.push(i, j, k)
        self.focus = i

    def next_gate(self):
        if self.focus is not None and self.focus.alive and self.focus.open:
            return self.focus
        while True:
            stack = next((stack for stack in reversed(self.queue) if stack), None)
            if stack is None:
                self.focus = None
                return None
            node = stack.pop()
            if not (node.alive and node.open):
                continue
            if self.queue[self.bucket(node)] is stack:
                self.focus = node
                return node
            self.push(node)

    def act(self, a):
        """Decode the action at the gate of `a` and carry it out."""
        bit = self.decoder.bit
        b, p = a.next, a.previous
        n = b.next
        u, v = a.vertex, b.vertex
        valence_class = max(0, min(self.degree[v] - 4, 2))
        last_three = n is p
        if self.has_boundary and bit(self.boundary[(0 if p.open else 2) + (0 if b.open else 1)]):
            a.open = False
            return
        if p.open and (not last_three or b.open):
            if last_three:
                context = self.last[1 if self.degree[u] > 3 else 0]
            else:
                context = self.left[min(self.degree[u], 10) - 2][valence_class]
            if bit(context):
                self.triangles.append((u, v, p.vertex))
                self.close_fan(a, p, b)
                return
        if len(self.degree) < self.vertex_count and bit(self.fresh[valence_class]):
            self.widen(a, b, None)
        elif not last_three and b.open and bit(self.right[valence_class]):
            self.triangles.append((u, v, n.vertex))
            self.close_fan(b, a, n)
        else:
            self.widen(a, b, self.join(a))

    def join(self, a):
        """The node that a JOIN at `a` names."""
        decoder = self.decoder
        if not decoder.bit(self.near):
            number = decoder.number((len(self.nodes) - 1).bit_length())
            if number >= len(self.nodes):
                raise Broken("triangles: a join with a node that does not exist")
            node = self.nodes[number]
        else:
            back = decoder.bit(self.backward)
            k = 0
            while k < 8 and decoder.bit(self.distance[k]):
                k += 1
            steps = 2**k + decoder.number(k) + 1
            node = a if back else a.next
            for _ in range(steps):
                node = node.previous if back else node.next
        b = a.next
        near_ones = (a, b, a.previous, b.next)
        if not node.alive or node in near_ones or node.vertex in (a.vertex, b.vertex):
            raise Broken("triangles: a join with a node that is not allowed")
        return node

    def close_fan(self, removed, start, end):
        """LEFT and RIGHT: the gate of `start` now leads to `end`."""
        removed.alive = False
        link(start, end)
        if end.next is start:
            start.alive = end.alive = False
        else:
            self.degree[start.vertex] += 1
            self.degree[end.vertex] += 1
            self.push(start, end)

    def widen(self, a, b, c):
        """NEW (c is None) and JOIN c: a triangle with a corner away from the gate."""
        w = self.new_vertex() if c is None else c.vertex
        self.triangles.append((a.vertex, b.vertex, w))
        m = self.new_node(w)
        if c is None:
            link(a, m)
        else:
            link(c.previous, m)
            link(a, c)
        link(m, b)
        self.degree[w] += 2
        self.degree[a.vertex] += 1
        self.degree[b.vertex] += 1
        self.push(b)
        if c is not None:
            self.push(c)
        self.push(m, a)


def check_boundary(forest, has_boundary):
    """A.13, rule 6; `forest` is the EdgeForest of the triangles."""
    if not has_boundary and any(side is None for side in forest.side1):
        raise Broken("triangles: a boundary edge in a base that has no boundary")


def decode_triangles(decoder, vertex_count, face_count):
    """(triangles, has_boundary); rules 3 to 6 of A.13 are checked with the edges."""
    growing = RegionGrowing(decoder, vertex_count, face_count)
    return growing.run(), growing.has_boundary
