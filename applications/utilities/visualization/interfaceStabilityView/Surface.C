// SPDX-License-Identifier: GPL-3.0-or-later

#include "Surface.H"

#include "Colours.H"
#include "Messages.H"
#include "VectorOperators.H"

#include "vtk/PolyDataCheck.H"
#include "vtk/Trial.H"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>
#include <vtkPointGaussianMapper.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkXMLPPolyDataReader.h>
#include <vtkXMLPolyDataReader.h>

#include <stdexcept>
#include <unordered_map>
#include <vector>

namespace Foam::stability
{

namespace
{

void checkReadable(const std::filesystem::path& path)
{
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored))
    {
        throw std::runtime_error("There is no file " + path.string() + ".");
    }
}

void checkRead(const std::filesystem::path& path, bool complete)
{
    const std::string error = takeError();
    if (!complete || !error.empty())
    {
        throw std::runtime_error(
            "Cannot read the file " + path.string() + ": "
            + (error.empty() ? "it is damaged or of another kind." : error)
        );
    }
}

// Paper 5.1: opacity by the angle between normal and line of sight.
void modulateOpacity(vtkActor& actor)
{
    actor.GetShaderProperty()->AddFragmentShaderReplacement(
        "//VTK::Light::Impl", true,
        "//VTK::Light::Impl\n"
        "  float facing = abs(dot(normalVCVSOutput, normalize(vertexVC.xyz)));\n"
        "  gl_FragData[0].a = mix(1.0, gl_FragData[0].a, facing);\n",
        false
    );
}

// Particles whose state is moving or stuck: the others are not in the fluid.
vtkSmartPointer<vtkPolyData> present(vtkPolyData& particles)
{
    constexpr int moving = 0, stuck = 2;
    vtkDataArray* state = particles.GetPointData()->GetArray("state");
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> vertices;
    for (vtkIdType i = 0; i < particles.GetNumberOfPoints(); ++i)
    {
        const int s = state ? int(state->GetComponent(i, 0)) : moving;
        if (s == moving || s == stuck)
        {
            vertices->InsertNextCell({points->InsertNextPoint(particles.GetPoint(i))});
        }
    }
    auto result = vtkSmartPointer<vtkPolyData>::New();
    result->SetPoints(points);
    result->SetVerts(vertices);
    return result;
}

template<class Reader>
vtkSmartPointer<vtkXMLReader> readerOf()
{
    return vtkSmartPointer<Reader>::New();
}

} // namespace

vtkSmartPointer<vtkPolyData> readSurface(const std::filesystem::path& path)
{
    checkReadable(path);
    const bool pieces = path.extension() == ".pvtp";
    const auto reader =
        pieces ? readerOf<vtkXMLPPolyDataReader>() : readerOf<vtkXMLPolyDataReader>();
    const auto read = [&]() -> vtkPolyData*
    {
        reader->SetFileName(path.c_str());
        reader->Update();
        auto* surface = vtkPolyData::SafeDownCast(reader->GetOutputDataObject(0));
        const bool complete =
            reader->GetErrorCode() == 0 && surface && surface->GetPoints();
        return complete && isSound(*surface) ? surface : nullptr;
    };
    // VTK's reader trusts the sizes that a file tells.
    const auto ends = [&] { return read() || true; };
    vtkPolyData* surface =
        succeedsInChild(ends, secondsToRead(path)) ? read() : nullptr;
    checkRead(path, surface);
    return surface;
}

vtkSmartPointer<vtkTexture> readTexture(const std::filesystem::path& path)
{
    checkReadable(path);
    vtkNew<vtkPNGReader> reader;
    const auto read = [&]
    {
        reader->SetFileName(path.c_str());
        reader->Update();
        return reader->GetOutput()->GetNumberOfPoints() > 1;
    };
    // A damaged file makes VTK's reader jump to where it was before.
    const bool isPng =
        reader->CanReadFile(path.c_str()) && succeedsInChild(read, secondsToRead(path));
    checkRead(path, isPng && read());
    auto texture = vtkSmartPointer<vtkTexture>::New();
    texture->SetInputData(reader->GetOutput());
    texture->InterpolateOn();
    // Grid lines must not flicker where the surface is far or seen at a slant. The
    // black of attached triangles stays clean: their texture coordinates are constant.
    texture->MipmapOn();
    texture->SetMaximumAnisotropicFiltering(8);
    texture->RepeatOff();
    texture->EdgeClampOn();
    return texture;
}

// Points are split along the seams of p, and the light must not show those.
vtkSmartPointer<vtkFloatArray> surfaceNormals(vtkPolyData& data)
{
    const vtkIdType nPoints = data.GetNumberOfPoints();
    vtkDataArray* vertex = data.GetPointData()->GetArray("vertex");
    std::vector<vtkIdType> place(nPoints);
    std::unordered_map<double, vtkIdType> placeOf;
    for (vtkIdType i = 0; i < nPoints; ++i)
    {
        const double name = vertex ? vertex->GetComponent(i, 0) : double(i);
        place[i] = placeOf.emplace(name, vtkIdType(placeOf.size())).first->second;
    }

    std::vector<vtkVector3d> sums(placeOf.size(), vtkVector3d(0, 0, 0));
    vtkIdType n = 0;
    const vtkIdType* corners = nullptr;
    vtkCellArray* polys = data.GetPolys();
    for (polys->InitTraversal(); polys->GetNextCell(n, corners);)
    {
        vtkVector3d a, b, c;
        data.GetPoint(corners[0], a.GetData());
        data.GetPoint(corners[1], b.GetData());
        data.GetPoint(corners[2], c.GetData());
        const vtkVector3d area = (b - a).Cross(c - a);
        for (vtkIdType k = 0; k < n; ++k)
        {
            sums[place[corners[k]]] = sums[place[corners[k]]] + area;
        }
    }

    auto result = vtkSmartPointer<vtkFloatArray>::New();
    result->SetName("Normals");
    result->SetNumberOfComponents(3);
    result->SetNumberOfTuples(nPoints);
    for (vtkIdType i = 0; i < nPoints; ++i)
    {
        vtkVector3d normal = sums[place[i]];
        normal.Normalize();
        result->SetTuple(i, normal.GetData());
    }
    return result;
}

vtkSmartPointer<vtkActor>
surfaceActor(vtkPolyData& interface, vtkTexture& texture, double opacity)
{
    vtkNew<vtkPolyData> shape;
    shape->ShallowCopy(&interface);
    shape->GetPointData()->SetNormals(surfaceNormals(interface));
    vtkPointData* arrays = shape->GetPointData();
    if (vtkDataArray* coordinates = arrays->GetArray("TCoords"))
    {
        arrays->SetTCoords(coordinates);
    }
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(shape);
    mapper->ScalarVisibilityOff();

    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    actor->SetTexture(&texture);
    vtkProperty* property = actor->GetProperty();
    property->SetColor(1, 1, 1);
    property->SetAmbient(0.62); // soft: the colours must stay those of the legend
    property->SetDiffuse(0.42);
    property->SetSpecular(0);
    property->SetOpacity(opacity);
    actor->ForceTranslucentOn();
    modulateOpacity(*actor);
    return actor;
}

vtkSmartPointer<vtkActor> particleActor(vtkPolyData& particles, double radius)
{
    vtkNew<vtkPointGaussianMapper> mapper;
    mapper->SetInputData(present(particles));
    mapper->ScalarVisibilityOff();
    mapper->EmissiveOff();                // with depth peeling
    mapper->SetScaleFactor(radius / 2.5); // a splat fades within 2.5 of its widths

    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    actor->ForceTranslucentOn();
    paint(*actor->GetProperty(), colours::detached);
    return actor;
}

} // namespace Foam::stability
