"""The ways in which decoding ends early (A.1).

A.1 to A.14 and B.1 to B.9 are sections of the specification's appendices: A.1 to A.9 are in
BITSTREAM.md, A.10 to A.14 in BASE_CONNECTIVITY.md, B.1 to B.9 in RECONSTRUCTION.md.
"""


class Broken(Exception):
    """The stream, or its base, is invalid (A.8): the answer is "broken"."""


class TooLarge(Broken):
    """Refused for its size (A.2), which is no statement about its validity."""


class MoreBytesWanted(Exception):
    """The next decision depends on bytes that are not there."""
