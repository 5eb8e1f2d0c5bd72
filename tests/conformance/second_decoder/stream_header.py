"""A.2: the header, and the hash of an external base."""

import math
import struct
from dataclasses import dataclass

from answers import Broken, MoreBytesWanted
from float32 import f32_bytes, f32_from_upper_half, to_f32


@dataclass
class Header:
    """The fields of a header; those of the other kind of base are None."""

    external: bool
    sharp: bool
    transform: int
    levels: int
    tangent_ratio_log2: int
    planes: int
    finest_step: float
    position_bits: int | None = None
    initial_planes: int | None = None
    scale: float | None = None
    origin: tuple | None = None
    vertex_count: int | None = None
    face_count: int | None = None
    base_hash: int | None = None
    byte_length: int = 0


class HeaderBytes:
    """Reads the header's words one after the other."""

    def __init__(self, data):
        self.data = data
        self.place = 0

    def word(self, size):
        """An unsigned little-endian word of `size` bytes."""
        end = self.place + size
        if end > len(self.data):
            raise MoreBytesWanted
        value = int.from_bytes(self.data[self.place:end], "little")
        self.place = end
        return value

    def varint(self, name):
        value = 0
        for group in range(5):
            byte = self.word(1)
            value |= (byte & 127) << (7 * group)
            if byte < 128:
                require(byte != 0 or group == 0, name, "is not the shortest form of its number")
                require(value < 2**32, name, "has more than 32 bits")
                return value
        raise Broken(f"header: {name} is longer than 5 bytes")

    def signed(self, name):
        number = self.varint(name)
        return number // 2 if number % 2 == 0 else -(number + 1) // 2


def require(condition, field, complaint):
    if not condition:
        raise Broken(f"header: {field} {complaint}")


def bits(word, start, count):
    return (word >> start) & ((1 << count) - 1)


def read_header(data):
    """The header at the start of `data`; a field is checked as soon as it is there."""
    words = HeaderBytes(data)
    for letter in b"ZT":
        require(words.word(1) == letter, "magic", "is not ZT")
    kind = words.word(1)
    require(bits(kind, 0, 4) == 1, "version", f"{bits(kind, 0, 4)} is not 1")
    external = bits(kind, 4, 1) == 1
    transform = bits(kind, 6, 2)
    require(transform < 2, "transform", f"{transform} is reserved")
    detail = words.word(1)
    levels = bits(detail, 0, 4)
    require(levels <= 14, "levels", "is above 14")
    counts = words.word(1 if external else 2)
    planes = bits(counts, 0, 5)
    require(planes <= 30, "planes", "is above 30")
    require(levels > 0 or planes == 0, "planes", "is not 0, but levels is")
    header = Header(external, bits(kind, 5, 1) == 1, transform, levels, bits(detail, 4, 4),
                    planes, finest_step=0.0)
    if external:
        require(counts < 32, "planes", "is followed by bits that ought to be zero")
    else:
        read_position_counts(header, counts)
    header.finest_step = read_finest_step(words)
    if external:
        header.base_hash = words.word(4)
    else:
        read_embedded_part(header, words)
    header.byte_length = words.place
    return header


def read_position_counts(header, counts):
    header.position_bits = bits(counts, 5, 5)
    header.initial_planes = bits(counts, 10, 5)
    require(1 <= header.position_bits <= 28, "position_bits", "is not 1 to 28")
    require(header.initial_planes <= header.position_bits, "initial_planes",
            "is above position_bits")
    require(counts < 1 << 15, "initial_planes", "is followed by a bit that ought to be zero")


def read_finest_step(words):
    step = f32_from_upper_half(words.word(2))
    require(math.isfinite(step) and step > 0, "finest_step", "is not finite and above 0")
    return step


def read_embedded_part(header, words):
    code = words.word(1)
    exact_scale = header.finest_step * (4 + code % 4) / 4 * 2.0**(code // 4 - 32)
    header.scale = to_f32(exact_scale)
    require(math.isfinite(header.scale) and header.scale > 0, "scale_code",
            "makes a scale that is no f32 above 0")
    header.origin = tuple(words.signed("origin") for _ in range(3))
    unit = 1 << max(header.position_bits - 4, 0)
    reach = (max(map(abs, header.origin)) + 1) * unit + (1 << header.position_bits)
    require(math.isfinite(to_f32(header.scale * reach)), "origin", "is too far away for f32")
    vertices = words.varint("vertex_count")
    require(vertices >= 3, "vertex_count", "is below 3")
    faces = 2 * vertices - 4 + words.signed("excess_faces")
    require(1 <= faces < 2**30, "excess_faces", "makes a number of faces that is not 1 to 2^30 - 1")
    require(vertices <= 3 * faces, "vertex_count", "is above three times the faces")
    header.vertex_count, header.face_count = vertices, faces


def base_hash(positions, triangles):
    """64-bit FNV-1a over counts, corners and coordinates, folded to 32 bits."""
    content = [struct.pack("<II", len(positions), len(triangles))]
    content += [struct.pack("<III", *triangle) for triangle in triangles]
    content += [f32_bytes(x) for position in positions for x in position]
    value = 0xCBF29CE484222325
    for byte in b"".join(content):
        value = ((value ^ byte) * 0x100000001B3) & 0xFFFFFFFFFFFFFFFF
    return (value >> 32) ^ (value & 0xFFFFFFFF)
