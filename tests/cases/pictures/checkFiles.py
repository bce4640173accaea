# SPDX-License-Identifier: GPL-3.0-or-later
"""checkFiles.py FOLDER GENERATOR: what the writer made, read back through VTK."""
import pathlib
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

import sphere
from sphere import verdict


def read(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetErrorCode(), reader.GetOutput()


def expected_sphere():
    u, v = np.meshgrid(
        np.arange(sphere.N_AROUND + 1) / sphere.N_AROUND,
        np.arange(sphere.N_HIGH + 1) / sphere.N_HIGH,
    )
    a, b = 2 * np.pi * u.ravel(), np.pi * (v.ravel() - 0.5)
    points = sphere.CENTRE + sphere.RADIUS * np.stack(
        [np.cos(b) * np.cos(a), np.cos(b) * np.sin(a), np.sin(b)], axis=1
    )
    attached = v.ravel() > sphere.CAP
    p = np.where(attached[:, None], sphere.SWATCH, sphere.parameter(u, v).reshape(-1, 2))
    return points, p, attached


def check_surface(folder, generator):
    code, data = read(folder / "interface_000000.vtp")
    points, p, attached = expected_sphere()
    read_points = vtk_to_numpy(data.GetPoints().GetData())
    verdict("points are doubles", read_points.dtype == np.float64, read_points.dtype)
    error = np.abs(read_points - points).max()
    verdict("points are written exactly", code == 0 and error < 1e-15, error)
    coordinates = data.GetPointData().GetTCoords()
    verdict("TCoords are active", coordinates is not None, "no texture coordinates")
    error = np.abs(vtk_to_numpy(coordinates) - p).max()
    verdict("TCoords are written exactly", error < 1e-15, error)
    stability = vtk_to_numpy(data.GetPointData().GetArray("stability"))
    verdict(
        "integers are 32 bit, and right",
        stability.dtype == np.int32 and np.array_equal(stability, attached),
        stability.dtype,
    )
    cells = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    a, b, c = (read_points[cells[:, k]] for k in range(3))
    outward = np.einsum("ij,ij->i", np.cross(b - a, c - a), a + b + c - 3 * sphere.CENTRE)
    verdict(
        "triangles keep their order and orientation",
        len(cells) == 2 * 96 * 47 and (outward > -1e-15).all(),
        f"{len(cells)} triangles, {(outward < 0).sum()} turned",
    )
    _, later = read(folder / "interface_000001.vtp")
    time = later.GetFieldData().GetArray("TimeValue")
    verdict("the time is in the file", time is not None and time.GetValue(0) == 0.02, time)
    told = later.GetFieldData().GetAbstractArray("generator")
    verdict("the generator is in the file", told and told.GetValue(0) == generator, told)


def check_others(folder):
    code, empty = read(folder / "interface_000002.vtp")
    verdict(
        "an empty interface is a legal file",
        code == 0 and empty.GetNumberOfPoints() == 0 and empty.GetNumberOfCells() == 0,
        f"error {code}",
    )
    code, cloud = read(folder / "particles_000001.vtp")
    vertices = vtk_to_numpy(cloud.GetVerts().GetConnectivityArray())
    verdict(
        "particles are vertices",
        code == 0 and np.array_equal(vertices, np.arange(1001)),
        f"error {code}, {len(vertices)} vertices",
    )
    head = (folder / "interface_000000.vtp").read_bytes()[:2000]
    verdict(
        "files are appended and compressed",
        b'format="appended"' in head and b"vtkZLibDataCompressor" in head,
        head[:120],
    )
    texture = sphere.png(folder / "texture.png")
    # v upwards: full colour above, pale below; black in the lower half of the swatches only.
    spread = texture.max(axis=2) - texture.min(axis=2)
    side = sphere.TEXTURE
    verdict(
        "the texture stands upright",
        texture.shape == (side, side, 3)
        and spread[-20:].mean() > 2 * spread[:20].mean()
        and texture[: side // 64, -(side // 32) :].max() == 0
        and texture[side // 64 + 2 : side // 32, -(side // 32) + 2 :].max() > 0
        and texture[side // 32 + 8, -8].min() > 50,
        texture.shape,
    )


def main():
    folder = pathlib.Path(sys.argv[1])
    check_surface(folder, sys.argv[2])
    check_others(folder)
    left = [f.name for f in folder.iterdir() if f.suffix not in (".vtp", ".series", ".png", ".dat")]
    verdict("no temporary file is left", not left, left)
    sys.exit(sphere.failed)


main()
