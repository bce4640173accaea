// SPDX-License-Identifier: GPL-3.0-or-later

#include "Surroundings.H"

#include "Colours.H"

#include <vtkFeatureEdges.h>
#include <vtkNew.h>
#include <vtkOutlineSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTriangleFilter.h>
#include <vtkTrivialProducer.h>

namespace Foam::stability
{

namespace
{

vtkSmartPointer<vtkActor> lineActor(vtkAlgorithm& lines, double lineWidth)
{
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(lines.GetOutputPort());
    mapper->ScalarVisibilityOff();
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    paint(*actor->GetProperty(), colours::edge);
    actor->GetProperty()->SetLineWidth(float(lineWidth));
    actor->GetProperty()->LightingOff();
    return actor;
}

} // namespace

vtkSmartPointer<vtkActor> boxActor(const vtkBoundingBox& box, double lineWidth)
{
    double bounds[6];
    box.GetBounds(bounds);
    vtkNew<vtkOutlineSource> outline;
    outline->SetBounds(bounds);
    return lineActor(*outline, lineWidth);
}

vtkSmartPointer<vtkActor> linesActor(vtkPolyData& lines, double lineWidth)
{
    vtkNew<vtkTrivialProducer> source;
    source->SetOutput(&lines);
    return lineActor(*source, lineWidth);
}

vtkSmartPointer<vtkActor> wallActor(vtkPolyData& walls)
{
    vtkNew<vtkTriangleFilter> triangles; // faces may be polygons
    triangles->SetInputData(&walls);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(triangles->GetOutputPort());
    mapper->ScalarVisibilityOff();
    // Behind surfaces and lines that lie on the wall.
    mapper->SetResolveCoincidentTopologyToPolygonOffset();
    mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(2, 2);

    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    vtkProperty* property = actor->GetProperty();
    paint(*property, colours::wall);
    property->SetAmbient(0.6);
    property->SetDiffuse(0.45);
    property->SetSpecular(0);
    property->SetInterpolationToFlat();
    property->FrontfaceCullingOn(); // normals point out of the fluid
    return actor;
}

vtkSmartPointer<vtkActor> wallEdgeActor(vtkPolyData& walls, double lineWidth)
{
    vtkNew<vtkFeatureEdges> edges;
    edges->SetInputData(&walls);
    edges->SetFeatureAngle(40);
    edges->BoundaryEdgesOn();
    edges->FeatureEdgesOn();
    edges->NonManifoldEdgesOff();
    edges->ManifoldEdgesOff();
    edges->ColoringOff();
    return lineActor(*edges, lineWidth);
}

} // namespace Foam::stability
