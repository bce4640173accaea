# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes constant/parts<N> of a case for decomposePar's method manual: the cells nearest to
each of N scattered points, so that parts meet at all angles and several at a point. The
case holds binary cell centres in 0/C.

    irregularParts.py CASE N
"""

import sys
from pathlib import Path

import numpy as np

from dam import field

case, n = Path(sys.argv[1]), int(sys.argv[2])
centres = field(case / "0" / "C", 3)
seeds = np.random.default_rng(n).uniform(centres.min(axis=0), centres.max(axis=0), (n, 3))
parts = np.linalg.norm(centres[:, None] - seeds[None], axis=2).argmin(axis=1)
assert len(np.unique(parts)) == n
header = "FoamFile { version 2.0; format ascii; class labelList; location constant; object parts; }"
rows = "\n".join(str(part) for part in parts)
(case / "constant" / f"parts{n}").write_text(f"{header}\n{len(parts)}\n(\n{rows}\n)\n", encoding="ascii")
