"""From bytes to integers: the order of the passes and what a prefix yields (A.1, A.6, A.7)."""

from dataclasses import dataclass, field

from answers import Broken, MoreBytesWanted, TooLarge
from base_connectivity import check_boundary, decode_triangles
from detail_planes import DetailPlanes
from edge_forest import EdgeForest
from position_planes import PositionPlanes
from range_decoder import RangeDecoder
from sharp_tags import decode_sharp_tags
from stream_header import base_hash, read_header

DONE = "done"
MORE = "more bytes wanted"
VERTEX_LIMIT = 4_000_000


@dataclass
class Decoded:
    """What a prefix yields. Without a base, `forest` and `positions` are None."""

    status: str = MORE
    header: object = None
    levels: int = 0
    forest: EdgeForest = None
    positions: list = None
    creases: list = field(default_factory=list)
    corners: list = field(default_factory=list)
    details: list = field(default_factory=list)


def decode(data, base=None, levels=None):
    """Decode the prefix `data`.

    `base` is None or (positions, triangles) of an external base, `levels` is what the extension
    object says, None where nothing says it. Raises Broken for an invalid stream,
    and for one beyond the limit of this decoder.
    """
    result = Decoded()
    if base is not None:
        result.positions = base[0]
        if len(base[1]) >= 2**30:
            raise Broken("base: has 2^30 triangles or more")
        result.forest = EdgeForest(base[1], len(base[0]))
        result.levels = levels or 0
    try:
        result.header = read_header(data)
        check_header(result.header, base, levels)
        if base is not None:
            result.levels = result.header.levels
        Passes(data, result).run()
    except MoreBytesWanted:
        pass
    if result.forest is not None and not result.details:
        check_size(len(result.positions), len(result.forest.vertices), result.levels)
        result.details = [[[0] * (len(result.forest.vertices) << 2 * level)] * 3
                          for level in range(result.levels)]
    return result


def check_header(header, base, levels):
    """What the header says against what is at hand (A.2, and README.md, "levels")."""
    if header.external and base is None:
        raise Broken("header: the stream needs an external base, and none is given")
    if not header.external and base is not None:
        raise Broken("header: the stream has a base of its own, but another is given")
    if header.external and header.base_hash != base_hash(*base):
        raise Broken("header: base_hash is not that of the base at hand")
    if levels is not None and header.levels != levels:
        raise Broken(f"header: levels is {header.levels}, but {levels} is expected")


def check_size(vertex_count, edge_count, levels):
    """The limit against V + E * (4^J - 1) / 3 (A.2)."""
    vertices = vertex_count + edge_count * (4**levels - 1) // 3
    if vertices > VERTEX_LIMIT:
        raise TooLarge(f"header: the finest level has {vertices} vertices, more than "
                       f"the {VERTEX_LIMIT} that this decoder allows")


class Passes:
    """A.6. What is decoded lands in `result` as soon as it stands."""

    def __init__(self, data, result):
        self.result = result
        self.header = result.header
        self.decoder = RangeDecoder(data, self.header.byte_length)

    def run(self):
        header, result = self.header, self.result
        forest = result.forest if header.external else self._decode_base()
        check_size(forest.vertex_count, len(forest.vertices), header.levels)
        creases, corners = decode_sharp_tags(self.decoder, forest) if header.sharp else ([], [])
        result.forest, result.creases, result.corners = forest, creases, corners
        result.levels = header.levels
        points = None if header.external else PositionPlanes(self.decoder, header, forest.triangles)
        details = DetailPlanes(self.decoder, forest, header.levels)
        result.details = [details.values(level) for level in range(header.levels)]
        try:
            self._planes(points, details)
        finally:
            if points:
                result.positions = points.control_points()
        result.status = DONE

    def _decode_base(self):
        header = self.header
        check_size(header.vertex_count, (3 * header.face_count + 1) // 2, header.levels)
        triangles, has_boundary = decode_triangles(
            self.decoder, header.vertex_count, header.face_count)
        forest = EdgeForest(triangles, header.vertex_count)
        check_boundary(forest, has_boundary)
        return forest

    def _planes(self, points, details):
        def position_plane():
            if points:
                points.decode_plane()

        for _ in range(self.header.initial_planes or 0):
            position_plane()
        for plane in reversed(range(self.header.planes)):
            details.start_of_plane(plane)
            details.likely(21)
            details.likely(4)
            position_plane()
            details.refinement()
            details.cleanup()
        for _ in range(points.plane if points else 0):
            position_plane()
