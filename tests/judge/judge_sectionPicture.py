# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges the picture of a dam break in two dimensions, seen face-on.

    judge_sectionPicture.py PICTURE
"""

import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

from results import Verdict

FLUID = np.array([0.76, 0.88, 0.97]) * 255
WALL = np.array([0.45, 0.45, 0.45]) * 255
RED = np.array([0.86, 0.04, 0.06]) * 255

reader = vtkPNGReader()
reader.SetFileName(sys.argv[1])
reader.Update()
image = reader.GetOutput()
width, height, _ = image.GetDimensions()
pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[..., :3]
scene = pixels[:, : int(0.77 * width)].astype(float)  # without the legend
verdict = Verdict()


def near(colour, tolerance=6):
    return (np.abs(scene - colour) <= tolerance).all(axis=2)


rows, columns = np.nonzero(near(WALL))
box = (rows.max() - rows.min()) / (columns.max() - columns.min())
verdict.at_most("the tank is as high as broad, but for", abs(box - 1), 0.01)
inside = scene[rows.min() : rows.max(), columns.min() : columns.max()]
area = inside.shape[0] * inside.shape[1]
fluid = near(FLUID)[rows.min() : rows.max(), columns.min() : columns.max()].sum() / area
verdict.check("a tenth to a fifth is fluid", 0.08 < fluid < 0.2, f"{fluid:.3f}")
air = near([255] * 3)[rows.min() : rows.max(), columns.min() : columns.max()].sum() / area
verdict.check("most is air", air > 0.7, f"{air:.3f}")
verdict.check(
    "the fluid lies below",
    near(FLUID)[: scene.shape[0] // 3].sum() > 0.8 * near(FLUID).sum(),
    "",
)
verdict.at_least("black pixels of what attached", near([0, 0, 0]).sum(), 200)
verdict.at_least("red pixels of particles", near(RED, 30).sum(), 200)
colours = (scene.max(axis=2) - scene.min(axis=2) > 60) & ~near(FLUID, 12) & (scene[..., 0] < 215)
verdict.at_least("pixels with colours of p", colours.sum(), 500)
verdict.leave()
