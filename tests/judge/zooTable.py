# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints the rows of doc/interfaces.md on the zoo of meshes, from the unit tests' report:

    unitTests --gtest_filter='Zoo/OnTheZoo*' --gtest_output=xml:REPORT
    zooTable.py REPORT
"""

import sys
import xml.etree.ElementTree as ElementTree

WAYS = ("none", "auto", "profile", "bonnell", "plic")


def short(text):
    """Two digits, without the zero before the point."""
    value = float(text)
    if value < 5e-5:
        return "0"
    digits = 4 if value < 0.01 else 3 if value < 0.1 else 2
    return f"{value:.{digits}f}"[1:]


rows = {}
for case in ElementTree.parse(sys.argv[1]).iter("testcase"):
    mesh, way = case.get("name").split("/")[-1].split("_")
    rows.setdefault(mesh, {})[way] = {p.get("name"): p.get("value") for p in case.iter("property")}
for mesh, ways in rows.items():
    if not ways["auto"]:
        continue  # there is nothing to be accurate about
    balls = [f"{short(ways[way]['ballRms'])}/{short(ways[way]['ballLargest'])}" for way in WAYS]
    plane = f"{short(ways['auto']['planeRms'])}/{short(ways['auto']['planeRmsInside'])}"
    flipped = max(int(ways["auto"][shape + "Flipped"]) for shape in ("ball", "plane"))
    print("|", " | ".join([mesh, *balls, plane, str(flipped)]), "|")
