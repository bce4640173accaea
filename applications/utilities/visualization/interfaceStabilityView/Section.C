// SPDX-License-Identifier: GPL-3.0-or-later

#include "Section.H"

#include "Surface.H"
#include "VectorOperators.H"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCleanPolyData.h>
#include <vtkDataArray.h>
#include <vtkFeatureEdges.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolygon.h>
#include <vtkProperty.h>

#include <cmath>
#include <vector>

namespace Foam::stability
{

namespace
{

vtkVector3d pointOf(vtkPolyData& data, vtkIdType i)
{
    vtkVector3d x;
    data.GetPoint(i, x.GetData());
    return x;
}

vtkVector3d atHeight(const vtkVector3d& x, const vtkVector3d& normal, double height)
{
    return x + (height - x.Dot(normal)) * normal;
}

// The share of the face's area vector that is along the normal: 1 where it looks along
// it, 0 where it stands on the plane.
double facing(
    vtkPolyData& data, vtkIdType n, const vtkIdType* points, const vtkVector3d& normal
)
{
    vtkVector3d area(0, 0, 0);
    const vtkVector3d first = pointOf(data, points[0]);
    for (vtkIdType k = 1; k + 1 < n; ++k)
    {
        const vtkVector3d a = pointOf(data, points[k]) - first;
        const vtkVector3d b = pointOf(data, points[k + 1]) - first;
        area = area + a.Cross(b);
    }
    const double size = area.Norm();
    return size > 0 ? area.Dot(normal) / size : 0;
}

void withPoints(vtkPolyData& shape, vtkPoints& points)
{
    points.Modified();
    shape.SetPoints(&points);
}

} // namespace

std::optional<vtkVector3d> sectionNormal(vtkPolyData& result)
{
    vtkDataArray* normal = result.GetFieldData()->GetArray("sectionNormal");
    if (!normal || normal->GetNumberOfComponents() != 3
        || normal->GetNumberOfTuples() < 1)
    {
        return std::nullopt;
    }
    vtkVector3d value;
    normal->GetTuple(0, value.GetData());
    return value;
}

vtkSmartPointer<vtkPolyData>
flattened(vtkPolyData& shape, const vtkVector3d& normal, double height)
{
    auto result = vtkSmartPointer<vtkPolyData>::New();
    result->ShallowCopy(&shape);
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(shape.GetNumberOfPoints());
    for (vtkIdType i = 0; i < shape.GetNumberOfPoints(); ++i)
    {
        points->SetPoint(i, atHeight(pointOf(shape, i), normal, height).GetData());
    }
    withPoints(*result, *points);
    return result;
}

vtkSmartPointer<vtkPolyData> facingFaces(vtkPolyData& shape, const vtkVector3d& normal)
{
    auto result = vtkSmartPointer<vtkPolyData>::New();
    result->SetPoints(shape.GetPoints());
    vtkNew<vtkCellArray> faces;
    vtkCellData* from = shape.GetCellData();
    result->GetCellData()->CopyAllocate(from);
    vtkIdType celli = shape.GetNumberOfVerts() + shape.GetNumberOfLines();
    vtkIdType n = 0;
    const vtkIdType* points = nullptr;
    vtkCellArray* polys = shape.GetPolys();
    for (polys->InitTraversal(); polys->GetNextCell(n, points); ++celli)
    {
        if (facing(shape, n, points, normal) > 0.5)
        {
            const vtkIdType facei = faces->InsertNextCell(n, points);
            result->GetCellData()->CopyData(from, celli, facei);
        }
    }
    result->SetPolys(faces);
    return result;
}

vtkSmartPointer<vtkPolyData> sectionLines(vtkPolyData& faces, const vtkVector3d& normal)
{
    auto result = vtkSmartPointer<vtkPolyData>::New();
    result->SetPoints(faces.GetPoints());
    vtkNew<vtkCellArray> lines;
    vtkIdType n = 0;
    const vtkIdType* points = nullptr;
    vtkCellArray* polys = faces.GetPolys();
    for (polys->InitTraversal(); polys->GetNextCell(n, points);)
    {
        if (std::abs(facing(faces, n, points, normal)) > 0.5)
        {
            continue;
        }
        for (vtkIdType k = 0; k < n; ++k)
        {
            const vtkIdType a = points[k], b = points[(k + 1) % n];
            const vtkVector3d edge = pointOf(faces, b) - pointOf(faces, a);
            if (std::abs(edge.Dot(normal)) < 0.5 * edge.Norm())
            {
                lines->InsertNextCell({a, b});
            }
        }
    }
    result->SetLines(lines);
    return result;
}

vtkSmartPointer<vtkPolyData> outlineOf(vtkPolyData& faces, const vtkVector3d& normal)
{
    vtkNew<vtkCleanPolyData> joined; // patches share no points in VTK's reader
    joined->SetInputData(facingFaces(faces, normal));
    vtkNew<vtkFeatureEdges> edges;
    edges->SetInputConnection(joined->GetOutputPort());
    edges->BoundaryEdgesOn();
    edges->FeatureEdgesOff();
    edges->NonManifoldEdgesOff();
    edges->ManifoldEdgesOff();
    edges->ColoringOff();
    edges->Update();
    return edges->GetOutput();
}

// The ribbon stands on the plane, so its normals are those of the line.
vtkSmartPointer<vtkPolyData>
broadLine(vtkPolyData& ribbon, const vtkVector3d& normal, double width, double height)
{
    const auto result = flattened(ribbon, normal, height);
    const auto normals = surfaceNormals(ribbon);
    double low = 0, high = 0;
    for (vtkIdType i = 0; i < ribbon.GetNumberOfPoints(); ++i)
    {
        const double across = pointOf(ribbon, i).Dot(normal);
        low = i == 0 ? across : std::min(low, across);
        high = i == 0 ? across : std::max(high, across);
    }
    const double middle = 0.5 * (low + high);
    for (vtkIdType i = 0; i < ribbon.GetNumberOfPoints(); ++i)
    {
        vtkVector3d aside;
        normals->GetTuple(i, aside.GetData());
        aside = aside - aside.Dot(normal) * normal;
        aside.Normalize();
        const double side = pointOf(ribbon, i).Dot(normal) < middle ? -0.5 : 0.5;
        const vtkVector3d x = pointOf(*result, i) + side * width * aside;
        result->GetPoints()->SetPoint(i, x.GetData());
    }
    return result;
}

vtkSmartPointer<vtkActor>
broadLineActor(vtkPolyData& line, vtkTexture& texture, double opacity)
{
    vtkNew<vtkPolyDataMapper> mapper;
    vtkPointData* arrays = line.GetPointData();
    if (vtkDataArray* coordinates = arrays->GetArray("TCoords"))
    {
        arrays->SetTCoords(coordinates);
    }
    mapper->SetInputData(&line);
    mapper->ScalarVisibilityOff();
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    actor->SetTexture(&texture);
    actor->GetProperty()->SetColor(1, 1, 1);
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->SetOpacity(opacity);
    return actor;
}

vtkSmartPointer<vtkActor> lightActor(vtkPolyData& faces)
{
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(&faces);
    mapper->SetScalarModeToUseCellData(); // they are colours
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff();
    return actor;
}

} // namespace Foam::stability
