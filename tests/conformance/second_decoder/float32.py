"""Rounding to IEEE 754 single precision."""

import math
import struct


def to_f32(number):
    """The nearest f32, as a Python float; infinite where it is too large."""
    try:
        return struct.unpack("<f", struct.pack("<f", number))[0]
    except OverflowError:
        return math.copysign(math.inf, number)


def f32_bytes(number):
    return struct.pack("<f", number)


def f32_from_upper_half(half):
    """The f32 whose upper 16 bits are `half` and whose lower 16 bits are zero."""
    return struct.unpack("<f", struct.pack("<I", half << 16))[0]


def shortest(number):
    """The shortest decimal, as a Python float, that rounds to the f32 `number`."""
    for digits in range(6, 10):
        candidate = float(f"{number:.{digits}g}")
        if to_f32(candidate) == number:
            return candidate
    return number
