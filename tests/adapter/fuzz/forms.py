# SPDX-License-Identifier: GPL-3.0-or-later
"""forms.py RESULTS FOLDER: the interfaces there in all forms that fromFiles reads."""

import shutil
import sys
from pathlib import Path

from vtkmodules.vtkIOGeometry import vtkOBJWriter, vtkSTLWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter


def written(data, path, form):
    """One surface, as VTK's writer puts it in this form."""
    if form in ("stl", "obj"):
        writer = vtkSTLWriter() if form == "stl" else vtkOBJWriter()
    else:
        writer = vtkXMLPolyDataWriter()
        writer.SetDataMode(
            {"ascii": writer.Ascii, "inline": writer.Binary}.get(form, writer.Appended)
        )
        writer.SetEncodeAppendedData(form == "base64")
        if form == "lz4":
            writer.SetCompressorTypeToLZ4()
        elif form != "base64":
            writer.SetCompressorTypeToNone()
        if form == "raw":
            writer.SetHeaderTypeToUInt64()
    writer.SetInputData(data)
    writer.SetFileName(str(path))
    if not writer.Write():
        sys.exit(f"{path} cannot be written")


for form in ("own", "ascii", "inline", "raw", "base64", "lz4", "stl", "obj"):
    folder = Path(sys.argv[2]) / form
    folder.mkdir()
    for source in sorted(Path(sys.argv[1]).glob("interface_*.vtp")):
        if form == "own":
            shutil.copy(source, folder)
            continue
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(source))
        reader.Update()
        end = form if form in ("stl", "obj") else "vtp"
        written(reader.GetOutput(), folder / f"{source.stem}.{end}", form)
