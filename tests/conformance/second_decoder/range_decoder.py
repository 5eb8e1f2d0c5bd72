"""A.3: the adaptive range decoder and its rule for missing bytes."""

from answers import MoreBytesWanted


def shifts(seen):
    """How far an update shifts, for the fast and the slow estimate."""
    window = (seen + 2).bit_length() - 1
    return min(window, 5), min(window, 8)


SHIFTS = [shifts(seen) for seen in range(255)]


class Context:
    """An adaptive probability of a one."""

    __slots__ = ("fast", "slow", "seen")

    def __init__(self):
        self.fast = 32768
        self.slow = 32768
        self.seen = 0

    def update(self, bit):
        fast_shift, slow_shift = SHIFTS[self.seen]
        if bit:
            self.fast += (65535 - self.fast) >> fast_shift
            self.slow += (65535 - self.slow) >> slow_shift
        else:
            self.fast -= self.fast >> fast_shift
            self.slow -= self.slow >> slow_shift
        if self.seen < 254:
            self.seen += 1


def contexts(*sizes):
    """A nested list of fresh contexts, sizes[0] x sizes[1] x ..."""
    if not sizes:
        return Context()
    return [contexts(*sizes[1:]) for _ in range(sizes[0])]


class RangeDecoder:
    """Takes decisions from the bytes `data[start:]`.

    Four bytes of 255 at the start are a case of their own: `all_ones`.
    """

    def __init__(self, data, start):
        self.data = data
        self.place = start
        self.missing = 0
        self.range = 0xFFFFFFFF
        self.code = 0
        self.all_ones = False
        for _ in range(4):
            self._read_byte()
        if self.code == 0xFFFFFFFF:
            self.code -= 1
            self.all_ones = True

    def _read_byte(self):
        if self.place < len(self.data):
            byte = 255 if self.all_ones else self.data[self.place]
        else:
            byte = 0
            self.missing += 1
        self.place += 1
        self.code = (self.code << 8) + byte

    def bit(self, context):
        probability = (context.fast + context.slow) >> 1
        bit = self._take((self.range * probability) >> 16)
        context.update(bit)
        return bit

    def raw(self):
        return self._take(self.range >> 1)

    def number(self, count):
        """`count` raw bits, the most significant first (A.10)."""
        value = 0
        for _ in range(count):
            value = 2 * value + self.raw()
        return value

    def _take(self, bound):
        code = self.code
        if self.missing:
            mask = (1 << (8 * self.missing)) - 1
            if self.missing >= 4 or code < bound <= code + mask:
                raise MoreBytesWanted
        if code < bound:
            self.range = bound
            bit = 1
        else:
            self.code = code - bound
            self.range -= bound
            bit = 0
        while self.range < 1 << 24:
            self.range <<= 8
            self._read_byte()
        return bit
