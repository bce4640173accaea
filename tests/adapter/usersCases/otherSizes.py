# SPDX-License-Identifier: GPL-3.0-or-later
"""Rewrites binary files as an OpenFOAM with 64-bit labels and single precision has them.

otherSizes.py FILE...: files of a mesh (owner, neighbour, faces) get labels of 64 bits;
fields and points get scalars of 32 bits.
"""

import re
import sys
from pathlib import Path

import numpy as np

COMPONENTS = {b"scalar": 1, b"vector": 3}


def labels(data, start):
    """Each list N(...) of labels after `start`, with labels of 64 bits."""
    out = bytearray(data[:start])
    while True:
        head = re.compile(rb"\s*(\d+)\s*\(").match(data, start)
        if not head:
            return bytes(out) + data[start:]
        end = head.end() + 4 * int(head.group(1))
        out += head.group(0) + np.frombuffer(data[head.end() : end], "<i4").astype("<i8").tobytes()
        out += data[end : end + 1]
        start = end + 1


def scalars(data, lists, components):
    """Lists of scalars or vectors that the pattern finds, in single precision."""
    out, start = bytearray(), 0
    for head in iter(lambda: lists.search(data, start), None):
        size = 8 * components(head) * int(head.group("n"))
        body = data[head.end() : head.end() + size]
        out += data[start : head.end()] + np.frombuffer(body, "<f8").astype("<f4").tobytes()
        start = head.end() + size
    return bytes(out) + data[start:]


for path in map(Path, sys.argv[1:]):
    data = path.read_bytes()
    start = data.index(b"}") + 1
    start = re.compile(rb"(\s|//[^\n]*\n)*").match(data, start).end()
    if path.name in ("owner", "neighbour", "faces"):
        data = labels(data, start)
    elif path.name == "points":
        data = scalars(data, re.compile(rb"\n(?P<n>\d+)\n\("), lambda head: 3)
    else:
        data = scalars(
            data,
            re.compile(rb"List<(?P<type>scalar|vector)>\s*(?P<n>\d+)\s*\("),
            lambda head: COMPONENTS[head.group("type")],
        )
    path.write_bytes(data.replace(b"label=32;scalar=64", b"label=64;scalar=32", 1))
