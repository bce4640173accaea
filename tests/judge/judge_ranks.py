# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges whether a run on several ranks gave what the serial run gave.

    judge_ranks.py SERIAL PARALLEL

Both are folders of results. Counts, connections and histories must be identical; classes
too, but for points whose distance is within 1e-9 cells of epsilon, which are counted.
"""

import argparse

import numpy as np

from results import FAMILIES, Run, Verdict

NEAR = 1e-9  # cells
WHOLE = ("component", "thin", "subGrid", "preimageCount", "nearWall", "id", "state", "vertex")
REAL = {
    "parameter": 1e-9,  # of the unit square
    "origin": 1e-9,  # of the domain
    "distance": 1e-9,
    "detachmentTime": 0.0,
    "detachmentPosition": 1e-9,
    "weight": 1e-9,
}

parser = argparse.ArgumentParser()
parser.add_argument("serial")
parser.add_argument("parallel")
parser.add_argument("--cells", type=float, required=True, help="size of a cell [m]")
parser.add_argument("--all-stable", action="store_true", help="nothing may detach")
arguments = parser.parse_args()
a, b = Run(arguments.serial), Run(arguments.parallel)
verdict = Verdict()

verdict.check("as many times", len(a) == len(b) and len(a) > 1, f"{len(a)} and {len(b)}")
counts, connections, whole, doubtful, wrong = [], [], [], 0, []
largest = dict.fromkeys(REAL, 0.0)
points = 0.0
found = set()
nParticles = 0
for index in range(min(len(a), len(b))):
    epsilon = a.table("stability.dat")["epsilon"][index]
    for family in FAMILIES:
        s, p = a.surface(family, index), b.surface(family, index)
        if s.n != p.n or len(s.triangles) != len(p.triangles):
            counts.append(f"{family} {index}: {s.n}/{len(s.triangles)} and {p.n}/{len(p.triangles)}")
            continue
        if (s.triangles != p.triangles).any():
            connections.append(f"{family} {index}")
        if s.n == 0:
            continue
        points = max(points, np.abs(s.points - p.points).max())
        for name in WHOLE:
            if name in s.arrays and (s[name] != p[name]).any():
                whole.append(f"{name} of {family} {index}")
        for name in REAL:
            if name in s.arrays:
                largest[name] = max(largest[name], np.abs(s[name] - p[name]).max())
        if family == "particles":
            nParticles = s.n
            continue
        found |= set(s["stability"])
        differs = s["stability"] != p["stability"]
        near = np.abs(s["distance"] - epsilon) < NEAR * arguments.cells
        doubtful += (differs & near).sum()
        if (differs & ~near).any():
            wrong.append(f"{(differs & ~near).sum()} of {family} {index}")


def listed(problems):
    return "; ".join(problems[:3]) if problems else ""


verdict.check("the same counts of points and triangles", not counts, listed(counts))
verdict.check("the same triangles", not connections, listed(connections))
verdict.check("the same ids, components and flags", not whole, listed(whole))
verdict.check(
    "the same classes", not wrong, listed(wrong) or f"{doubtful} within 1e-9 cells of epsilon"
)
expected = found == {0} if arguments.all_stable else {0, 1, 2} <= found and nParticles > 10
verdict.check("there is something to compare", expected, f"{found}, {nParticles}")
verdict.at_most("positions [m]", points, 1e-9)
for name, allowed in REAL.items():
    verdict.at_most(name, largest[name], allowed)

for table in ("stability.dat", "survival.dat", "droplets.dat"):
    s, p = a.table(table), b.table(table)
    worst, where = 0.0, "nothing"
    for name in s:
        if len(s[name]) != len(p[name]):
            worst, where = 1.0, f"rows of {name}"
            break
        if len(s[name]):
            # The error of the volume is the difference of a ratio from 1.
            least = 1 if name == "volumeError" else 1e-3 * np.abs(s[name]).max() + 1e-30
            scale = np.maximum(np.abs(s[name]), least)
            off = (np.abs(s[name] - p[name]) / scale).max()
            if off > worst:
                worst, where = off, name
    verdict.check(f"{table} within 1e-12", worst <= 1e-12, f"{worst:.2g}, {where}")
verdict.leave()
