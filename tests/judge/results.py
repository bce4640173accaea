# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run wrote, read back with VTK's own reader and nothing of the project."""

import json
import re
import sys
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

FAMILIES = ("interface", "timeSurface", "particles")


def generator():
    """The name by which files tell their program, with the version of CITATION.cff."""
    citation = Path(__file__).resolve().parents[2] / "CITATION.cff"
    text = citation.read_text(encoding="utf-8")
    return "interfaceStability " + re.search(r"^version: (\S+)$", text, re.MULTILINE)[1]


class Surface:
    """One .vtp file: points, triangles and the arrays over the points."""

    def __init__(self, path, Reader=vtkXMLPolyDataReader):
        self.path = Path(path)
        reader = Reader()
        errors = []
        reader.AddObserver("ErrorEvent", lambda *_: errors.append(1))
        reader.SetFileName(str(path))
        reader.Update()
        if errors:
            raise ValueError(f"{path}: VTK's reader reports an error")
        self.data = reader.GetOutput()
        points = self.data.GetPoints()
        n = self.data.GetNumberOfPoints()
        self.points = vtk_to_numpy(points.GetData()) if n else np.zeros((0, 3))
        self.pointType = points.GetData().GetDataTypeAsString() if points else ""
        self.triangles = self._triangles()
        fields = self.data.GetPointData()
        self.types = {}
        self.arrays = {}
        for i in range(fields.GetNumberOfArrays()):
            array = fields.GetArray(i)
            self.types[array.GetName()] = array.GetDataTypeAsString()
            self.arrays[array.GetName()] = (
                vtk_to_numpy(array)
                if n
                else np.zeros((0, array.GetNumberOfComponents())).squeeze()
            )
        stamp = self.data.GetFieldData().GetArray("TimeValue")
        self.time = stamp.GetTuple1(0) if stamp else None
        name = self.data.GetFieldData().GetAbstractArray("generator")
        self.generator = name.GetValue(0) if name else None

    def _triangles(self):
        polys = self.data.GetPolys()
        if polys.GetNumberOfCells() == 0:
            return np.zeros((0, 3), dtype=np.int64)
        offsets = vtk_to_numpy(polys.GetOffsetsArray())
        if not np.all(np.diff(offsets) == 3):
            raise ValueError(f"{self.path}: a cell is no triangle")
        return vtk_to_numpy(polys.GetConnectivityArray()).reshape(-1, 3).astype(np.int64)

    def __getitem__(self, name):
        return self.arrays[name]

    @property
    def n(self):
        return len(self.points)

    def triangle_areas(self):
        a, b, c = (self.points[self.triangles[:, i]] for i in range(3))
        return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)

    def point_areas(self):
        """A third of the area of the triangles around each point."""
        thirds = np.repeat(self.triangle_areas() / 3, 3)
        return np.bincount(self.triangles.ravel(), thirds, minlength=self.n)

    def inside_areas(self):
        """The same among the points that did not leave the domain; zero at the others."""
        inside = (self["stability"] != 3)[self.triangles]
        shares = self.triangle_areas()[:, None] * inside / np.maximum(inside.sum(axis=1), 1)[:, None]
        return np.bincount(self.triangles.ravel(), shares.ravel(), minlength=self.n)

    def share_beyond(self, distance):
        """By area, of what did not leave the domain: farther from the other surface."""
        areas = self.inside_areas()
        return areas[self["distance"] > distance].sum() / areas.sum()

    def has_p(self):
        return ~np.all(self["parameter"] == -1, axis=1)

    def welded(self):
        """The triangles in the ids that join what is split along seams."""
        return self["vertex"].astype(np.int64)[self.triangles]


class Run:
    """The folder postProcessing/interfaceStability/<startTime> of a case."""

    def __init__(self, case):
        case = Path(case)
        base = case / "postProcessing" / "interfaceStability"
        folders = sorted(base.glob("*")) if base.is_dir() else []
        self.folder = folders[0] if folders else case
        if not list(self.folder.glob("interface_*.*vtp")):
            raise FileNotFoundError(f"no results of interfaceStability under {case}")

    def paths(self, family):
        return sorted(self.folder.glob(f"{family}_[0-9]*.vtp"))

    def __len__(self):
        return len(self.paths("interface"))

    def surface(self, family, index):
        return Surface(self.folder / f"{family}_{index:06d}.vtp")

    def series(self, family):
        text = (self.folder / f"{family}.vtp.series").read_text(encoding="ascii")
        return json.loads(text)["files"]

    def table_generator(self, name):
        """The program that made a table, as its first line tells."""
        lines = (self.folder / name).read_text(encoding="ascii").splitlines()
        return lines[0][2:] if lines and lines[0].startswith("# ") else None

    def table(self, name):
        """Columns of a .dat file by their names, as the last comment line tells."""
        path = self.folder / name
        lines = path.read_text(encoding="ascii").splitlines()
        comments = [line for line in lines if line.startswith("#")]
        names = comments[-1].lstrip("#").split()
        rows = [line.split() for line in lines if line.strip() and line[0] != "#"]
        values = np.array(rows, dtype=float) if rows else np.zeros((0, len(names)))
        if values.ndim != 2 or values.shape[1] != len(names):
            raise ValueError(f"{path}: {len(names)} names for {values.shape} values")
        return {name: values[:, i] for i, name in enumerate(names)}


class Verdict:
    """Prints a line for each check; the exit status tells whether all passed."""

    def __init__(self):
        self.failures = 0

    def check(self, name, passed, why):
        if passed:
            print(f"PASS {name} ({why})" if why else f"PASS {name}")
        else:
            print(f"FAIL {name}: {why}")
            self.failures += 1

    def at_most(self, name, value, limit):
        self.check(name, value <= limit, f"{value:.4g}, allowed {limit:g}")

    def at_least(self, name, value, limit):
        self.check(name, value >= limit, f"{value:.4g}, at least {limit:g}")

    def leave(self):
        sys.exit(1 if self.failures else 0)
