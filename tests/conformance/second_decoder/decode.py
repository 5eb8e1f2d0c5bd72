#!/usr/bin/env python3
"""Decode a stream, or a prefix of it, and print the result as JSON."""

import argparse
import json
import sys

from answers import Broken
from decoder import decode
from files import FileProblem, read_base, read_bytes, result_as_json
from surface import reconstruct

EPILOG = """\
The result names the status ("done" or "more bytes wanted"), the base mesh with its sharp edges
and vertices, the integers of the details by level and channel, and the limit positions and
normals of the finest level. "base" is null as long as the bytes do not determine a base.

The exit code is 0 if the stream is valid, 1 if it is broken or a file cannot be used.

examples:
  decode.py horse.zt                          a stream with a base of its own
  decode.py horse.zt --bytes 1000             what its first 1000 bytes say
  decode.py payload.zt --base base.json       a payload for a base mesh
"""


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(
        description="Decode a stream of progressive surface details and print the result as JSON.",
        epilog=EPILOG, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("stream", metavar="STREAM", help="the file to decode")
    parser.add_argument("--base", metavar="BASE.json",
                        help='base mesh of a payload: {"positions": [[x, y, z], ...], '
                             '"triangles": [[a, b, c], ...]}')
    parser.add_argument("--levels", metavar="J", type=int,
                        help="levels of details that the stream must have; with a base and fewer "
                             "bytes than a header, the level of the surface (default: 0 then)")
    parser.add_argument("--bytes", metavar="N", type=int,
                        help="decode the first N bytes only (default: all)")
    options = parser.parse_args(arguments)
    if options.levels is not None and not 0 <= options.levels <= 14:
        parser.error(f"--levels {options.levels}: give a number from 0 to 14")
    if options.bytes is not None and options.bytes < 0:
        parser.error(f"--bytes {options.bytes}: give 0 or more")
    return options


def run(options):
    data = read_bytes(options.stream)
    if options.bytes is not None:
        if options.bytes > len(data):
            raise FileProblem(f"{options.stream}: has {len(data)} bytes; give --bytes "
                              f"{len(data)} or less")
        data = data[:options.bytes]
    base = read_base(options.base) if options.base else None
    decoded = decode(data, base, options.levels)
    positions, normals = None, None
    if decoded.forest is not None:
        positions, normals = reconstruct(decoded, with_normals=True)
    json.dump(result_as_json(decoded, positions, normals), sys.stdout)
    print()


def main(arguments):
    options = parse_arguments(arguments)
    try:
        run(options)
    except FileProblem as problem:
        print(problem, file=sys.stderr)
        return 1
    except Broken as complaint:
        print(f"{options.stream}: broken: {complaint}; get the stream (or its base) anew",
              file=sys.stderr)
        return 1
    except BrokenPipeError:
        sys.stderr.close()
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
