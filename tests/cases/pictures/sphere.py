# SPDX-License-Identifier: GPL-3.0-or-later
"""The sphere of makeResults.C, told a second time: what files and pictures must show."""
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

N_AROUND, N_HIGH = 96, 48
CENTRE = np.array([0.35, 0.5, 0.55])
RADIUS = 0.22
CAP = 0.8  # latitude from which on all is attached; 1 is the pole
SWATCH = np.array([1 - 1 / 64, 1 / 128])  # of what attached
TEXTURE = 1024

failed = False


def verdict(name, good, why=""):
    """One line for Alltest."""
    global failed
    print(f"PASS {name}" if good else f"FAIL {name}: {why}", flush=True)
    failed = failed or not good


def png(path):
    """Pixels as [row from below, column, rgb], 0 to 255."""
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    pixels = vtk_to_numpy(image.GetPointData().GetScalars())
    return pixels.reshape(height, width, -1)[:, :, :3].astype(float)


def parameter(u, v):
    """p where longitude and latitude are u and v, both from 0 to 1."""
    return np.stack([0.04 + 0.92 * u, 0.06 + 0.92 * v], axis=-1)
