// SPDX-License-Identifier: GPL-3.0-or-later

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>

#include "vtk/NoFloatingPointTraps.H"
#include "vtk/VtpWriter.H"

#include "core/results/ParameterTexture.H"
#include "core/results/PieceList.H"
#include "core/base/FileReplacement.H"
#include "core/base/Version.H"

#include <algorithm>
#include <stdexcept>

namespace Foam::stability
{

namespace
{

vtkSmartPointer<vtkPoints> vtkPointsOf(const pointField& points)
{
    auto result = vtkSmartPointer<vtkPoints>::New();
    result->SetDataTypeToDouble();
    result->SetNumberOfPoints(points.size());
    forAll(points, pointi)
    {
        const point& x = points[pointi];
        result->SetPoint(pointi, x.x(), x.y(), x.z());
    }
    return result;
}

vtkSmartPointer<vtkCellArray> polygons(const List<triFace>& triangles)
{
    auto result = vtkSmartPointer<vtkCellArray>::New();
    result->AllocateExact(triangles.size(), 3 * vtkIdType(triangles.size()));
    for (const triFace& t : triangles)
    {
        result->InsertNextCell({vtkIdType(t[0]), vtkIdType(t[1]), vtkIdType(t[2])});
    }
    return result;
}

vtkSmartPointer<vtkCellArray> vertices(label nPoints)
{
    auto result = vtkSmartPointer<vtkCellArray>::New();
    result->AllocateExact(nPoints, nPoints);
    for (label pointi = 0; pointi < nPoints; ++pointi)
    {
        result->InsertNextCell({vtkIdType(pointi)});
    }
    return result;
}

template<class VtkArray>
vtkSmartPointer<vtkDataArray> filled(const PointArray& array, label nPoints)
{
    auto result = vtkSmartPointer<VtkArray>::New();
    result->SetName(array.name.c_str());
    result->SetNumberOfComponents(array.nComponents);
    result->SetNumberOfTuples(nPoints);
    for (std::size_t i = 0; i < array.values.size(); ++i)
    {
        result->SetValue(
            vtkIdType(i), static_cast<typename VtkArray::ValueType>(array.values[i])
        );
    }
    return result;
}

void addArray(vtkPolyData& data, const PointArray& array, label nPoints)
{
    if (array.values.size() != std::size_t(nPoints) * array.nComponents)
    {
        throw std::runtime_error(
            "The array " + array.name + " does not have " + std::to_string(nPoints)
            + " times " + std::to_string(array.nComponents) + " values."
        );
    }
    vtkSmartPointer<vtkDataArray> values;
    if (array.integer)
    {
        values = filled<vtkTypeInt32Array>(array, nPoints);
    }
    else
    {
        values = filled<vtkDoubleArray>(array, nPoints);
    }
    if (isTexture(array))
    {
        data.GetPointData()->SetTCoords(values);
    }
    else
    {
        data.GetPointData()->AddArray(values);
    }
}

// The name by which VTK's readers find the time of a file.
void addTime(vtkPolyData& data, scalar time)
{
    vtkNew<vtkDoubleArray> value;
    value->SetName("TimeValue");
    value->InsertNextValue(time);
    data.GetFieldData()->AddArray(value);
}

void addGenerator(vtkPolyData& data)
{
    vtkNew<vtkStringArray> name;
    name->SetName("generator");
    name->InsertNextValue(generator());
    data.GetFieldData()->AddArray(name);
}

// A reader that shows it face-on must know of the section.
void addSection(vtkPolyData& data, const vector& normal)
{
    vtkNew<vtkDoubleArray> value;
    value->SetName("sectionNormal");
    value->SetNumberOfComponents(3);
    value->InsertNextTuple3(normal.x(), normal.y(), normal.z());
    data.GetFieldData()->AddArray(value);
}

vtkSmartPointer<vtkPolyData> polyData(const ResultSurface& surface)
{
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(vtkPointsOf(surface.points));
    if (surface.triangles.empty())
    {
        data->SetVerts(vertices(surface.points.size()));
    }
    else
    {
        data->SetPolys(polygons(surface.triangles));
    }
    for (const PointArray& array : surface.arrays)
    {
        addArray(*data, array, surface.points.size());
    }
    addTime(*data, surface.time);
    addGenerator(*data);
    if (surface.sectionNormal)
    {
        addSection(*data, *surface.sectionNormal);
    }
    return data;
}

[[noreturn]] void fail(const std::string& path, unsigned long errorCode)
{
    throw std::runtime_error(
        "Cannot write the file " + path + ": "
        + vtkErrorCode::GetStringFromErrorCode(errorCode) + "."
    );
}

class VtpWriter : public ResultWriter
{
public:
    void writeVtp(const std::string& path, const ResultSurface& surface) const override
    {
        const NoFloatingPointTraps guard;
        vtkNew<vtkXMLPolyDataWriter> writer;
        writer->SetInputData(polyData(surface));
        writer->SetDataModeToAppended();
        writer->EncodeAppendedDataOff(); // raw bytes: smaller and faster than base64
        writer->SetCompressorTypeToZLib();
        writer->SetCompressionLevel(1); // faster by a third, files 1 % larger
        writer->SetByteOrderToLittleEndian();
        // Through memory: VTK's own file output does not say why a disk refuses.
        writer->WriteToOutputStringOn();
        if (!writer->Write() || writer->GetErrorCode() != vtkErrorCode::NoError)
        {
            fail(path, writer->GetErrorCode());
        }
        const std::string bytes = writer->GetOutputString();
        replaceFile(path, bytes.data(), bytes.size());
    }

    // VTK's own writer of such files would write the pieces, too, and all by itself.
    void writePvtp(
        const std::string& path, const ResultSurface& aPiece,
        const std::vector<std::string>& pieces
    ) const override
    {
        replaceFile(path, pieceList(aPiece, pieces));
    }

    void writeTexture(const std::string& path, int size) const override
    {
        const NoFloatingPointTraps guard;
        const std::vector<Colour> pixels = parameterTexture(size);
        vtkNew<vtkImageData> image; // rows from below upwards, as ours
        image->SetDimensions(size, size, 1);
        image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
        auto* to = static_cast<unsigned char*>(image->GetScalarPointer());
        for (const Colour& pixel : pixels)
        {
            to = std::copy(pixel.begin(), pixel.end(), to);
        }

        vtkNew<vtkPNGWriter> writer;
        writer->SetInputData(image);
        writer->WriteToMemoryOn();
        writer->Write();
        vtkUnsignedCharArray* bytes = writer->GetResult();
        if (!bytes || writer->GetErrorCode() != vtkErrorCode::NoError)
        {
            fail(path, writer->GetErrorCode());
        }
        replaceFile(path, bytes->GetPointer(0), bytes->GetNumberOfValues());
    }
};

} // namespace

extern "C" ResultWriter* interfaceStabilityNewVtpWriter()
{
    return new VtpWriter;
}

} // namespace Foam::stability
