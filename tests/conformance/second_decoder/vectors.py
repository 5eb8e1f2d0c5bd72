"""Three-vectors as tuples."""

import math


def weighted_sum(terms):
    """The sum of weight * vector over pairs (weight, vector)."""
    x = y = z = 0.0
    for weight, (a, b, c) in terms:
        x += weight * a
        y += weight * b
        z += weight * c
    return x, y, z


def minus(a, b):
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def plus(a, b):
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def plus_scaled(a, weight, b):
    return a[0] + weight * b[0], a[1] + weight * b[1], a[2] + weight * b[2]


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def square(a):
    return a[0] * a[0] + a[1] * a[1] + a[2] * a[2]


def length(a):
    return math.hypot(*a)


def normalised(a):
    size = length(a)
    return a[0] / size, a[1] / size, a[2] / size
