# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges results on a two-dimensional mesh or a wedge.

    judge_section.py rotation CASE ...   a disc in rotation, exact fractions
    judge_section.py still CASE ...      a disc of which nothing may part
    judge_section.py same CASE CASE ...  the second mesh is --factor times as thick
    judge_section.py strain CASE ...     a sphere in a wedge, strained along its axis
"""

import argparse

import numpy as np

from results import Run, Verdict


def vector(parser, name, default=None):
    parser.add_argument(name, type=float, nargs=3, default=default)


parser = argparse.ArgumentParser()
parser.add_argument("kind", choices=["rotation", "still", "same", "strain"])
parser.add_argument("cases", nargs="+")
parser.add_argument("--cells", type=float, default=32, help="cells per metre")
vector(parser, "--centre")
vector(parser, "--axis")
vector(parser, "--normal")
parser.add_argument("--radius", type=float)
parser.add_argument("--thickness", type=float, help="of the mesh [m]")
parser.add_argument("--factor", type=float)
parser.add_argument("--strain", type=float, help="along the axis [1/s]")
parser.add_argument("--slope", type=float, help="thickness of the wedge per radius")
parser.add_argument("--origin", type=float, default=0.002, help="largest mean error [cells]")
arguments = parser.parse_args()
verdict = Verdict()


def listed(problems):
    return "; ".join(problems[:3])


def unit(v):
    v = np.array(v)
    return v / np.linalg.norm(v)


def nothing_happens(run):
    table = run.table("stability.dat")
    for name in ("attachedArea", "detachedNearWalls", "detachedElsewhere", "particles"):
        verdict.at_most(name, np.abs(table[name]).max(), 0)
    verdict.at_least("coverage", table["coverage"].min(), 1 - 1e-9)
    verdict.at_most("share of thin area", np.abs(table["detachedThin"]).max(), 0)
    return table


def turned(x, centre, axis, angle):
    r = x - centre
    k = np.outer(r @ axis, axis)
    return centre + k + np.cos(angle) * (r - k) + np.sin(angle) * np.cross(axis, r)


def between(x, axis):
    return x - np.outer(x @ axis, axis)


def rotation():
    run, axis, centre = Run(arguments.cases[0]), unit(arguments.axis), np.array(arguments.centre)
    table = nothing_happens(run)
    length = 2 * np.pi * arguments.radius
    error = np.abs(table["area"] / (length * arguments.thickness) - 1).max()
    verdict.at_most("area, relative", error, 1e-3)
    last = len(run) - 1
    m = run.surface("interface", last)
    across = m.points @ axis
    # A seam cuts the diagonal of a rectangle between the planes.
    off = np.minimum(across - across.min(), across.max() - across) > 1e-9 * arguments.thickness
    verdict.at_most("share of points off the two planes", off.mean(), 0.05)
    verdict.at_most(
        "spans the mesh, relative",
        abs((across.max() - across.min()) / arguments.thickness - 1), 1e-9
    )
    centres = turned(m["origin"], centre, axis, 2 * np.pi * m.time)
    off = np.linalg.norm(between(centres - m.points, axis), axis=1) * arguments.cells
    verdict.at_most("mean error of the origin [cells]", off.mean(), arguments.origin)
    verdict.at_most("largest error of the origin [cells]", off.max(), 20 * arguments.origin)


def still():
    run = Run(arguments.cases[0])
    table = nothing_happens(run)
    length = 2 * np.pi * arguments.radius
    error = np.abs(table["area"] / (length * arguments.thickness) - 1).max()
    verdict.at_most("area, relative", error, 1e-3)


def same():
    a, b = Run(arguments.cases[0]), Run(arguments.cases[1])
    normal = unit(arguments.normal)
    verdict.check("as many times", len(a) == len(b) > 1, f"{len(a)} and {len(b)}")
    classes, counts, found, worst = [], [], set(), {}
    for index in range(len(a)):
        for family in ("interface", "timeSurface", "particles"):
            s, t = a.surface(family, index), b.surface(family, index)
            if s.n != t.n or (s.triangles != t.triangles).any():
                counts.append(f"{family} {index}: {s.n} and {t.n} points")
                continue
            if s.n == 0:
                continue
            off = np.abs(between(s.points - t.points, normal)).max()
            worst["points"] = max(worst.get("points", 0), off)
            for name in s.arrays:
                if name in ("stability", "component", "thin", "subGrid", "state"):
                    found |= set(s[name]) if name == "stability" else set()
                    if (s[name] != t[name]).any():
                        classes.append(f"{name} of {family} {index}")
                elif name in ("parameter", "TCoords", "distance", "driftSpeed", "cellSize"):
                    d = np.abs(s[name] - t[name]).max()
                    worst[name] = max(worst.get(name, 0), d)
    verdict.check("the same triangles", not counts, listed(counts))
    verdict.check("the same classes", not classes, listed(classes))
    verdict.check("there is something to compare", {0, 1, 2} <= found, f"{found}")
    for name, value in worst.items():
        verdict.at_most(name, value, 1e-9)
    s, t = a.table("stability.dat"), b.table("stability.dat")
    for name in ("area", "stableArea", "attachedArea", "detachedElsewhere"):
        off = np.abs(t[name] - arguments.factor * s[name]).max()
        verdict.at_most(f"{name} as thick, relative", off / t["area"].max(), 1e-9)


def strain():
    run, axis = Run(arguments.cases[0]), unit(arguments.axis)
    table = nothing_happens(run)
    rate, radius = arguments.strain, arguments.radius
    worst, rms = 0, 0
    for index in range(len(run)):
        for family in ("interface", "timeSurface"):
            s = run.surface(family, index)
            x = s.points - np.array(arguments.centre)
            r = np.linalg.norm(between(between(x, axis), unit(arguments.normal)), axis=1)
            a = radius * np.exp(rate * s.time)
            b = radius * np.exp(-0.5 * rate * s.time)
            z = x @ axis
            # First order: the value of the ellipsoid over the size of its gradient.
            f = (z / a) ** 2 + (r / b) ** 2 - 1
            g = 2 * np.hypot(z / a**2, r / b**2)
            off = np.abs(f / g) * arguments.cells
            worst = max(worst, off.max())
            rms = max(rms, np.sqrt((off**2).mean()))
    verdict.at_most("distance from the exact spheroid, rms [cells]", rms, 0.0025)
    verdict.at_most("the largest [cells]", worst, 0.02)
    angle = np.linspace(0, np.pi, 20001)
    worst = 0
    for time, area in zip(table["Time"], table["area"]):
        z = radius * np.exp(rate * time) * np.cos(angle)
        r = radius * np.exp(-0.5 * rate * time) * np.sin(angle)
        arcs = np.hypot(np.diff(z), np.diff(r))
        exact = arguments.slope * (arcs * 0.5 * (r[1:] + r[:-1])).sum()
        worst = max(worst, abs(area / exact - 1))
    verdict.at_most("area in the wedge, relative", worst, 1e-3)


{"rotation": rotation, "still": still, "same": same, "strain": strain}[arguments.kind]()
verdict.leave()
