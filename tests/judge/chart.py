# SPDX-License-Identifier: GPL-3.0-or-later
"""The chart of a run: where on the start surface a parameter lies."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import mutable, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkStaticCellLocator


class Locator:
    """The point of a triangle mesh closest to a given one."""

    def __init__(self, points, triangles):
        self.points = np.ascontiguousarray(points, dtype=float)
        self.triangles = triangles
        flat = np.column_stack([np.full(len(triangles), 3), triangles]).astype(np.int64)
        cells = vtkCellArray()
        cells.ImportLegacyFormat(numpy_to_vtkIdTypeArray(flat.ravel(), deep=1))
        vertices = vtkPoints()
        vertices.SetData(numpy_to_vtk(self.points, deep=1))
        self.data = vtkPolyData()
        self.data.SetPoints(vertices)
        self.data.SetPolys(cells)
        self.locator = vtkStaticCellLocator()
        self.locator.SetDataSet(self.data)
        self.locator.BuildLocator()

    def closest(self, queries):
        """Closest points, the triangles that hold them, and distances."""
        n = len(queries)
        places, cells, squares = np.zeros((n, 3)), np.zeros(n, dtype=int), np.zeros(n)
        place, cell, part, square = [0.0] * 3, mutable(0), mutable(0), mutable(0.0)
        for i, query in enumerate(queries):
            self.locator.FindClosestPoint(query, place, cell, part, square)
            places[i], cells[i], squares[i] = place, cell.get(), square.get()
        return places, cells, np.sqrt(squares)


class Chart:
    """Made from timeSurface_000000: the start surface with its injective p."""

    def __init__(self, start):
        whole = np.all(start.has_p()[start.triangles], axis=1)
        self.triangles = start.triangles[whole]
        self.places = start.points
        uv = start["parameter"]
        self.locator = Locator(np.column_stack([uv, np.zeros(len(uv))]), self.triangles)
        a, b, c = (uv[self.triangles[:, i]] for i in range(3))
        twice = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
        self.flipped = int(np.sum(twice <= 0)) if np.sum(twice) > 0 else int(np.sum(twice >= 0))
        self.area = np.abs(twice).sum() / 2  # in units of p
        self.scale = np.sqrt(self.area / start.triangle_areas()[whole].sum())

    def place(self, parameters):
        """Positions on the start surface, and how far outside the charts p lies,
        in metres by the mean scale of the chart."""
        queries = np.column_stack([parameters, np.zeros(len(parameters))])
        points, cells, outside = self.locator.closest(queries)
        corners = self.triangles[cells]
        weights = barycentric(points[:, :2], self.locator.points[:, :2], corners)
        places = np.einsum("ij,ijk->ik", weights, self.places[corners])
        return places, outside / self.scale


def barycentric(points, vertices, corners):
    a, b, c = (vertices[corners[:, i]] for i in range(3))

    def cross(p, q):
        return p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]

    whole = cross(b - a, c - a)
    v = cross(points - a, c - a) / whole
    w = cross(b - a, points - a) / whole
    return np.column_stack([1 - v - w, v, w])
