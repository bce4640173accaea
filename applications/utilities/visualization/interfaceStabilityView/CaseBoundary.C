// SPDX-License-Identifier: GPL-3.0-or-later

#include "CaseBoundary.H"

#include "Messages.H"

#include <vtkAppendPolyData.h>
#include <vtkCellArray.h>
#include <vtkCleanPolyData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOpenFOAMReader.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <regex>

namespace Foam::stability
{

namespace
{

namespace fs = std::filesystem;

// Patches of constant/polyMesh/boundary by name. VTK's reader knows the faces, but
// not the types.
std::map<std::string, std::string> patchTypes(const fs::path& boundary)
{
    static const std::regex patch(R"re(([^\s{}()";]+)\s*\{[^{}]*\btype\s+(\w+)\s*;)re");
    const std::string text = textOf(boundary);
    std::map<std::string, std::string> types;
    for (std::sregex_iterator it(text.begin(), text.end(), patch), end; it != end; ++it)
    {
        types[(*it)[1]] = (*it)[2];
    }
    return types;
}

vtkSmartPointer<vtkPolyData> mergedPolyData(vtkMultiBlockDataSet& blocks)
{
    vtkNew<vtkAppendPolyData> append;
    vtkSmartPointer<vtkCompositeDataIterator> it;
    it.TakeReference(blocks.NewIterator());
    for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
    {
        if (auto* data = vtkPolyData::SafeDownCast(it->GetCurrentDataObject()))
        {
            vtkNew<vtkPolyData> shape; // without the fields
            shape->CopyStructure(data);
            append->AddInputData(shape);
        }
    }
    if (append->GetNumberOfInputConnections(0) == 0)
    {
        return vtkSmartPointer<vtkPolyData>::New();
    }
    append->Update();
    return append->GetOutput();
}

// The faces of all patches that `isWanted` accepts.
template<class Wanted>
vtkSmartPointer<vtkPolyData>
patchFaces(vtkOpenFOAMReader& reader, const Wanted& isWanted)
{
    reader.DisableAllPatchArrays();
    const std::string prefix = "patch/";
    bool any = false;
    for (int i = 0; i < reader.GetNumberOfPatchArrays(); ++i)
    {
        const std::string name = reader.GetPatchArrayName(i);
        if (name.rfind(prefix, 0) == 0 && isWanted(name.substr(prefix.size())))
        {
            reader.SetPatchArrayStatus(name.c_str(), 1);
            any = true;
        }
    }
    if (!any)
    {
        return vtkSmartPointer<vtkPolyData>::New();
    }
    reader.Update();
    return mergedPolyData(*reader.GetOutput());
}

// Does the face lie in one of the six planes of the box?
bool onBox(
    vtkPolyData& data, vtkIdType n, const vtkIdType* points, const vtkBoundingBox& box
)
{
    const double tolerance = 1e-6 * box.GetDiagonalLength();
    for (int side = 0; side < 6; ++side)
    {
        bool all = true;
        for (vtkIdType i = 0; i < n && all; ++i)
        {
            const double x = data.GetPoint(points[i])[side / 2];
            all = std::abs(x - box.GetBound(side)) <= tolerance;
        }
        if (all)
        {
            return true;
        }
    }
    return false;
}

vtkSmartPointer<vtkPolyData> withoutBox(vtkPolyData& data, const vtkBoundingBox& box)
{
    vtkNew<vtkCellArray> kept;
    vtkIdType n = 0;
    const vtkIdType* points = nullptr;
    vtkCellArray* faces = data.GetPolys();
    for (faces->InitTraversal(); faces->GetNextCell(n, points);)
    {
        if (!onBox(data, n, points, box))
        {
            kept->InsertNextCell(n, points);
        }
    }
    vtkNew<vtkPolyData> rest;
    rest->SetPoints(data.GetPoints());
    rest->SetPolys(kept);
    vtkNew<vtkCleanPolyData> clean; // patches share no points in VTK's reader
    clean->SetInputData(rest);
    clean->Update();
    return clean->GetOutput();
}

bool isOuter(const std::string& type)
{
    return type != "processor" && type != "processorCyclic";
}

} // namespace

std::string textOf(const fs::path& path)
{
    std::ifstream stream(path);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    static const std::regex comment(R"(/\*[^*]*\*+([^/*][^*]*\*+)*/|//[^\n]*)");
    return std::regex_replace(text, comment, " ");
}

CaseBoundary readCaseBoundary(const fs::path& caseFolder)
{
    CaseBoundary result;
    for (auto* faces : {&result.walls, &result.allWalls, &result.outer})
    {
        *faces = vtkSmartPointer<vtkPolyData>::New();
    }
    const fs::path control = caseFolder / "system" / "controlDict";
    const fs::path mesh = caseFolder / "constant" / "polyMesh";
    std::error_code ignored;
    if (caseFolder.empty() || !fs::exists(mesh, ignored)
        || !fs::exists(control, ignored))
    {
        return result;
    }

    auto types = patchTypes(mesh / "boundary");
    vtkNew<vtkOpenFOAMReader> reader;
    reader->SetFileName(control.c_str());
    reader->UpdateInformation();
    reader->DisableAllCellArrays();
    reader->DisableAllPointArrays();
    reader->DisableAllLagrangianArrays();
    result.outer = patchFaces(
        *reader, [&](const std::string& name) { return isOuter(types[name]); }
    );
    if (result.outer->GetNumberOfPoints() > 0)
    {
        result.box.SetBounds(result.outer->GetBounds());
        result.allWalls = patchFaces(
            *reader, [&](const std::string& name) { return types[name] == "wall"; }
        );
        if (result.allWalls->GetNumberOfPoints() > 0)
        {
            result.walls = withoutBox(*result.allWalls, result.box);
        }
    }
    const std::string error = takeError();
    if (!error.empty() || !result.box.IsValid())
    {
        std::cerr << "Warning: the mesh in " << mesh.string()
                  << " cannot be read; the walls are left out. " << error << '\n';
    }
    return result;
}

vtkVector3d upwardAxis(const fs::path& caseFolder)
{
    static const std::regex value(R"(\bvalue\s*\(\s*(\S+)\s+(\S+)\s+(\S+)\s*\))");
    vtkVector3d up(0, 0, 1);
    const std::string text = textOf(caseFolder / "constant" / "g");
    std::smatch found;
    if (!caseFolder.empty() && std::regex_search(text, found, value))
    {
        double largest = 0;
        for (int axis = 0; axis < 3; ++axis)
        {
            const double g = std::strtod(found[axis + 1].str().c_str(), nullptr);
            if (std::abs(g) > largest)
            {
                largest = std::abs(g);
                up = vtkVector3d(0, 0, 0);
                up[axis] = g > 0 ? -1 : 1;
            }
        }
    }
    return up;
}

} // namespace Foam::stability
