# SPDX-License-Identifier: GPL-3.0-or-later
"""Says where two runs differ that must not; nothing if they are the same.

    sameClasses.py BEFORE AFTER [--tables RELATIVE | --areas RELATIVE]

compares folders of results: the arrays `stability` and `cellSize` of both surfaces, value
by value, and the areas of stability.dat, with --areas to this accuracy. With --tables the
areas alone, to this accuracy.

    sameClasses.py --convert stl|obj FOLDER

writes each interface of a folder in another format beside it.
"""

import argparse
from pathlib import Path

import numpy as np
from vtkmodules.vtkIOGeometry import vtkOBJWriter, vtkSTLWriter

from results import Run, Surface

AREAS = ("area", "stableArea", "attachedArea", "detachedNearWalls", "detachedElsewhere", "leftArea", "enteredArea")


def compare_areas(before, after, relative):
    a, b = before.table("stability.dat"), after.table("stability.dat")
    tolerance = relative * a["area"].max()
    for name in AREAS:
        if len(a[name]) != len(b[name]):
            print(f"{len(a[name])} and {len(b[name])} rows")
        elif np.abs(a[name] - b[name]).max() > tolerance:
            print(f"{name} {a[name]} and {b[name]}")
    if not 0.01 < (a["attachedArea"] / a["area"]).max() < 0.9:
        print(f"nothing to compare: attached are {a['attachedArea']}")


def compare_classes(before, after):
    found = set()
    for family in ("interface", "timeSurface"):
        for index in range(len(before)):
            a, b = (run.surface(family, index) for run in (before, after))
            found |= set(a["stability"])
            if a.n != b.n:
                print(f"{family} {index}: {a.n} and {b.n} points")
                continue
            for name in ("stability", "cellSize"):
                if (a[name] != b[name]).any():
                    print(f"{family} {index}: {(a[name] != b[name]).sum()} of {a.n} {name} differ")
    if not {0, 1, 2} <= found:
        print(f"nothing to compare: the classes are {found}")


def convert(name, folder):
    for path in Path(folder).glob("interface_*.vtp"):
        data = Surface(path).data
        data.GetPointData().SetTCoords(None)
        writer = vtkSTLWriter() if name == "stl" else vtkOBJWriter()
        writer.SetInputData(data)
        writer.SetFileName(str(path.with_suffix("." + name)))
        writer.Write()


parser = argparse.ArgumentParser()
parser.add_argument("folders", nargs="+")
parser.add_argument("--tables", type=float)
parser.add_argument("--areas", type=float, default=1e-12)
parser.add_argument("--convert", choices=["stl", "obj"])
arguments = parser.parse_args()
if arguments.convert:
    convert(arguments.convert, arguments.folders[0])
else:
    runs = [Run(folder) for folder in arguments.folders]
    compare_areas(*runs, arguments.tables or arguments.areas)
    if not arguments.tables:
        compare_classes(*runs)
