# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges whether files in pieces hold, bit for bit, what the whole files hold.

    judge_pieces.py WHOLE PIECES

Both are folders of results of the same case on the same ranks.
"""

import argparse
import json
import re

import numpy as np
from vtkmodules.vtkIOXML import vtkXMLPPolyDataReader

from results import FAMILIES, Run, Surface, Verdict

parser = argparse.ArgumentParser()
parser.add_argument("whole")
parser.add_argument("pieces")
parser.add_argument("--ranks", type=int, required=True)
arguments = parser.parse_args()
a, b = Run(arguments.whole), Run(arguments.pieces)
verdict = Verdict()


def sorted_corners(surface):
    """Per corner of a triangle, or per point, all values but `vertex`; and `vertex`."""
    names = sorted(name for name in surface.arrays if name != "vertex")
    columns = [surface.points] + [surface[name].reshape(surface.n, -1) for name in names]
    values = np.hstack(columns).astype(float)
    triangles = surface.triangles
    if len(triangles):
        # Triangles begin at the same corner in both files.
        rows = np.hstack([values[triangles[:, k]] for k in range(3)])
        order = np.lexsort(rows.T[::-1])
        return rows[order], surface["vertex"][triangles[order]].ravel()
    return values[np.lexsort(values.T[::-1])], np.zeros(0, dtype=int)


different, unwelded, listed, pieces, nTriangles = [], [], [], set(), 0
for family in FAMILIES:
    series = json.loads((b.folder / f"{family}.pvtp.series").read_text(encoding="ascii"))
    wanted = [(e["name"].replace(".vtp", ".pvtp"), e["time"]) for e in a.series(family)]
    if [(e["name"], e["time"]) for e in series["files"]] != wanted or len(wanted) < 2:
        listed.append(family)
    for index in range(len(wanted)):
        path = b.folder / f"{family}_{index:06d}.pvtp"
        pieces |= set(re.findall(r'Source="[^"/]*/([0-9]+).vtp"', path.read_text("ascii")))
        whole, parts = a.surface(family, index), Surface(path, vtkXMLPPolyDataReader)
        nTriangles += len(parts.triangles)
        if whole.types != parts.types or whole.time != parts.time:
            different.append(f"arrays or time of {family} {index}")
            continue
        if whole.n == 0 or parts.n == 0:
            if whole.n != parts.n:
                different.append(f"{family} {index}")
            continue
        (x, v), (y, w) = sorted_corners(whole), sorted_corners(parts)
        if x.shape != y.shape or (x != y).any():
            different.append(f"{family} {index}")
        elif len(v):
            pairs = np.unique(np.stack([v, w]), axis=1)
            if not len(np.unique(v)) == len(np.unique(w)) == pairs.shape[1] == w.max() + 1:
                unwelded.append(f"{family} {index}")

verdict.check("pieces: lists as those of whole files", not listed, " ".join(listed))
verdict.check(
    "pieces: of every rank", pieces == {str(i) for i in range(arguments.ranks)}, f"{sorted(pieces)}"
)
verdict.check(
    "pieces: the same triangles and values",
    not different and nTriangles > 1000,
    "; ".join(different[:3]) or f"{nTriangles} triangles",
)
verdict.check("pieces: welded by `vertex`", not unwelded, "; ".join(unwelded[:3]))
verdict.leave()
