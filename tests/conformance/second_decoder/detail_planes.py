"""A.5, A.6.3 to A.6.5: the bit planes of the details."""

from range_decoder import contexts

# What a cell is in its channel. Only a codable cell may become significant.
CODABLE = 0       # neither absent, significant nor visited
VISITED = 1       # visited in this plane, found insignificant
REFINABLE = 2     # significant since an earlier plane
FRESH = 3         # became significant in this plane
ABSENT = 4

NEXT_PLANE = bytes([CODABLE, CODABLE, REFINABLE, REFINABLE, ABSENT]) + bytes(251)
IS_CODABLE = bytes([1]) + bytes(255)
DOUBLE = bytes(min(2 * x, 255) for x in range(256))
DOUBLE_LEAN = {x: max(-127, min(2 * x, 127)) for x in range(-127, 128)}


def classes(cuts, size):
    """class(x, cuts) for every x below `size`."""
    return [sum(x >= cut for cut in cuts) for x in range(size)]


AROUND_CLASS = classes((1, 4, 8, 12, 16, 23, 32, 48, 64, 96, 160), 256)
ABOVE_CLASS = classes((1, 4, 8, 16, 32, 64), 256)
LEAN_CLASS = classes((1, 8, 24), 128)
REFINEMENT_CLASS = classes((4, 10, 18, 28, 40, 56, 80, 112, 160), 256)
QUIET_CLASS = classes((1, 4, 12), 256)


def sign_class(value):
    """0 for 0, 1 for positive, 2 for negative."""
    return 0 if value == 0 else 1 if value > 0 else 2


class ChannelLevel:
    """The cells of one channel on one level."""

    def __init__(self, forest, level):
        count = len(forest.vertices) << 2 * level
        self.level = level
        self.value = [0] * count
        self.around = bytearray(count)
        self.above = bytearray(count)
        self.lean = [0] * count
        self.state = absent_cells(forest, level)

    def start_of_plane(self):
        self.state = self.state.translate(NEXT_PLANE)
        self.around = self.around.translate(DOUBLE)
        self.above = self.above.translate(DOUBLE)
        if any(self.lean):
            self.lean = [DOUBLE_LEAN[x] for x in self.lean]


def absent_cells(forest, level):
    """The first states of the cells of a level: CODABLE or ABSENT."""
    inner = bytes([CODABLE]) * (1 << 2 * level)
    outer = bytes(ABSENT if lies_in_side_1(level, morton) else CODABLE
                  for morton in range(1 << 2 * level))
    edges = range(len(forest.vertices))
    return bytearray(b"".join(outer if forest.is_boundary(e) else inner for e in edges))


def lies_in_side_1(level, morton):
    """p < q: the highest digit of the morton number in which p and q differ is 1."""
    p_bits, q_bits = morton >> 1 & 0x5555555, morton & 0x5555555
    return p_bits < q_bits


class DetailPlanes:
    """All details and the contexts of their passes."""

    def __init__(self, decoder, forest, levels):
        self.decoder = decoder
        self.forest = forest
        self.levels = levels
        self.channels = [[ChannelLevel(forest, level) for level in range(levels)]
                         for _ in range(3)]
        self.plane = None
        self.significance = contexts(2, 3, 12, 7)
        self.normal_sign = contexts(7, 3, 2)
        self.tangent_sign = contexts(2, 3, 3)
        self.refinement_bits = contexts(3, 10)
        self.tree_bits = contexts(2, 8, 5, 2)
        self.root_bits = contexts(2, 8, 4)
        self.below_bits = contexts(2, 8)

    def values(self, level):
        """The integers of the three channels of a level."""
        return [channel[level].value for channel in self.channels]

    def start_of_plane(self, plane):
        self.plane = plane
        for channel in self.channels:
            for cells in channel:
                cells.start_of_plane()

    # Becoming significant

    def decode_sign(self, c, level, i):
        """sign() of the text: the cell becomes significant."""
        cells = self.channels[c][level]
        parent = sign_class(self.channels[c][level - 1].value[i >> 2]) if level else 0
        if c == 0:
            lean = cells.lean[i]
            strength = LEAN_CLASS[abs(lean)] + (3 if lean < 0 else 0)
            context = self.normal_sign[strength][parent][level == self.levels - 1]
        else:
            sibling = sign_class(cells.value[i ^ 3]) if level else 0
            context = self.tangent_sign[c - 1][parent][sibling]
        self.become_significant(c, level, i, self.decoder.bit(context))

    def become_significant(self, c, level, i, negative):
        cells = self.channels[c][level]
        cells.value[i] = (-3 if negative else 3) << self.plane
        cells.state[i] = FRESH
        around = cells.around
        faces = self.forest.face_neighbours(level, i)
        ring, collinear = self.forest.ring_neighbours(level, i)
        for k in faces:
            around[k] = min(around[k] + 13, 255)
        for k in ring:
            around[k] = min(around[k] + 5, 255)
        if c == 0:
            self._lean(cells.lean, faces, -6 if negative else 6)
            self._lean(cells.lean, collinear, 2 if negative else -2)
        for other in range(3):
            if other != c:
                above = self.channels[other][level].above
                above[i] = min(above[i] + 3, 255)
        if level + 1 < self.levels:
            above_children = self.channels[c][level + 1].above
            for k in range(4 * i, 4 * i + 4):
                above_children[k] = min(above_children[k] + 6, 255)

    @staticmethod
    def _lean(lean, neighbours, amount):
        for k in neighbours:
            lean[k] = max(-127, min(lean[k] + amount, 127))

    # Likely passes

    def likely(self, activity):
        for level in range(self.levels):
            for c in range(3):
                self._likely(activity, level, c)

    def _likely(self, activity, level, c):
        cells = self.channels[c][level]
        state, bit = cells.state, self.decoder.bit
        level_class = 2 if level == self.levels - 1 else 0 if level == 0 else 1
        table = self.significance[min(c, 1)][level_class]
        # The iterators show each cell as the cells before it have left it.
        for i, (around, above) in enumerate(zip(cells.around, cells.above)):
            if around + above >= activity and state[i] == CODABLE:
                significant = bit(table[AROUND_CLASS[around]][ABOVE_CLASS[above]])
                state[i] = VISITED
                if significant:
                    self.decode_sign(c, level, i)

    # Refinement

    def refinement(self):
        for level in range(self.levels):
            for c in range(3):
                self._refinement(self.channels[c][level])

    def _refinement(self, cells):
        half = 1 << self.plane
        i = cells.state.find(REFINABLE)
        while i >= 0:
            value = cells.value[i]
            known = abs(value) >> self.plane
            which = 0 if known < 8 else 1 if known < 16 else 2
            activity = min(cells.around[i] + cells.above[i], 255)
            one = self.decoder.bit(self.refinement_bits[which][REFINEMENT_CLASS[activity]])
            cells.value[i] = value + half if one == (value > 0) else value - half
            i = cells.state.find(REFINABLE, i + 1)

    # Cleanup

    def cleanup(self):
        """The trees of each channel; what is open does not change while the pass runs."""
        is_open = [self._open_cells(channel) for channel in self.channels]
        for c in range(3):
            for i in range(len(self.forest.vertices) if self.levels else 0):
                self._tree(is_open[c], c, 0, i, False)

    def _open_cells(self, channel):
        """Per level a byte for each cell: 1 if it is codable or has an open child."""
        result = []
        below = None
        for cells in reversed(channel):
            is_open = cells.state.translate(IS_CODABLE)
            if below is not None:
                is_open = union(is_open, below[0::4], below[1::4], below[2::4], below[3::4])
            result.append(is_open)
            below = is_open
        result.reverse()
        return result

    def _tree(self, is_open, c, level, i, found):
        """tree(level, i) of the text; says whether the cell or its `found` siblings hold."""
        if not is_open[level][i]:
            return found
        bit, kind, height = self.decoder.bit, min(c, 1), min(self.levels - 1 - level, 7)
        cells = self.channels[c][level]
        codable = cells.state[i] == CODABLE
        quiet = QUIET_CLASS[min(cells.around[i] + cells.above[i], 255)]
        last_hope = level > 0 and not found and not any(is_open[level][i + 1:(i | 3) + 1])
        if not last_hope and not bit(self.tree_bits[kind][height][quiet if codable else 4][found]):
            return found
        child_open = level + 1 < self.levels and any(is_open[level + 1][4 * i:4 * i + 4])
        implied = True
        if codable and (not child_open or bit(self.root_bits[kind][height][quiet])):
            self.decode_sign(c, level, i)
            implied = False
        if child_open and (implied or bit(self.below_bits[kind][height])):
            child_found = False
            for child in range(4 * i, 4 * i + 4):
                child_found = self._tree(is_open, c, level + 1, child, child_found)
        return True


def union(*sets):
    """The bytewise or of arrays of equal length."""
    size = len(sets[0])
    total = 0
    for one in sets:
        total |= int.from_bytes(one, "little")
    return bytearray(total.to_bytes(size, "little"))
