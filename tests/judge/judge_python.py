# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges whether Python's tools for OpenFOAM take the results of a case as they are meant.

Tables are read by the rules of foamlib (its reader of .dat files, on pandas): what follows
a '#' is no data, cells are parted by blanks and parentheses, columns without any value are
dropped, and the names are those of the last comment among the first 20 lines, if there are
as many. Folders of times are those whose name is a number. Lists are read by the rules of
PyVista (its readers of .series and .pvd): JSON, names relative to the list, the reader
chosen by the end of a name, equal times told once.
"""

import argparse
import json
import re
from pathlib import Path

import numpy as np

from results import Surface, Verdict

TABLES = (
    "stability.dat",
    "survival.dat",
    "droplets.dat",
    "charts.dat",
    "timing.dat",
    "methods.dat",
)
TEXTS = {"methods.dat": ("method",), "charts.dat": ("method", "cause")}  # columns of words


def is_number(word):
    """As Python has it, which takes 1_000 for one, too."""
    try:
        float(word)
    except ValueError:
        return False
    return True


def read_table(path):
    """The columns of a .dat file by name; by their place where the names do not fit."""
    lines = path.read_text(encoding="utf-8").splitlines()
    rows = [re.split(r"[()\s]+", line.split("#")[0]) for line in lines]
    rows = [row for row in rows if any(row)]
    width = len(rows[0]) if rows else 0
    if any(len(row) > width for row in rows):
        raise ValueError(f"{path.name}: a row has more cells than the first")
    rows = [row + [""] * (width - len(row)) for row in rows]
    columns = [column for column in zip(*rows) if any(column)]
    comments = [line.strip() for line in lines[:20] if line.strip().startswith("#")]
    names = comments[-1].lstrip("#").split() if comments else []
    if len(names) != len(columns):
        names = range(len(columns))
    return {
        name: np.array(column, dtype=float if all(map(is_number, column)) else str)
        for name, column in zip(names, columns)
    }


def outputs(case):
    """Tables of the case: (folder below postProcessing, time, file)."""
    root = case / "postProcessing"
    for path in sorted(root.rglob("*")):
        if path.is_file() and is_number(path.parent.name):
            yield path.parent.parent.relative_to(root), path.parent.name, path


def check_table(verdict, title, path, text):
    """Each column has its name, and the number that a plain look at the file finds."""
    table = read_table(path)
    lines = path.read_text(encoding="ascii").splitlines()
    head = [line for line in lines if line.startswith("#")][-1][1:]
    cells = [line.split("\t") for line in lines if not line.startswith("#")]
    names = [name.strip() for name in head.split("\t")]
    problem = ""
    if not cells:
        problem = "" if path.name == "droplets.dat" else "it has no rows"
    elif list(table) != names:
        problem = f"columns {list(table)[:3]}... instead of {names[:3]}..."
    else:
        for i, name in enumerate(names):
            plain = [row[i].strip() for row in cells]
            if name in text:
                same = list(table[name]) == plain
            else:
                numeric = table[name].dtype == float and all(map(is_number, plain))
                same = numeric and list(table[name]) == list(map(float, plain))
            problem = problem or ("" if same else f"{name} differs")
    verdict.check(f"foamlib reads {title}", not problem, problem or f"{len(cells)} rows")


def check_series(verdict, title, path):
    """Times rise, and each file is read and tells its time."""
    files = json.loads(path.read_text(encoding="utf-8"))["files"]
    times = [float(entry["time"]) for entry in files]
    problem = "" if files and sorted(set(times)) == times else "times do not rise"
    for entry, time in zip(files, times):
        file = path.parent / entry["name"]
        if file.suffix != ".vtp":
            problem = problem or f"no reader of {file.suffix}"
        elif Surface(file).time != time:
            problem = problem or f"{file.name} is of another time"
    verdict.check(f"PyVista reads {title}", not problem, problem or f"{len(files)} times")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("case", type=Path)
    case = parser.parse_args().case
    verdict = Verdict()
    seen = set()
    nSeries = 0
    for folder, time, path in outputs(case):
        title = f"{folder}/{time}/{path.name}"
        if path.suffix == ".dat":
            seen.add(path.name)
            check_table(verdict, title, path, TEXTS.get(path.name, ()))
        elif path.suffix == ".series":
            nSeries += 1
            check_series(verdict, title, path)
    verdict.check("all tables are there", seen == set(TABLES), " ".join(sorted(seen)))
    verdict.check("lists are there", nSeries >= 3, f"{nSeries}")
    verdict.leave()


if __name__ == "__main__":
    main()
