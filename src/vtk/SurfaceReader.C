// SPDX-License-Identifier: GPL-3.0-or-later

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkSmartPointer.h>
#include <vtkStringOutputWindow.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>

#include "vtk/NoFloatingPointTraps.H"
#include "vtk/PolyDataCheck.H"
#include "vtk/SurfaceReader.H"
#include "vtk/Trial.H"

#include <stdexcept>

namespace Foam::stability
{

namespace
{

[[noreturn]] void fail(const std::string& path, const std::string& cause)
{
    throw std::runtime_error("Cannot read the surface " + path + ": " + cause + ".");
}

// VTK prints its errors; while this lives they are kept instead.
class KeptMessages
{
public:
    KeptMessages()
        : before_(vtkOutputWindow::GetInstance()),
          verbosity_(vtkLogger::GetCurrentVerbosityCutoff())
    {
        vtkOutputWindow::SetInstance(kept_);
        vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    }
    ~KeptMessages()
    {
        vtkOutputWindow::SetInstance(before_);
        vtkLogger::SetStderrVerbosity(verbosity_);
    }
    KeptMessages(const KeptMessages&) = delete;
    void operator=(const KeptMessages&) = delete;

    // The first error in one line; empty if there is none.
    std::string firstError()
    {
        const std::string text = kept_->GetOutput();
        const std::string::size_type error = text.find("ERROR");
        const std::string::size_type colon = text.find("): ", error);
        if (error == text.npos || colon == text.npos)
        {
            return error == text.npos ? "" : "it is damaged";
        }
        const std::string::size_type end = text.find_first_of(".\n", colon + 3);
        return text.substr(colon + 3, end - colon - 3);
    }

private:
    vtkNew<vtkStringOutputWindow> kept_;
    vtkSmartPointer<vtkOutputWindow> before_;
    vtkLogger::Verbosity verbosity_;
};

template<class Reader>
vtkSmartPointer<vtkPolyData>
readWith(const vtkNew<Reader>& reader, const std::string& path)
{
    KeptMessages messages;
    reader->SetFileName(path.c_str());
    // VTK's readers trust the sizes that a file tells.
    const auto ends = [&]
    {
        reader->Update();
        isSound(*reader->GetOutput()); // that it ends is what counts
        return true;
    };
    if (!succeedsInChild(ends, secondsToRead(path)))
    {
        fail(path, "it is damaged");
    }
    reader->Update();
    std::string cause = messages.firstError();
    if (cause.empty() && reader->GetErrorCode() != vtkErrorCode::NoError)
    {
        cause = vtkErrorCode::GetStringFromErrorCode(reader->GetErrorCode());
    }
    if (cause.empty() && !isSound(*reader->GetOutput()))
    {
        cause = "a polygon has a point that is not there, or fewer than three";
    }
    if (!cause.empty())
    {
        fail(path, cause);
    }
    vtkNew<vtkTriangleFilter> triangles;
    triangles->PassVertsOff();
    triangles->PassLinesOff();
    triangles->SetInputConnection(reader->GetOutputPort());
    triangles->Update();
    return triangles->GetOutput();
}

vtkSmartPointer<vtkPolyData> readVtp(const std::string& path)
{
    vtkNew<vtkXMLPolyDataReader> reader;
    if (!reader->CanReadFile(path.c_str()))
    {
        fail(path, "it is no VTK file of PolyData");
    }
    return readWith(reader, path);
}

vtkSmartPointer<vtkPolyData> readStl(const std::string& path)
{
    vtkNew<vtkSTLReader> reader;
    reader->MergingOff(); // points are welded by us, in the order of the file
    return readWith(reader, path);
}

vtkSmartPointer<vtkPolyData> readObj(const std::string& path)
{
    vtkNew<vtkOBJReader> reader;
    return readWith(reader, path);
}

void addTriangles(vtkPolyData& data, GivenSurface& surface)
{
    vtkCellArray* cells = data.GetPolys();
    surface.triangles.setSize(cells->GetNumberOfCells());
    for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i)
    {
        vtkIdType n = 0;
        const vtkIdType* corners = nullptr;
        cells->GetCellAtId(i, n, corners);
        for (label k = 0; k < 3; ++k)
        {
            if (n != 3 || corners[k] < 0 || corners[k] >= surface.points.size())
            {
                fail(surface.name, "a triangle has no three points");
            }
            surface.triangles[i][k] = corners[k];
        }
    }
}

// One value per point; null where there are none of this name.
vtkDataArray* valuesOf(vtkPolyData& data, const char* name)
{
    vtkDataArray* values = data.GetPointData()->GetArray(name);
    const bool onePerPoint = values && values->GetNumberOfComponents() == 1
                             && values->GetNumberOfTuples() == data.GetNumberOfPoints();
    return onePerPoint ? values : nullptr;
}

// Files that interfaceStability wrote may hold these arrays besides points and
// triangles.
void addArrays(vtkPolyData& data, GivenSurface& surface)
{
    if (vtkDataArray* vertex = valuesOf(data, "vertex"))
    {
        surface.welding = Welding::byName;
        surface.vertex.setSize(surface.points.size());
        forAll(surface.vertex, i)
        {
            surface.vertex[i] = label(vertex->GetComponent(i, 0));
        }
    }
    if (vtkDataArray* cellSize = valuesOf(data, "cellSize"))
    {
        surface.cellSizes.setSize(surface.points.size());
        forAll(surface.cellSizes, i)
        {
            surface.cellSizes[i] = cellSize->GetComponent(i, 0);
        }
    }
}

bool endsWith(const std::string& text, const std::string& end)
{
    return text.size() >= end.size()
           && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

class VtkSurfaceReader : public SurfaceReader
{
public:
    GivenSurface read(const std::string& path) const override
    {
        const NoFloatingPointTraps guard;
        const bool vtp = endsWith(path, ".vtp");
        const vtkSmartPointer<vtkPolyData> data = vtp ? readVtp(path)
                                                  : endsWith(path, ".stl")
                                                      ? readStl(path)
                                                      : readObj(path);
        GivenSurface surface;
        surface.name = path;
        surface.points.setSize(data->GetNumberOfPoints());
        forAll(surface.points, i)
        {
            double x[3];
            data->GetPoint(i, x);
            surface.points[i] = point(x[0], x[1], x[2]);
        }
        addTriangles(*data, surface);
        if (vtp)
        {
            addArrays(*data, surface);
        }
        else
        {
            surface.welding = Welding::byPosition;
        }
        return surface;
    }
};

} // namespace

extern "C" SurfaceReader* interfaceStabilityNewSurfaceReader()
{
    return new VtkSurfaceReader;
}

} // namespace Foam::stability
