# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes constant/polyMesh of a case: the unit cube of N^3 cubes, each split into six
tetrahedra around a diagonal (Kuhn), numbered at random. One wall around all.

    tetrahedra.py CASE N
"""

import itertools
import sys
from pathlib import Path

import numpy as np

case, n = Path(sys.argv[1]), int(sys.argv[2])
random = np.random.default_rng(n)


def cells():
    """The points of each tetrahedron, as places on the lattice."""
    for low in itertools.product(range(n), repeat=3):
        for axes in itertools.permutations(range(3)):
            corner, way = list(low), [tuple(low)]
            for axis in axes:
                corner[axis] += 1
                way.append(tuple(corner))
            yield way


places = list(itertools.product(range(n + 1), repeat=3))
number = dict(zip(places, random.permutation(len(places)).tolist()))
points = np.empty((len(places), 3))
for place, i in number.items():
    points[i] = np.array(place) / n
tetrahedra = list(cells())
random.shuffle(tetrahedra)

sides = {}  # the cells of each face, with its points seen from the first
for cell, way in enumerate(tetrahedra):
    tet = [number[place] for place in way]
    for k in range(4):
        a, b, c = tet[:k] + tet[k + 1 :]
        if np.dot(np.cross(points[b] - points[a], points[c] - points[a]), points[tet[k]] - points[a]) > 0:
            b, c = c, b
        sides.setdefault(tuple(sorted((a, b, c))), []).append((cell, (a, b, c)))
inner = sorted((s for s in sides.values() if len(s) == 2), key=lambda s: (s[0][0], s[1][0]))
outer = [s for s in sides.values() if len(s) == 1]

folder = case / "constant" / "polyMesh"


def write(name, kind, rows):
    head = f"FoamFile {{ version 2.0; format ascii; class {kind}; location \"constant/polyMesh\"; object {name}; }}"
    (folder / name).write_text("\n".join([head, str(len(rows)), "(", *rows, ")", ""]), encoding="ascii")


write("points", "vectorField", [f"({x!r} {y!r} {z!r})" for x, y, z in points.tolist()])
write("faces", "faceList", [f"3({a} {b} {c})" for (_, (a, b, c)), *_ in inner + outer])
write("owner", "labelList", [str(s[0][0]) for s in inner + outer])
write("neighbour", "labelList", [str(s[1][0]) for s in inner])
write(
    "boundary",
    "polyBoundaryMesh",
    [f"sides {{ type wall; nFaces {len(outer)}; startFace {len(inner)}; }}"],
)
