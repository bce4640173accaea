# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges whether two runs wrote the same files, value for value, however these are encoded.

    judge_sameFiles.py CASE CASE [--particles]

With --particles there must be some.
"""

import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPPolyDataReader

from results import Run, Surface, Verdict

a, b = (Run(case).folder for case in sys.argv[1:3])
verdict = Verdict()


def contents(path):
    """All that a reader sees in a file of a surface, by name."""
    reader = vtkXMLPPolyDataReader if path.suffix == ".pvtp" else vtkXMLPolyDataReader
    surface = Surface(path, reader)
    fields = surface.data.GetFieldData()
    normal = fields.GetArray("sectionNormal")
    texture = surface.data.GetPointData().GetTCoords()
    return {
        "points": surface.points,
        "triangles": surface.triangles,
        "vertices": np.array(surface.data.GetNumberOfVerts()),
        "types": np.array(sorted(surface.types.items())),
        "time": np.array(surface.time),
        "generator": np.array(surface.generator),
        "normal": vtk_to_numpy(normal) if normal else np.zeros(0),
        "texture": np.array(texture.GetName() if texture else ""),
        **surface.arrays,
    }


def pixels(path):
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    image = reader.GetOutput()
    return image.GetDimensions(), vtk_to_numpy(image.GetPointData().GetScalars())


def names(folder):
    found = [p.relative_to(folder) for p in folder.rglob("*") if p.suffix in (".vtp", ".pvtp")]
    return sorted(found)


verdict.check("files", names(a) == names(b) and len(names(a)) > 5, f"{len(names(a))}, {len(names(b))}")
different, nTriangles, nVertices = [], 0, 0
for name in sorted(set(names(a)) & set(names(b))):
    one, other = contents(a / name), contents(b / name)
    nTriangles += len(one["triangles"])
    nVertices += int(one["vertices"])
    if one.keys() != other.keys():
        different.append(f"{name}: arrays")
        continue
    different += [
        f"{name}: {key}"
        for key in one
        if one[key].shape != other[key].shape or not np.array_equal(one[key], other[key])
    ]
verdict.check("values", not different, ", ".join(different[:4]))
enough = nTriangles > 0 and (nVertices > 0 or "--particles" not in sys.argv)
verdict.check("something to compare", enough, f"{nTriangles} triangles, {nVertices} particles")
(sizeA, colourA), (sizeB, colourB) = pixels(a / "texture.png"), pixels(b / "texture.png")
verdict.check("texture", sizeA == sizeB and np.array_equal(colourA, colourB), f"{sizeA}, {sizeB}")
verdict.leave()
