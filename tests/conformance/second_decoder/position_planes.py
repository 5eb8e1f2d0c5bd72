"""A.6.2: the control points of an embedded base."""

from float32 import to_f32
from range_decoder import contexts


def divide(a, b):
    """a / b truncated towards zero, b above 0."""
    return a // b if a >= 0 else -(-a // b)


class PositionPlanes:
    """The integers of the coordinates, `value[vertex][axis]`, from the highest plane down."""

    def __init__(self, decoder, header, triangles):
        self.decoder = decoder
        self.header = header
        self.plane = header.position_bits
        self.spread = 1 << (header.position_bits + 6)
        self.position = contexts(8)
        self.value = [[1 << header.position_bits] * 3 for _ in range(header.vertex_count)]
        self.others = [[] for _ in range(header.vertex_count)]
        for a, b, c in triangles:
            self.others[a] += (b, c)
            self.others[b] += (c, a)
            self.others[c] += (a, b)

    def decode_plane(self):
        """position_plane() of the text; nothing if no plane is left."""
        if self.plane == 0:
            return
        self.plane -= 1
        for value, others in zip(self.value, self.others):
            for axis in range(3):
                self._decode_bit(value, axis, others)

    def _decode_bit(self, value, axis, others):
        b, count = self.plane, len(others)
        excess = sum(self.value[v][axis] for v in others) - count * value[axis]
        pull = abs(excess) // count
        down = 1 if excess < 0 else 0
        s = max(self.spread // 256, 1)
        if (8 << b) < s:
            upper = self.decoder.raw()
        else:
            reach = min(pull, (3 << b) // 2)
            length = (reach * 8 // s + 1).bit_length() - 1
            upper = self.decoder.bit(self.position[min(length, 7)]) != down
        step = 1 << b
        value[axis] += step if upper else -step
        left = abs(pull + step) if upper == down else abs(pull - step)
        self.spread += divide(left * 256 - self.spread, 32)

    def control_points(self):
        """The coordinates of what is known, rounded to f32."""
        header = self.header
        unit = 1 << (1 + max(header.position_bits - 4, 0))
        half = header.scale / 2
        return [tuple(to_f32((o * unit + x) * half) for o, x in zip(header.origin, value))
                for value in self.value]
